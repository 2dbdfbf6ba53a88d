#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/verification/integrator_agreement.hpp>
#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::design {

/// What of a tuned loop is looked at in the time domain. Angles and rates at the sky.
struct NonlinearVerificationOptions {
  std::vector<std::uint64_t> seeds{1};  // of wind and noise; one run each
  double wind_duration = 300.0;         // s, after settling
  double settling = 20.0;               // s left out at the start of every run
  double tracking_rate = 0.0;           // rad/s, in wind and for limit cycles: sidereal
  bool explain = true;                  // repeat the runs in wind with each influence off
  bool second_integrator = false;       // repeat the first run in wind by CVODES
  double hunting_duration = 200.0;      // s, after settling; hunting_confirmation
  double reversal_leg = 20.0;           // s of each way of the slow triangle
  double slew_distance = 0.0;           // rad; 0: no slew
  /// Of the command preprocessor.
  control::CommandLimits limits;
  /// Encoder error (rad) within which a slew counts as settled, for good.
  double settled_error = 0.0;
  double settling_watched = 40.0;  // s after the end of the command
  unsigned threads = 1;
};

/// Errors of a run at equal intervals from 0 on, at the sky. Empty where the run did not complete.
struct ErrorTrace {
  double interval = 0.0;      // s
  Eigen::VectorXd boresight;  // rad
  Eigen::VectorXd encoder;    // rad
};

/// What one influence does to the beam's rms: that of the whole loop less that without it.
struct InfluenceResult {
  Influence influence = Influence::friction;
  RunStatus status = RunStatus::complete;  // the worst over the seeds
  double beam_rms_without = 0.0;           // rad; NaN unless complete
  double difference = 0.0;                 // rad, with less without; NaN unless complete
};

/// The loop in wind, against the linear prediction. Rms about the mean over all seeds, rad at the
/// sky; NaN where a run did not complete. The difference from the prediction is the sum
///   simulated - predicted = chance + sampling + sum of the influences' differences + joint
struct WindResult {
  RunStatus status = RunStatus::complete;
  std::string message;  // of the first run that did not complete
  double beam_rms = 0.0;
  double encoder_rms = 0.0;
  double predicted_rms = 0.0;  // by the spectrum, continuous with exact dead time
  /// The same records through the linear plant, sampled as built and sixteen times as often.
  double linear_rms = 0.0;
  double continuous_rms = 0.0;
  double chance = 0.0;    // continuous - predicted: these records are not the expectation
  double sampling = 0.0;  // linear - continuous
  std::vector<InfluenceResult> influences;
  /// simulated - linear - sum of the influences: what they do together only, and what else the
  /// nonlinear antenna has beyond the linear plant (lines, offset torque).
  double joint = 0.0;
  double at_command_limit = 0.0;  // share of samples
  /// Of the whole loop with the first seed after settling, both about their means.
  ErrorTrace trace;
};

/// How many runs look for a limit cycle at each rate, each moved by another step at its start:
/// whether a loop with stiction comes to rest or swings hangs on where it stops.
inline constexpr int hunting_starts = 3;
/// A cycle that is seen is looked at again for so many times as long: against stiction an
/// integrator swings for minutes, ever less.
inline constexpr double hunting_confirmation = 3.0;

/// s that are kept of such a run.
inline constexpr double longest_hunting_trace = 120.0;

