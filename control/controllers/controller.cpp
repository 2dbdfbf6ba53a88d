#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/controllers/path_sections.hpp>
#include <boresight/control/controllers/sensor_response.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/transfer_function.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// The blocks of one path with where their gains begin.
struct PlacedBlock {
  const LoopBlock* block;
  const double* gains;
};

std::vector<PlacedBlock> blocks_of(const Controller& controller, LoopPath path) {
  std::vector<PlacedBlock> placed;
  const double* gains = controller.gains.data();
  for (const LoopBlock& block : controller.structure.blocks()) {
    if (block.path == path) placed.push_back({&block, gains});
    gains += block.gains.size();
  }
  return placed;
}

// One path as a chain of first- and second-order sections from `input` to `output`.
std::vector<plant::StateSpace> chain(const Controller& controller, LoopPath path,
                                     const std::string& input, const std::string& output) {
  const auto factors = path_sections(controller, path);
  const std::string name(to_string(path));
  std::vector<plant::StateSpace> sections;
  std::string signal = input;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const PathSection& factor = factors[i];
    const std::string next =
        i + 1 == factors.size() ? output : fmt::format("{}_path_{}", name, i + 1);
    if (factor.denominator.size() == 1) {
      sections.push_back(plant::static_gain(
          Eigen::MatrixXd::Constant(1, 1, factor.numerator.front()), {signal}, {next}));
    } else {
      sections.push_back(plant::rational(factor.numerator, factor.denominator, signal, next,
                                         fmt::format("{}_{}", name, factor.symbol)));
    }
    signal = next;
  }
  return sections;
}

void append(std::vector<plant::StateSpace>& parts, std::vector<plant::StateSpace> more) {
  std::ranges::move(more, std::back_inserter(parts));
}

plant::StateSpace difference(const std::string& first, const std::string& second,
                             const std::string& output) {
  return plant::static_gain(Eigen::RowVector2d{1.0, -1.0}, {first, second}, {output});
}

// From rate error and, with a pressure path, motor torque to the valve demand.
void append_rate_controller(std::vector<plant::StateSpace>& parts, const Controller& controller) {
  const bool pressure = controller.structure.has(LoopPath::pressure);
  append(parts, chain(controller, LoopPath::rate, "rate_error",
                      pressure ? "rate_demand" : "valve_demand"));
  if (!pressure) return;
  append(parts, chain(controller, LoopPath::pressure, "motor_torque", "pressure_demand"));
  parts.push_back(difference("rate_demand", "pressure_demand", "valve_demand"));
}

// Inverse of Tustin's rule as plant::sample has it.
plant::StateSpace continuous(const plant::StateSpace& sampled) {
  const Eigen::Index n = sampled.a.rows();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd inverse =
      numerics::linear_solve(sampled.a + identity, identity, "controller: continuous form");
  plant::StateSpace system = sampled;
  system.sample_time = 0.0;
  system.a = 2.0 / sampled.sample_time * (inverse * (sampled.a - identity));
  system.b = 2.0 / sampled.sample_time * (inverse * sampled.b);
  system.c = 2.0 * (sampled.c * inverse);
  system.d = sampled.d - sampled.c * inverse * sampled.b;
  return system;
}

plant::StateSpace without_encoder(const plant::StateSpace& controller) {
  std::vector<std::string> inputs = controller.inputs;
  std::erase(inputs, "encoder");
  return plant::subsystem(controller, inputs, {"valve_demand"});
}

}  // namespace

Controller state_space_controller(std::string name, const plant::StateSpace& controller) {
  return {LoopStructure::of_state_space(std::move(name), controller), {}};
}

Controller with_output_times(double factor, const Controller& controller) {
  const plant::StateSpace* system = controller.structure.state_space();
  if (system == nullptr) {
    throw InvalidInput(
        fmt::format("with_output_times: expected a state space, found a controller of gains ({})",
                    controller.structure.name()));
  }
  plant::StateSpace scaled = *system;
  scaled.c *= factor;
  scaled.d *= factor;
  return state_space_controller(controller.structure.name(), scaled);
}

