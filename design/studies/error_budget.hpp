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
  /// What the nonlinear antenna adds in wind: the root of the excess of the simulated mean square
  /// over the linear one; 0 where there is none or nothing was simulated.
  double nonlinearities = 0.0;
  double limit_cycle = 0.0;  // of the largest amplitude in boresight, as a sinusoid
  /// Root sum of squares of the four above.
  double total = 0.0;
  /// Magnitude of static_bending, no part of the total: for the pointing model to remove.
  double static_flexure = 0.0;
};

/// Of a stable design. `in_time`: its simulation in the same wind, the expected rms before that of
/// one record; null if there is none.
ErrorBudget error_budget(const TrackingProblem& problem, const Design& design,
                         const TimeDomainStudy* in_time);

}  // namespace boresight::design