/// What the loop does by itself at a steady rate, without wind or noise: of its runs
/// (hunting_starts) one that did not complete, else the limit cycle of the largest beam amplitude,
/// else the run of the largest encoder amplitude.
struct HuntingResult {
  double rate = 0.0;  // rad/s at the sky
  RunStatus status = RunStatus::complete;
  std::string message;
  int starts = 0;          // runs that were looked at; 0: not told
  int starts_hunting = 0;  // of these, with a limit cycle
  /// Whether some of its runs came to rest while others did not.
  bool some_only() const { return limit_cycle && starts_hunting < starts; }
  /// Half of peak to peak of the true angles in the second half of the run, a straight line taken
  /// off (rad).
  double encoder_amplitude = 0.0;
  double beam_amplitude = 0.0;
  /// Hz; none with less than two whole periods in that half.
  std::optional<double> frequency;
  /// Over the same in the quarter before: 1 for a limit cycle, less for one that dies out.
  double persistence = 0.0;
  /// The end of that half, at most longest_hunting_trace, the same lines taken off.
  ErrorTrace trace;
  /// In one run at least the encoder's amplitude is above half its resolution (or 1e-3 mdeg without
  /// one) and lasts (persistence above 0.8).
  bool limit_cycle = false;
};

/// A slow triangle of the tracking rate either way. Largest error after a reversal until the next,
/// rad at the sky; the beam's about its mean.
struct ReversalResult {
  RunStatus status = RunStatus::complete;
  std::string message;
  double encoder_error = 0.0;
  double beam_error = 0.0;
  /// The same without friction: what turning round excites in a linear loop already. NaN if that
  /// run did not complete.
  double encoder_error_without_friction = 0.0;
  double time_of_largest = 0.0;  // s after the reversal, of the encoder's
  /// From a reversal on, another one after each `leg`: the errors that the above are the largest
  /// of, with and without friction, the boresight's about its mean.
  double leg = 0.0;  // s
  ErrorTrace trace, trace_without_friction;
};

/// A move from rest to rest through the command preprocessor, in still air.
struct SlewResult {
  RunStatus status = RunStatus::complete;
  std::string message;
  double distance = 0.0;          // rad at the sky
  control::CommandLimits limits;  // at the sky, those kept: what the drive can do if that is less
  bool within_reach = true;       // the drive can do the limits asked for
  double command_time = 0.0;      // s
  double largest_error = 0.0;     // rad, of the encoder from the command, while it moves
  double overshoot = 0.0;         // rad, beyond the target
  /// s from the end of the command; none if not settled for the last 10 s (or half of what is
  /// watched).
  std::optional<double> settling_time;
  double at_command_limit = 0.0;  // share of samples
};

struct NonlinearVerification {
  WindResult wind;
  std::optional<IntegratorAgreement> integrators;  // none without second_integrator
  std::vector<HuntingResult> hunting;      // at rest, then at the tracking rate if that is not 0
  std::optional<ReversalResult> reversal;  // none without a tracking rate
  std::optional<SlewResult> slew;
};

/// Largest beam amplitude of its limit cycles (rad); 0 without any.
double hunting_amplitude(const std::vector<HuntingResult>& hunting);
/// Whether every hunting run completed.
bool hunting_seen(const std::vector<HuntingResult>& hunting);
/// The amplitude (rad) of a sinusoid of that rms `error` (rad): a limit cycle up to it keeps within
/// the error.
double hunting_limit(double error);
/// Whether the loop keeps its beam within an rms `error` (rad) where nothing but friction and its
/// own torque moves it: hunting_seen, and no amplitude above the hunting_limit.
bool holds_still(const std::vector<HuntingResult>& hunting, double error);

/// The first of verify_in_time's runs in wind alone (WindResult::trace), of another controller
/// beside the one that is verified. @throws as verify_in_time.
ErrorTrace error_in_wind(const TrackingProblem& problem, const SimulatedLoop& loop,
                         const NonlinearVerificationOptions& options);

/// The loop of a tuned law on the nonlinear antenna: in wind, hunting, reversing, slewing. Runs
/// that fail or lose the target are stated in their result. The same result for any number of
/// threads. `problem`: what the law was tuned on, for its wind and the linear prediction.
/// @throws InvalidInput for options out of range, no seeds, and as run_loop.
NonlinearVerification verify_in_time(const TrackingProblem& problem, const SimulatedLoop& loop,
                                     const NonlinearVerificationOptions& options);

}  // namespace boresight::design
