#pragma once

#include <functional>
#include <vector>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// A tuned law looked at again: eigenvalues of the state space, peaks bracketed over all
/// frequencies, rms by Lyapunov equations. None uses the tuner's frequency response; only
/// `spectral_rms`, which the Lyapunov rms is held against, and the dead-time residue of `stability`
/// do.
struct Verification {
  control::StabilityVerdict stability;
  std::array<control::PeakGain, 3> peaks;  // of |S|, order of control::loop_breaks
  control::LyapunovRms lyapunov;           // rad of motor
  /// By the spectrum, over the whole analysis band with noise white throughout, as Lyapunov has it.
  double spectral_rms = 0.0;  // rad of motor
  /// |lyapunov - spectral|/spectral of the total rms.
  double rms_disagreement = 0.0;
  /// Eigenvalues stable, every peak's upper bound within its goal (1e-6), the valve effort too
  /// (1e-5, by the spectrum on the problem's grid), the two rms within 0.5 %.
  bool passed = false;
  /// Why not; empty if passed.
  std::string failure;
};

Verification verify(const TrackingProblem& problem, const control::ControlLaw& law,
                    const HardGoals& goals);

/// One thing to tune.
struct DesignTask {
  std::string name;
  TrackingProblem problem;
  control::LoopStructure structure;
  HardGoals goals;
  TuningOptions options;
};

/// One tuned, verified design. Rms at the sky in rad, one axis. Where no stable law was found
/// (tuning.status unstable) rms and effort are NaN, verification and margins empty.
struct Design {
  std::string name;
  TuningResult tuning;
  Verification verification;
  plant::PlantMode hydraulic_mode;
  double reflected_inertia = 0.0;  // kg m2
  double beam_rms = 0.0;
  double wind_rms = 0.0;
  double noise_rms = 0.0;
  double valve_effort = 0.0;  // rad/s
  /// Margins of the loops cut at each of control::loop_breaks.
  std::array<control::Margins, 3> margins;

  /// Whether it meets the hard goals and its verification.
  bool usable() const { return tuning.status == TuningStatus::optimal && verification.passed; }
};

/// Tunes and verifies one task. @throws as tune.
Design solve(const DesignTask& task);

/// Gains that nobody tuned, looked at as a tuned law is: `tuning.status` is optimal where the
/// verification passes, infeasible where it does not, unstable where the loop is.
/// @throws InvalidInput as control::validate(law).
Design assess(const TrackingProblem& problem, const control::ControlLaw& law,
              const HardGoals& goals);

/// Tunes a task again from given gains, and keeps what comes out where it is verified and better:
/// feasible where the design was not, or with a soft goal's rms lower by more than 1e-4 of it.
/// Whether it did. An interrupted tuning is not kept. @throws as tune.
bool improve_from(const DesignTask& task, const std::vector<std::vector<double>>& starts,
                  Design& design);

/// Warm-starts each design of a series (one plant changing step by step) from its neighbour's
/// gains, forwards, then backwards, and keeps what is better and verified: an optimum that random
/// starts missed at one point is found from the next. @throws InvalidInput for sizes that differ.
void improve_along(const std::vector<DesignTask>& tasks, std::vector<Design>& designs);

/// Solves every task on `threads` threads; results in the order of the tasks, the same for any
/// thread count. `progress(done, all)` is called under a lock after each; what
/// it throws stops the work and comes out of here.
std::vector<Design> solve_all(const std::vector<DesignTask>& tasks, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace boresight::design
