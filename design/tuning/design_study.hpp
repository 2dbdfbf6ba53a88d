#pragma once

#include <functional>
#include <vector>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// Independent check of a tuned controller: eigenvalues of the state space, peaks bracketed over
/// all frequencies, rms by Lyapunov equations. None of these uses the tuner's frequency response.
/// Only `spectral_rms`, the comparison value for the Lyapunov rms, and the dead-time residue of
/// `stability` use it.
struct Verification {
  control::StabilityVerdict stability;
  std::array<control::PeakGain, 3> peaks;  // of |S|, order of control::loop_breaks
  control::LyapunovRms lyapunov;           // rad of motor
  /// By integration of the spectrum over the whole analysis band, with white noise throughout, as
  /// in the Lyapunov equations.
  double spectral_rms = 0.0;  // rad of motor
  /// lyapunov - spectral| / spectral, of the total rms.
  double rms_disagreement = 0.0;
  /// True if the eigenvalues are stable and every peak's upper bound is within its limit (tolerance
  /// 1e-6). The control effort must be within its limit too (1e-5, by the spectrum on a
  /// fine grid), and so must the peaks at standstill. The two rms values must agree within 0.5 %.
  bool passed = false;
  /// Reason for a failure; empty if passed.
  std::string failure;
};

Verification verify(const TrackingProblem& problem, const control::Controller& controller,
                    const Constraints& goals);

/// One tuning task.
struct DesignTask {
  std::string name;
  TrackingProblem problem;
  control::LoopStructure structure;
  Constraints goals;
  TuningOptions options;
};

/// One tuned and verified design. Rms in rad at the sky, per axis. If no stable controller was
/// found (`tuning.status` unstable), rms and effort are NaN, and verification and margins are
/// empty.
struct Design {
  std::string name;
  TuningResult tuning;
  Verification verification;
  plant::PlantMode hydraulic_mode;
  double reflected_inertia = 0.0;  // kg m2
  double boresight_rms = 0.0;
  double wind_rms = 0.0;
  double noise_rms = 0.0;
  double control_effort = 0.0;  // rad/s
  /// Stability margins with the loop cut at each of control::loop_breaks; infinite where the
  /// controller has no such loop (control::has_break).
  std::array<control::Margins, 3> margins;

  /// True if the design meets the constraints and passed its verification.
  bool usable() const { return tuning.status == TuningStatus::optimal && verification.passed; }
};

/// Tunes and verifies one task. @throws as tune.
Design solve(const DesignTask& task);

/// Verifies given gains as verify() does for a tuned controller. `tuning.status` is optimal if the
/// verification passes, infeasible if it fails, and unstable if the loop is unstable.
/// @throws InvalidInput as control::validate.
Design assess(const TrackingProblem& problem, const control::Controller& controller,
              const Constraints& goals);

/// Tunes a task again from given gains. Replaces the design if the result is verified and better:
/// feasible where the design was not, or with an objective rms lower by more than a relative 1e-4.
/// An interrupted tuning is not kept. Returns whether the design was replaced.
/// @throws as tune.
bool improve_from(const DesignTask& task, const std::vector<std::vector<double>>& starts,
                  Design& design);

/// Warm-starts each design of a series (one plant changing step by step) from its neighbour's
/// gains, forwards, then backwards. Verified improvements are kept. This finds optima that the
/// random starts missed at one point but found at a neighbour.
/// @throws InvalidInput for sizes that differ.
void improve_along(const std::vector<DesignTask>& tasks, std::vector<Design>& designs);

/// Solves every task on `threads` threads. Results are in the order of the tasks and do not depend
/// on the thread count. `progress(done, all)` is called under a lock after each task. An exception
/// thrown by `progress` stops the work and is rethrown.
std::vector<Design> solve_all(const std::vector<DesignTask>& tasks, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace boresight::design
