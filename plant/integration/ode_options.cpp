#include <cmath>
#include <string>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/ode_options.hpp>

namespace boresight::plant {
namespace {

[[noreturn]] void refuse(const std::string& expected_and_found) {
  throw InvalidInput("OdeOptions: expected " + expected_and_found);
}

void validate_sensitivities(const OdeOptions& options, const OdeSystem& system) {
  const Eigen::Index n = system.states(), count = system.parameters();
  if (options.iteration == OdeIteration::fixed_point) {
    refuse("OdeIteration::newton where sensitivities are asked for, found fixed_point");
  }
  if (count <= 0) refuse("a system with parameters where sensitivities are asked for, found none");
  const Eigen::MatrixXd& initial = options.initial_sensitivities;
  if (initial.size() != 0 && (initial.rows() != n || initial.cols() != count)) {
    refuse(fmt::format("initial_sensitivities of {} x {}, found {} x {}", n, count, initial.rows(),
                       initial.cols()));
  }
  if (!initial.allFinite()) refuse("finite initial_sensitivities, found some that are not");
  const Eigen::VectorXd& scale = options.parameter_scale;
  if (scale.size() != 0 && scale.size() != count) {
    refuse(fmt::format("a parameter_scale of length {}, found {}", count, scale.size()));
  }
  for (const double size : scale) {
    if (!std::isfinite(size) || size <= 0.0) {
      refuse(fmt::format("every parameter_scale finite and above 0, found {}", size));
    }
  }
}

}  // namespace

void validate(const OdeOptions& options, const OdeSystem& system) {
  const Eigen::Index n = system.states();
  if (n <= 0) refuse(fmt::format("a system with states, found {}", n));
  if (!(options.relative_tolerance >= 0.0) || options.relative_tolerance >= 1.0) {
    refuse(fmt::format("a relative_tolerance in [0, 1), found {}", options.relative_tolerance));
  }
  const Eigen::VectorXd& absolute = options.absolute_tolerance;
  if (absolute.size() != 1 && absolute.size() != n) {
    refuse(fmt::format("one absolute_tolerance or {}, found {}", n, absolute.size()));
  }
  for (const double tolerance : absolute) {
    if (!std::isfinite(tolerance) || tolerance <= 0.0) {
      refuse(fmt::format("every absolute_tolerance finite and above 0, found {}", tolerance));
    }
  }
  if (options.highest_order <= 0) {
    refuse(fmt::format("a highest_order above 0, found {}", options.highest_order));
  }
  if (!(options.longest_step > 0.0)) {
    refuse(fmt::format("a longest_step above 0, found {} s", options.longest_step));
  }
  if (options.max_steps <= 0) {
    refuse(fmt::format("max_steps above 0, found {}", options.max_steps));
  }
  if (options.sensitivities) validate_sensitivities(options, system);
}

}  // namespace boresight::plant
