#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/verification/integrator_agreement.hpp>
#include <boresight/design/verification/shared_winds.hpp>
#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::design {

/// Options of the time-domain verification of a tuned loop. Angles and rates at the sky.
struct NonlinearVerificationOptions {
  std::vector<std::uint64_t> seeds{1};  // of wind and noise; one run per seed
  double wind_duration = 300.0;         // s, after settling
  double settling = 20.0;               // s excluded at the start of every run
  double tracking_rate = 0.0;           // rad/s, in wind and for limit cycles: sidereal
  /// Repeat the runs in wind by the linear plant and with each influence off, and the reversals
  /// without friction feedforward.
  bool explain = true;
  bool second_integrator = false;  // repeat the first run in wind by CVODES
  /// s of that run after settling, at most: a stable loop forgets integration errors.
  double second_integrator_duration = 100.0;
  double limit_cycle_duration = 200.0;  // s, after settling; limit_cycle_confirmation
  double reversal_leg = 20.0;           // s in each direction of the slow triangle
  double slew_distance = 0.0;           // rad; 0: no slew
  /// Of the command preprocessor.
  control::CommandLimits limits;
  /// Encoder error (rad) within which a slew counts as settled.
  double settled_error = 0.0;
  /// Boresight amplitude (rad at the sky) of a limit cycle that is allowed (is_limit_cycle_free);
  /// no run depends on it.
  double allowed_limit_cycle = 0.0;
  double settling_watched = 40.0;  // s after the end of the command
  unsigned threads = 1;
  /// The records of wind, for several controllers in the same; prepared anew if null.
  std::shared_ptr<SharedWinds> winds = nullptr;

  control::CommandLimits limits_at_motor(double gear_ratio) const {
    return {limits.rate * gear_ratio, limits.acceleration * gear_ratio};
  }
};

/// Errors of a run at equal intervals from 0 on, at the sky. Empty where the run did not complete.
struct ErrorTrace {
  double interval = 0.0;      // s
  Eigen::VectorXd boresight;  // rad
  Eigen::VectorXd encoder;    // rad
};

/// Effect of one influence on the boresight rms: that of the whole loop less that without it.
struct InfluenceResult {
  Influence influence = Influence::friction;
  RunStatus status = RunStatus::complete;  // the worst over the seeds
  double boresight_rms_without = 0.0;      // rad; NaN unless complete
  double difference = 0.0;                 // rad, with less without it; NaN unless complete
};

/// The loop in wind, compared with the linear prediction. Rms about the mean over all seeds, rad at
/// the sky; NaN where a run did not complete or was not requested (explain). The difference from
/// the prediction is the sum
///   simulated - predicted = realisation error (`realisation_error`) + sampling
///                           + sum of the influences' differences + interaction (`interaction`)
struct WindResult {
  RunStatus status = RunStatus::complete;
  std::string message;  // of the first run that did not complete
  double boresight_rms = 0.0;
  double encoder_rms = 0.0;
  double predicted_rms = 0.0;  // by the spectrum, continuous with exact dead time
  /// Boresight error at rest in the mean wind, by the linear loop (static_boresight_error).
  double static_error = 0.0;
  /// The same records through the linear plant, with the actual and 16 times the sampling rate; a
  /// state space has the actual one only, in both.
  double linear_rms = 0.0;
  double continuous_rms = 0.0;
  double realisation_error = 0.0;  // realisation error: continuous - predicted
  double sampling = 0.0;           // linear - continuous; 0 of a state space
  std::vector<InfluenceResult> influences;
  /// Interaction: simulated - linear - sum of the influences' differences. It includes effects that
  /// the nonlinear antenna has beyond the linear plant (lines, offset torque).
  double interaction = 0.0;
  double at_command_limit = 0.0;  // fraction of samples
  /// Of the whole loop with the first seed after settling, both about their means.
  ErrorTrace trace;
};

/// Number of limit-cycle runs per rate, each with another initial step. With stiction, the stopping
/// position decides whether a loop comes to rest or limit-cycles.
inline constexpr std::size_t limit_cycle_starts = 3;
/// Confirmation runs are this many times longer: with stiction, integral action causes slowly
/// decaying oscillations lasting minutes. At each rate the limit cycle of the largest amplitude is
/// confirmed; if it decays, the next one, and so on.
inline constexpr double limit_cycle_confirmation = 3.0;

/// s of such a run that the trace keeps.
inline constexpr double longest_limit_cycle_trace = 120.0;

