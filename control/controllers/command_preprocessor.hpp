#pragma once

namespace boresight::control {

/// Limits of a commanded motion.
struct CommandLimits {
  double rate = 0.0;          // rad/s
  double acceleration = 0.0;  // rad/s2
};

/// A commanded motion at one sample.
struct CommandSample {
  double angle = 0.0;         // rad
  double rate = 0.0;          // rad/s
  double acceleration = 0.0;  // rad/s2, constant since the sample before
};

/// Converts targets that may jump to a motion command that the antenna can follow, within the
/// limits of the drive. Like W. Gawronski, Command preprocessor for radiotelescopes and microwave
/// antennas, ASME DETC99/VIB-8211, 1999, it limits rate and acceleration of a sampled command.
/// Acceleration is constant from sample to sample, so that
///   angle' = angle + T (rate + rate')/2,   rate' = rate + T acceleration
/// hold exactly, also between the samples. The target is reached to the last bit.
///
/// Each sample takes the rate nearest to the target that permits a stop without overshoot: the
/// motion can still reach the target's angle and rate in whole samples. With the target's rate
/// subtracted, a rate x > 0 needs at least the stopping distance
///   D(x) = T ((n - 1/2) x - A T n (n - 1)/2),   (n - 1) A T < x <= n A T,
/// which is x^2/(2 A) at whole n and linear in between. The root of T (rate + rate')/2 + D(rate') =
/// remaining distance has a closed form. From rest to rest the motion ends within two samples of
/// the least time of any motion within the limits. It takes exactly that time if this is a whole
/// number of samples in each part. A target with at most the limits' rate and acceleration,
/// constant from sample to sample, is followed without error once it is reached.
class CommandPreprocessor {
 public:
  /// @throws InvalidInput unless limits and sample time (s) are positive and finite.
  CommandPreprocessor(CommandLimits limits, double sample_time, CommandSample start = {});

  /// The command at the next sample, for a target that is then at `angle` (rad) with `rate`
  /// (rad/s). A target rate beyond the limit is followed at the limit. If the motion cannot stop in
  /// time (a target that jumps back), it brakes with full acceleration, overshoots and returns.
  /// @throws InvalidInput for a target that is not finite.
  const CommandSample& advance(double angle, double rate = 0.0);

  /// The current command.
  const CommandSample& now() const { return now_; }

 private:
  CommandLimits limits_;
  double sample_time_;
  CommandSample now_;
};

/// The least time (s) of a motion within the limits over `distance` (rad) from rest to rest: 2
/// sqrt(d/A) if the rate limit is not reached, otherwise d/V + V/A.
double min_move_time(const CommandLimits& limits, double distance);

}  // namespace boresight::control