void validate(const Controller& controller) {
  const auto& descriptions = controller.structure.gains();
  if (controller.gains.size() != descriptions.size()) {
    throw InvalidInput(fmt::format("controller: expected {} gains for {}, found {}",
                                   descriptions.size(), controller.structure.name(),
                                   controller.gains.size()));
  }
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    if (!(controller.gains[i] > 0.0) || !std::isfinite(controller.gains[i])) {
      throw InvalidInput(fmt::format("controller: expected a positive finite {}, found {}",
                                     descriptions[i].name, controller.gains[i]));
    }
  }
}

double gain(const Controller& controller, std::string_view symbol) {
  const auto& descriptions = controller.structure.gains();
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    if (descriptions[i].symbol == symbol) return controller.gains[i];
  }
  throw InvalidInput(
      fmt::format("controller: {} has no gain '{}'", controller.structure.name(), symbol));
}

CompensatorResponse compensator_response(const Controller& controller, double angular_frequency) {
  const double w = angular_frequency;
  CompensatorResponse response;
  if (const SensorResponse* fixed = controller.structure.sensor_response()) {
    const auto [tachometer, encoder, torque] = fixed->at(w);
    response.rate = -tachometer;
    response.position = encoder / tachometer;
    response.pressure = -torque;
    return response;
  }
  response.rate = response.position = 1.0;
  response.pressure = controller.structure.has(LoopPath::pressure) ? 1.0 : 0.0;
  response.compliance = controller.structure.has(LoopPath::compliance) ? 1.0 : 0.0;
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    Complex& compensator = block.path == LoopPath::rate       ? response.rate
                           : block.path == LoopPath::pressure ? response.pressure
                           : block.path == LoopPath::position ? response.position
                                                              : response.compliance;
    const double value = controller.gains[k];
    // value/(s + value) and s/(s + value) at s = j w, with one division for both
    const double scale = 1.0 / (value * value + w * w);
    const Complex low{value * value * scale, -value * w * scale};
    const Complex high{w * w * scale, value * w * scale};
    switch (block.kind) {
      case BlockKind::gain:
        compensator *= value;
        response.by_gain[k] = 1.0;
        break;
      case BlockKind::integral:
        compensator *= Complex{1.0, -value / w};
        response.by_gain[k] = low;
        break;
      case BlockKind::lag:
        compensator *= low;
        response.by_gain[k] = high;
        break;
      case BlockKind::lead:
        compensator *= Complex{1.0, w / value};
        response.by_gain[k] = -high;
        break;
      case BlockKind::washout:
        compensator *= high;
        response.by_gain[k] = -low;
        break;
      case BlockKind::dead_zone:
      case BlockKind::freeze:
        break;
      case BlockKind::notch: {
        const double square = value * value - w * w;
        const double zero = controller.gains[k + 1], pole = controller.gains[k + 2];
        const Complex above{square, 2.0 * zero * value * w};
        const Complex below{square, 2.0 * pole * value * w};
        compensator *= above / below;
        const auto by_frequency = [&](double damping) {
          return Complex{2.0 * value * value, 2.0 * damping * value * w};
        };
        response.by_gain[k] = by_frequency(zero) / above - by_frequency(pole) / below;
        response.by_gain[k + 1] = Complex{0.0, above.imag()} / above;
        response.by_gain[k + 2] = -Complex{0.0, below.imag()} / below;
        break;
      }
    }
    k += block.gains.size();
  }
  return response;
}

plant::StateSpace with_rate_command(const plant::StateSpace& controller) {
  const Eigen::Index encoder = plant::input_index(controller, "encoder");
  const Eigen::Index inputs = controller.b.cols();
  plant::StateSpace system = controller;
  system.inputs.emplace_back("rate_disturbance");
  system.outputs.emplace_back("rate_command");
  system.b.conservativeResize(Eigen::NoChange, inputs + 1);
  system.b.col(inputs) = -controller.b.col(encoder);
  system.c.conservativeResize(2, Eigen::NoChange);
  system.c.row(1).setZero();
  system.d = Eigen::MatrixXd::Zero(2, inputs + 1);
  system.d.topLeftCorner(1, inputs) = controller.d;
  system.d(0, inputs) = -controller.d(0, encoder);
  system.d(1, encoder) = -1.0;
  system.d(1, inputs) = 1.0;
  return system;
}

