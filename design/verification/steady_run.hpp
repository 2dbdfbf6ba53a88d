#pragma once

#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::design {

/// Number of samples of a duration (s), rounded.
Eigen::Index whole_samples(double duration, double sample_time);

/// The limits of the command preprocessor at the motor.
control::CommandLimits limits_at_motor(const NonlinearVerificationOptions& options,
                                       double gear_ratio);

/// A run without sensor noise.
LoopRunOptions without_noise();

}  // namespace boresight::design
