#pragma once

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/design/tuning/design_study.hpp>

namespace boresight::design {

/// Pointing error of a controller by its causes: boresight rms at the sky, per axis (rad), in the
/// problem's wind.
struct ErrorBudget {
  double wind = 0.0;   // linear plant
  double noise = 0.0;  // of the sensors, linear plant
  /// Increase in wind on the nonlinear antenna: root of the excess of the simulated mean square
  /// over the linear one. 0 where there is no excess, and without a simulation.
  double nonlinearities = 0.0;
  double limit_cycle = 0.0;  // rms of a sinusoid of the largest boresight amplitude
  /// Root sum of squares of the four above.
  double total = 0.0;
  /// static_boresight_error, not part of the total: the pointing model must remove it.
  double static_error = 0.0;
};

/// Error budget of a stable design. `in_time`: its simulation in the same wind; the expected rms is
/// preferred to that of one record. Null without a simulation.
ErrorBudget error_budget(const TrackingProblem& problem, const Design& design,
                         const TimeDomainStudy* in_time);

}  // namespace boresight::design