double static_encoder_gain(const Controller& controller) {
  if (const plant::StateSpace* system = controller.structure.state_space()) {
    const Eigen::Index column = plant::input_index(*system, "encoder");
    const Eigen::Index row = plant::output_index(*system, "valve_demand");
    const double found =
        std::abs(numerics::transfer_matrix(system->a, system->b.col(column), system->c.row(row),
                                           system->d.block(row, column, 1, 1), 1.0)(0, 0));
    return std::isfinite(found) ? found : std::numeric_limits<double>::infinity();
  }
  const bool holds = controller.structure.has_conditional_integral();
  double product = 1.0;
  for (const LoopPath path : {LoopPath::rate, LoopPath::position}) {
    for (const auto& [block, gains] : blocks_of(controller, path)) {
      if (block->kind == BlockKind::integral && (path == LoopPath::rate || !holds)) {
        return std::numeric_limits<double>::infinity();
      }
      if (block->kind == BlockKind::gain) product *= gains[0];
    }
  }
  return product;
}

double nyquist_frequency(const Controller& controller) {
  const plant::StateSpace* system = controller.structure.state_space();
  return system != nullptr ? std::numbers::pi / system->sample_time
                           : std::numeric_limits<double>::infinity();
}

double sample_density(const Controller& controller, double angular_frequency) {
  const plant::StateSpace* system = controller.structure.state_space();
  if (system == nullptr) return 1.0;
  // At the frequency itself, to rounding, as where an integral over all samples ends.
  constexpr double rounding = 1e-12;
  if (angular_frequency > (1.0 + rounding) * nyquist_frequency(controller)) return 0.0;
  const double hold = hold_amplitude(angular_frequency, system->sample_time);
  return 1.0 / (hold * hold);
}

plant::StateSpace to_state_space(const Controller& controller) {
  validate(controller);
  if (const plant::StateSpace* sampled = controller.structure.state_space()) {
    return with_rate_command(continuous(*sampled));
  }
  const bool compliance = controller.structure.has(LoopPath::compliance);
  std::vector<plant::StateSpace> parts;
  std::vector<std::string> inputs{"tachometer", "encoder", "rate_disturbance"};
  if (compliance || controller.structure.has(LoopPath::pressure))
    inputs.emplace_back("motor_torque");
  if (compliance) {
    append(parts, chain(controller, LoopPath::compliance, "motor_torque", "bending"));
    parts.push_back(difference("encoder", "bending", "corrected_angle"));
  }
  append(parts, chain(controller, LoopPath::position, compliance ? "corrected_angle" : "encoder",
                      "position_output"));
  parts.push_back(difference("rate_disturbance", "position_output", "rate_command"));
  parts.push_back(difference("rate_command", "tachometer", "rate_error"));
  append_rate_controller(parts, controller);
  return plant::connect(parts, inputs, {"valve_demand", "rate_command"});
}

plant::StateSpace rate_loop_controller(const Controller& controller) {
  validate(controller);
  if (const plant::StateSpace* sampled = controller.structure.state_space()) {
    return without_encoder(continuous(*sampled));
  }
  std::vector<plant::StateSpace> parts{
      plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -1.0), {"tachometer"}, {"rate_error"})};
  append_rate_controller(parts, controller);
  std::vector<std::string> inputs{"tachometer"};
  if (controller.structure.has(LoopPath::pressure)) inputs.emplace_back("motor_torque");
  return plant::connect(parts, inputs, {"valve_demand"});
}

plant::StateSpace compliance_compensator(const Controller& controller) {
  validate(controller);
  if (!controller.structure.has(LoopPath::compliance)) {
    throw InvalidInput(
        fmt::format("controller: {} has no compliance compensation", controller.structure.name()));
  }
  return plant::connect(chain(controller, LoopPath::compliance, "motor_torque", "flexure"),
                        {"motor_torque"}, {"flexure"});
}

}  // namespace boresight::control
