#include <algorithm>
#include <cmath>

#include <boresight/plant/antenna/antenna_modal_system.hpp>

namespace boresight::plant {
namespace {

// The core with more inputs and outputs than it has.
void widen(StateSpace& system, const std::vector<std::string>& inputs,
           const std::vector<std::string>& outputs) {
  const Eigen::Index n = system.a.rows(), m = system.b.cols(), p = system.c.rows();
  const auto more_inputs = static_cast<Eigen::Index>(inputs.size());
  const auto more_outputs = static_cast<Eigen::Index>(outputs.size());
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n, m + more_inputs);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(p + more_outputs, n);
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(p + more_outputs, m + more_inputs);
  b.leftCols(m) = system.b;
  c.topRows(p) = system.c;
  d.topLeftCorner(p, m) = system.d;
  system.b = b;
  system.c = c;
  system.d = d;
  system.inputs.insert(system.inputs.end(), inputs.begin(), inputs.end());
  system.outputs.insert(system.outputs.end(), outputs.begin(), outputs.end());
}

}  // namespace

ModalSystem to_modal_system(const AntennaPlant& plant) {
  to_state_space(plant);  // refuses what has no meaning
  AntennaPlant bare = plant;
  bare.structure.modes.clear();
  ModalSystem system;
  StateSpace& core = system.core;
  core = to_state_space(bare);
  system.inputs = core.inputs;
  system.outputs = core.outputs;
  widen(core, {"structure_spring", "structure_damping", "structure_bending"},
        {"bull_gear_acceleration", "structure_wind"});
  const auto state = [&](const char* name) {
    return std::find(core.states.begin(), core.states.end(), name) - core.states.begin();
  };
  const Eigen::Index rate = state("bull_gear_rate");
  const Eigen::Index wind = input_index(core, "wind_torque");
  const Eigen::Index spring = input_index(core, "structure_spring");
  const Eigen::Index damping = input_index(core, "structure_damping");
  const Eigen::Index acceleration = output_index(core, "bull_gear_acceleration");
  const Eigen::Index boresight = output_index(core, "beam");
  core.b(rate, spring) = core.b(rate, damping) = 1.0 / plant.structure.bull_gear_inertia;
  core.c.row(acceleration) = core.a.row(rate);
  core.d.row(acceleration) = core.b.row(rate);
  core.d(output_index(core, "structure_wind"), wind) = 1.0;
  core.d(boresight, input_index(core, "structure_bending")) = 1.0;

  const auto count = static_cast<Eigen::Index>(plant.structure.modes.size());
  VibrationModes& modes = system.modes;
  modes.forces = {"bull_gear_acceleration", "structure_wind"};
  modes.displacements = {"structure_spring", "", "structure_bending"};
  modes.rates = {"", "structure_damping", ""};
  modes.frequency.resize(count);
  modes.damping_ratio.resize(count);
  modes.force_shape.resize(count, 2);
  modes.displacement_shape.resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& mode = plant.structure.modes[static_cast<std::size_t>(i)];
    const double root = std::sqrt(mode.inertia);
    modes.frequency[i] = std::sqrt(mode.stiffness / mode.inertia);
    modes.damping_ratio[i] = 0.5 * mode.damping / std::sqrt(mode.stiffness * mode.inertia);
    modes.force_shape(i, 0) = -root;
    modes.force_shape(i, 1) = mode.wind_fraction / root;
    modes.displacement_shape(0, i) = mode.stiffness / root;
    modes.displacement_shape(1, i) = mode.damping / root;
    modes.displacement_shape(2, i) = mode.beam_weight / root;
    core.c(boresight, state("bull_gear_angle")) += mode.beam_weight;
  }
  return system;
}

}  // namespace boresight::plant
