#include <algorithm>

#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/plant/antenna/antenna_modal_system.hpp>

namespace boresight::control {
namespace {

plant::StateSpace adder(const std::string& first, const std::string& second,
                        const std::string& sum) {
  return plant::static_gain(Eigen::MatrixXd::Ones(1, 2), {first, second}, {sum});
}

// The controller and the sums around the plant's core, which takes the place of the plant.
void close_core(plant::ModalSystem& system, const plant::StateSpace& controller,
                const std::vector<std::string>& inputs, const std::vector<std::string>& outputs,
                double delay) {
  std::vector<std::string> all_inputs = inputs, all_outputs = outputs;
  for (const auto& names : {system.modes.displacements, system.modes.rates}) {
    std::copy_if(names.begin(), names.end(), std::back_inserter(all_inputs),
                 [](const std::string& name) { return !name.empty(); });
  }
  all_inputs.emplace_back("delayed_demand");
  all_outputs.insert(all_outputs.end(), system.modes.forces.begin(), system.modes.forces.end());
  all_outputs.emplace_back("valve_demand");
  system.core = plant::connect(
      {system.core, controller, adder("delayed_demand", "valve_disturbance", "valve_command")},
      all_inputs, all_outputs);
  system.dead_times = {{"valve_demand", "delayed_demand", delay}};
  system.inputs = inputs;
  system.outputs = outputs;
}

// Angles relative to the bull gear's, which goes: the rate loop alone does not see where the
// antenna stands.
void remove_free_angle(plant::StateSpace& core) {
  const auto place = [&](const char* name) {
    return std::find(core.states.begin(), core.states.end(), name) - core.states.begin();
  };
  const Eigen::Index motor = place("motor_angle"), bull = place("bull_gear_angle");
  core.a.row(motor) -= core.a.row(bull);
  core.b.row(motor) -= core.b.row(bull);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < core.a.rows(); ++i) {
    if (i != bull) kept.push_back(i);
  }
  core.a = core.a(kept, kept).eval();
  core.b = core.b(kept, Eigen::all).eval();
  core.c = core.c(Eigen::all, kept).eval();
  core.states.erase(core.states.begin() + bull);
}

// S = 1/(1 + L) at the valve command of the sampled loop.
plant::StateSpace sampled_sensitivity(const plant::AntennaPlant& antenna,
                                      const Controller& controller) {
  const double sample_time = controller.structure.state_space()->sample_time;
  plant::StateSpace loop = sampled_open_loop(
      sampled_loop(plant::to_state_space(antenna), controller, sample_time), "valve_command");
  // The command acts after a sample: L has no feedthrough.
  loop.a -= loop.b * loop.c;
  loop.c = -loop.c;
  loop.d.setOnes();
  return loop;
}

}  // namespace

plant::ModalSystem modal_closed_loop(const plant::AntennaPlant& antenna,
                                     const Controller& controller, double delay) {
  plant::ModalSystem system = plant::to_modal_system(antenna);
  close_core(
      system, to_state_space(controller), {"wind_torque", "rate_disturbance", "valve_disturbance"},
      {"beam", "encoder", "tachometer", "motor_torque", "rate_command", "valve_command"}, delay);
  return system;
}

std::array<PeakGain, 3> sensitivity_bounds(const plant::AntennaPlant& antenna,
                                           const Controller& controller, double delay,
                                           const PeakGainOptions& options) {
  if (controller.structure.state_space() != nullptr) {
    PeakGain none;
    none.lower = none.upper = 1.0;
    none.closed = true;
    return {none, peak_gain(sampled_sensitivity(antenna, controller), options), none};
  }
  const plant::ModalSystem both = modal_closed_loop(antenna, controller, delay);
  plant::ModalSystem rate = plant::to_modal_system(antenna);
  remove_free_angle(rate.core);
  close_core(rate, rate_loop_controller(controller), {"wind_torque", "valve_disturbance"},
             {"tachometer", "valve_command"}, delay);
  return {peak_gain(rate, "valve_disturbance", "valve_command", options),
          peak_gain(both, "valve_disturbance", "valve_command", options),
          peak_gain(both, "rate_disturbance", "rate_command", options)};
}

}  // namespace boresight::control
