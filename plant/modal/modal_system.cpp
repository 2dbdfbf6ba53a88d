#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {
namespace {

void check_shape(const char* what, Eigen::Index rows, Eigen::Index columns,
                 Eigen::Index expected_rows, Eigen::Index expected_columns) {
  if (rows != expected_rows || columns != expected_columns) {
    throw InvalidInput(fmt::format("modal system: expected {} as {} x {}, found {} x {}", what,
                                   expected_rows, expected_columns, rows, columns));
  }
}

void check_modes(const VibrationModes& modes) {
  const Eigen::Index count = modes.frequency.size();
  const auto forces = static_cast<Eigen::Index>(modes.forces.size());
  const auto displacements = static_cast<Eigen::Index>(modes.displacements.size());
  check_shape("the damping ratios", modes.damping_ratio.size(), 1, count, 1);
  check_shape("the force shapes", modes.force_shape.rows(), modes.force_shape.cols(), count,
              forces);
  check_shape("the displacement shapes", modes.displacement_shape.rows(),
              modes.displacement_shape.cols(), displacements, count);
  check_shape("the rates' names", static_cast<Eigen::Index>(modes.rates.size()), 1, displacements,
              1);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double frequency = modes.frequency[i];
    const double damping = modes.damping_ratio[i];
    if (!std::isfinite(frequency) || frequency < 0.0) {
      throw InvalidInput(fmt::format(
          "modal system: expected mode {} at 0 rad/s or above, found {} rad/s", i + 1, frequency));
    }
    if (!std::isfinite(damping) || damping < 0.0) {
      throw InvalidInput(
          fmt::format("modal system: expected mode {} with a damping ratio of 0 or above, found {}",
                      i + 1, damping));
    }
  }
  if (!modes.force_shape.allFinite() || !modes.displacement_shape.allFinite()) {
    throw InvalidInput("modal system: a mode shape has elements that are not finite");
  }
}

}  // namespace

void validate(const ModalSystem& system) {
  validate(system.core);
  if (system.core.sample_time != 0.0) {
    throw InvalidInput(
        fmt::format("modal system: expected a continuous core, found one sampled every {} s",
                    system.core.sample_time));
  }
  check_modes(system.modes);
  std::map<std::string, int> fed;
  for (const auto& name : system.core.inputs) fed[name] = 0;
  const auto feed = [&](const std::string& name) {
    ++fed[system.core.inputs[static_cast<std::size_t>(input_index(system.core, name))]];
  };
  for (const auto& name : system.inputs) feed(name);
  for (const auto& name : system.modes.displacements) {
    if (!name.empty()) feed(name);
  }
  for (const auto& name : system.modes.rates) {
    if (!name.empty()) feed(name);
  }
  for (const auto& dead_time : system.dead_times) {
    output_index(system.core, dead_time.from);
    feed(dead_time.to);
    if (!std::isfinite(dead_time.delay) || dead_time.delay < 0.0) {
      throw InvalidInput(
          fmt::format("modal system: expected a dead time from '{}' to '{}' of 0 s or more, "
                      "found {} s",
                      dead_time.from, dead_time.to, dead_time.delay));
    }
  }
  for (const auto& [name, times] : fed) {
    if (times != 1) {
      throw InvalidInput(fmt::format(
          "modal system: expected the core's input '{}' to be fed once, found {} feeding it", name,
          times == 0 ? "nothing" : fmt::format("{} things", times)));
    }
  }
  for (const auto& name : system.modes.forces) output_index(system.core, name);
  for (const auto& name : system.outputs) output_index(system.core, name);
}

ModalSystem without_modes(const StateSpace& system) {
  ModalSystem result;
  result.core = system;
  result.modes.force_shape.resize(0, 0);
  result.modes.displacement_shape.resize(0, 0);
  result.inputs = system.inputs;
  result.outputs = system.outputs;
  return result;
}

StateSpace to_state_space(const ModalSystem& system) {
  validate(system);
  if (!system.dead_times.empty()) {
    const auto& first = system.dead_times.front();
    throw InvalidInput(fmt::format(
        "to_state_space: the dead time from '{}' to '{}' has no finite state space; put a rational "
        "approximant into the core",
        first.from, first.to));
  }
  const VibrationModes& modes = system.modes;
  const Eigen::Index count = modes.frequency.size();
  const auto ports = static_cast<Eigen::Index>(modes.displacements.size());
  const std::string displacement = "modes.displacement.", rate = "modes.rate.";
  StateSpace structure{Eigen::MatrixXd::Zero(2 * count, 2 * count),
                       Eigen::MatrixXd::Zero(2 * count, modes.force_shape.cols()),
                       Eigen::MatrixXd::Zero(2 * ports, 2 * count),
                       Eigen::MatrixXd::Zero(2 * ports, modes.force_shape.cols()),
                       modes.forces,
                       {},
                       {}};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double w = modes.frequency[i];
    structure.a(2 * i, 2 * i + 1) = 1.0;
    structure.a(2 * i + 1, 2 * i) = -w * w;
    structure.a(2 * i + 1, 2 * i + 1) = -2.0 * modes.damping_ratio[i] * w;
    structure.b.row(2 * i + 1) = modes.force_shape.row(i);
    structure.c.col(2 * i).head(ports) = modes.displacement_shape.col(i);
    structure.c.col(2 * i + 1).tail(ports) = modes.displacement_shape.col(i);
    structure.states.push_back(fmt::format("mode.{}", i + 1));
    structure.states.push_back(fmt::format("mode.{}.rate", i + 1));
  }
  const auto add_outputs = [&](const std::vector<std::string>& names, const std::string& prefix) {
    for (std::size_t j = 0; j < names.size(); ++j) {
      structure.outputs.push_back(names[j].empty() ? fmt::format("{}{}", prefix, j + 1) : names[j]);
    }
  };
  add_outputs(modes.displacements, displacement);
  add_outputs(modes.rates, rate);
  return connect({system.core, structure}, system.inputs, system.outputs);
}

}  // namespace boresight::plant
