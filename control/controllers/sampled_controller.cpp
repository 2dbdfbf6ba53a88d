#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

// Fractions of the Nyquist frequency up to which a corner is placed exactly. Near it the tangent
// grows without bound and the block would vanish, its phase at low frequencies first; but a notch
// off its frequency is no notch.
constexpr double corner_limit = 0.5;
constexpr double notch_limit = 0.9;

double prewarped_corner(double corner, double sample_time, double limit) {
  const double exact_up_to = limit * std::numbers::pi / sample_time;
  const double place = std::min(corner, exact_up_to);
  const double half_angle = 0.5 * place * sample_time;
  return corner * std::tan(half_angle) / half_angle;
}

// The system of a structure that is a state space, null for loops.
const plant::StateSpace* own_state_space(const Controller& controller, double sample_time) {
  const plant::StateSpace* system = controller.structure.state_space();
  if (system != nullptr && !(std::abs(system->sample_time - sample_time) <= 1e-9 * sample_time)) {
    throw InvalidInput(
        fmt::format("sampled controller: expected a sample time of {} s, that of {}, found {} s",
                    system->sample_time, controller.structure.name(), sample_time));
  }
  return system;
}

SampledLoop around(const plant::StateSpace& plant, const plant::StateSpace& controller) {
  const auto command_only = plant::subsystem(controller, controller.inputs, {"valve_demand"});
  return {plant, plant::renamed(command_only, {{"valve_demand", "valve_command"}}),
          controller.sample_time};
}

}  // namespace

Controller prewarped(const Controller& controller, double sample_time) {
  validate(controller);
  if (!(sample_time > 0.0) || !std::isfinite(sample_time)) {
    throw InvalidInput(
        fmt::format("sampled controller: expected a sample time above 0, found {} s", sample_time));
  }
  Controller result = controller;
  std::size_t first = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    double& gain = result.gains[first];
    switch (block.kind) {
      case BlockKind::gain:
      case BlockKind::integral:
      case BlockKind::dead_zone:
      case BlockKind::freeze:
        break;
      case BlockKind::lag:
      case BlockKind::lead:
      case BlockKind::washout:
        gain = prewarped_corner(gain, sample_time, corner_limit);
        break;
      case BlockKind::notch:
        gain = prewarped_corner(gain, sample_time, notch_limit);
        break;
    }
    first += block.gains.size();
  }
  return result;
}

plant::StateSpace sampled_controller(const Controller& controller, double sample_time) {
  const plant::StateSpace* own = own_state_space(controller, sample_time);
  const auto sampled = own != nullptr
                           ? with_rate_command(*own)
                           : plant::sample(to_state_space(prewarped(controller, sample_time)),
                                           sample_time, plant::SamplingMethod::tustin);
  const auto error = plant::static_gain(Eigen::RowVector2d{1.0, -1.0},
                                        {"encoder", "angle_reference"}, {"angle_error"});
  std::vector<std::string> inputs{"tachometer", "encoder", "angle_reference", "rate_disturbance"};
  const bool torque = std::ranges::find(sampled.inputs, "motor_torque") != sampled.inputs.end();
  if (torque) inputs.emplace_back("motor_torque");
  return plant::connect({plant::renamed(sampled, {{"encoder", "angle_error"}}), error}, inputs,
                        sampled.outputs);
}

plant::StateSpace sampled_rate_loop_controller(const Controller& controller, double sample_time) {
  if (const plant::StateSpace* own = own_state_space(controller, sample_time)) {
    std::vector<std::string> inputs = own->inputs;
    std::erase(inputs, "encoder");
    return plant::subsystem(*own, inputs, {"valve_demand"});
  }
  return plant::sample(rate_loop_controller(prewarped(controller, sample_time)), sample_time,
                       plant::SamplingMethod::tustin);
}

SampledLoop sampled_loop(const plant::StateSpace& plant, const Controller& controller,
                         double sample_time) {
  return around(plant, sampled_controller(controller, sample_time));
}

SampledLoop sampled_rate_loop(const plant::StateSpace& plant, const Controller& controller,
                              double sample_time) {
  return around(plant, sampled_rate_loop_controller(controller, sample_time));
}

}  // namespace boresight::control
