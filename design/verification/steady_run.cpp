#include <cmath>

#include <boresight/design/verification/steady_run.hpp>

namespace boresight::design {

Eigen::Index whole_samples(double duration, double sample_time) {
  return static_cast<Eigen::Index>(std::llround(duration / sample_time));
}

control::CommandLimits limits_at_motor(const NonlinearVerificationOptions& options,
                                       double gear_ratio) {
  return {options.limits.rate * gear_ratio, options.limits.acceleration * gear_ratio};
}

LoopRunOptions without_noise() {
  LoopRunOptions options;
  options.noise = false;
  return options;
}

}  // namespace boresight::design
