#pragma once

namespace boresight::control {

/// What a commanded motion keeps to.
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

/// Turns targets that may jump into a motion that the antenna can follow: what the loop is told to
/// do, the limits being those of the drive (W. Gawronski, Command preprocessor for radiotelescopes
/// and microwave antennas, ASME DETC99/VIB-8211, 1999, who limits rate and acceleration of a
/// sampled command likewise). Acceleration is constant from sample to sample, so that
///   angle' = angle + T (rate + rate')/2,   rate' = rate + T acceleration
/// hold exactly, between the samples as well, and the target is reached to the last bit.
///
/// At each sample the new rate is the one nearest to the target from which the motion can still
/// come to the target's angle and rate in whole samples without passing it: with the target's rate
/// subtracted, a rate x > 0 takes at least the way
///   D(x) = T ((n - 1/2) x - A T n (n - 1)/2),   (n - 1) A T < x <= n A T,
/// to stop, which is x^2/(2 A) at whole n and straight in between; the root of
/// T (rate + rate')/2 + D(rate') = way left has a closed form. From rest to rest the motion ends
/// within two samples of the least time that any motion within the limits needs, and takes just
/// that where it is a whole number of samples in each part. A target that moves with at most the
/// limits' rate and acceleration, constant from sample to sample, is followed without error once it
/// is reached.
class CommandPreprocessor {
 public:
  /// @throws InvalidInput unless limits and sample time (s) are positive and finite.
  CommandPreprocessor(CommandLimits limits, double sample_time, CommandSample start = {});

  /// The command at the next sample, where the target then is at `angle` (rad) with `rate` (rad/s).
  /// A rate beyond the limit is chased at the limit. Where the motion cannot stop in time (a target
  /// that jumps back) it brakes with full acceleration, passes and returns.
  /// @throws InvalidInput for a target that is not finite.
  const CommandSample& advance(double angle, double rate = 0.0);

  /// The present command.
  const CommandSample& now() const { return now_; }

 private:
  CommandLimits limits_;
  double sample_time_;
  CommandSample now_;
};

/// The least time (s) in which a motion within the limits goes `distance` (rad) from rest to rest:
/// 2 sqrt(d/A) where the rate limit is not reached, d/V + V/A else.
double least_move_time(const CommandLimits& limits, double distance);

}  // namespace boresight::control