/// Limit-cycle result at a steady rate, without wind or noise. Of its runs (limit_cycle_starts):
/// one that did not complete; else the limit cycle of the largest boresight amplitude; else the run
/// of the largest encoder amplitude.
struct LimitCycleResult {
  double rate = 0.0;  // rad/s at the sky
  RunStatus status = RunStatus::complete;
  std::string message;
  int starts = 0;  // number of runs; 0: not stated
  /// Of these, with a limit cycle, which is confirmed (limit_cycle_confirmation) for the result's
  /// only.
  int starts_with_limit_cycle = 0;
  /// True if some runs came to rest while others did not.
  bool some_only() const { return limit_cycle && starts_with_limit_cycle < starts; }
  /// Half of the peak-to-peak value (rad) of the true angles in the second half of the run, with a
  /// fitted straight line removed.
  double encoder_amplitude = 0.0;
  double boresight_amplitude = 0.0;
  /// Rms (rad/s) of the valve command about its mean in that half. The valve may move while the
  /// antenna stands still.
  double valve_command_rms = 0.0;
  /// Hz; none with fewer than two whole periods in that half.
  std::optional<double> frequency;
  /// Ratio to the amplitude in the quarter before: 1 for a limit cycle, less for a decaying
  /// oscillation.
  double persistence = 0.0;
  /// The end of that half, at most longest_limit_cycle_trace, with the same lines removed.
  ErrorTrace trace;
  /// In at least one run the encoder's amplitude exceeds half its resolution (or 1e-3 mdeg without
  /// one) and persists (persistence above 0.8).
  bool limit_cycle = false;
};

/// A slow triangle at the tracking rate in both directions. Largest error between one velocity
/// reversal and the next, rad at the sky; the boresight error about its mean.
struct ReversalResult {
  RunStatus status = RunStatus::complete;
  std::string message;
  double encoder_error = 0.0;
  double boresight_error = 0.0;
  /// The same without friction: the error that a velocity reversal excites in a linear loop. NaN if
  /// that run did not complete.
  double encoder_error_without_friction = 0.0;
  /// Boresight error without friction feedforward; NaN if that run did not complete or was not
  /// requested (explain), or the loop has none.
  double boresight_error_without_friction_feedforward = 0.0;
  double time_of_largest = 0.0;  // s after the reversal, of the encoder error
  /// Errors from a reversal on, with further reversals after each `leg`, with and without friction;
  /// the boresight error about its mean. The values above are the maxima of these traces.
  double leg = 0.0;  // s
  ErrorTrace trace, trace_without_friction;
};

/// A move from rest to rest through the command preprocessor, in still air.
struct SlewResult {
  RunStatus status = RunStatus::complete;
  std::string message;
  double distance = 0.0;          // rad at the sky
  control::CommandLimits limits;  // at the sky, those applied: the drive's capability if smaller
  bool achievable_limits = true;  // the drive can reach the limits requested
  double command_time = 0.0;      // s
  double largest_error = 0.0;     // rad, of the encoder from the command, while it moves
  double overshoot = 0.0;         // rad, beyond the target
  /// s from the end of the command. None if not settled for the last 10 s (or half of the time
  /// simulated after the command).
  std::optional<double> settling_time;
  double at_command_limit = 0.0;  // fraction of samples
};

struct NonlinearVerification {
  WindResult wind;
  std::optional<IntegratorAgreement> integrators;  // none without second_integrator
  std::vector<LimitCycleResult>
      limit_cycles;                        // at rest, then at the tracking rate if that is not 0
  std::optional<ReversalResult> reversal;  // none without a tracking rate
  std::optional<SlewResult> slew;
};

/// Largest boresight amplitude of its limit cycles (rad); 0 without any.
double limit_cycle_amplitude(const std::vector<LimitCycleResult>& limit_cycles);
/// True if every limit-cycle run completed.
bool limit_cycle_runs_complete(const std::vector<LimitCycleResult>& limit_cycles);
/// True if the loop is free of limit cycles beyond an amplitude (rad) when only friction and its
/// own torque act: limit_cycle_runs_complete, and no larger limit_cycle_amplitude.
bool is_limit_cycle_free(const std::vector<LimitCycleResult>& limit_cycles, double amplitude);

/// Runs only the first of verify_in_time's runs in wind (WindResult::trace), to compare another
/// controller with the verified one. @throws as verify_in_time.
ErrorTrace error_in_wind(const TrackingProblem& problem, const SimulatedLoop& loop,
                         const NonlinearVerificationOptions& options);

/// Adds to a verification without separate influences what `options` request: the influences, the
/// reversals without friction feedforward and the second integrator. The other runs are kept.
/// @throws as verify_in_time.
void explain_in_wind(const TrackingProblem& problem, const SimulatedLoop& loop,
                     const NonlinearVerificationOptions& options, NonlinearVerification& known);

/// Runs the loop of a tuned controller on the nonlinear antenna: wind, limit cycles, velocity
/// reversals, slew. Runs that fail or lose the target are reported in their result. The result does
/// not depend on the number of threads. `problem`: the tuning problem, for its wind and the linear
/// prediction.
/// @throws InvalidInput for options out of range, no seeds, and as run_loop.
NonlinearVerification verify_in_time(const TrackingProblem& problem, const SimulatedLoop& loop,
                                     const NonlinearVerificationOptions& options);

}  // namespace boresight::design
