#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/command_loop.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

plant::StateSpace weighted_sum(double first, const std::string& first_name, double second,
                               const std::string& second_name, const std::string& name) {
  return plant::static_gain((Eigen::MatrixXd(1, 2) << first, second).finished(),
                            {first_name, second_name}, {name});
}

void rename_input(plant::StateSpace& system, const std::string& from, const std::string& to) {
  std::ranges::replace(system.inputs, from, to);
}

}  // namespace

plant::StateSpace rate_command_loop(const plant::StateSpace& plant, const Controller& controller,
                                    double delay) {
  plant::StateSpace state_space = rate_loop_controller(controller);
  rename_input(state_space, "tachometer", "rate_less_command");
  return plant::connect(
      {plant, weighted_sum(1.0, "tachometer", -1.0, "command", "rate_less_command"), state_space,
       delay_approximant(delay, delay_order, "valve_demand", "valve_command")},
      {"command", "wind_torque"}, {"tachometer", "motor_torque", "valve_demand"});
}

plant::StateSpace position_command_loop(const plant::StateSpace& plant,
                                        const Controller& controller, double delay) {
  plant::StateSpace state_space = to_state_space(controller);
  std::vector<plant::StateSpace> parts{
      plant, weighted_sum(1.0, "encoder", -1.0, "command", "angle_less_command"),
      weighted_sum(1.0, "valve_demand", 1.0, "valve_feedforward", "whole_demand"),
      delay_approximant(delay, delay_order, "whole_demand", "valve_command")};
  std::vector<std::string> inputs{"command", "rate_disturbance", "valve_feedforward",
                                  "wind_torque"};
  if (controller.structure.state_space() != nullptr) {
    // It has no rate command: motion is what it reads less what is commanded (AntennaController).
    std::vector<std::string> read{"tachometer", "encoder"};
    if (controller.structure.feeds_torque_back()) read.emplace_back("motor_torque");
    state_space = plant::subsystem(state_space, read, {"valve_demand"});
    rename_input(state_space, "tachometer", "rate_less_command");
    parts.push_back(weighted_sum(1.0, "tachometer", -1.0, "rate_disturbance", "rate_less_command"));
    if (controller.structure.feeds_torque_back()) {
      rename_input(state_space, "motor_torque", "torque_less_command");
      parts.push_back(
          weighted_sum(1.0, "motor_torque", -1.0, "torque_feedforward", "torque_less_command"));
      inputs.emplace_back("torque_feedforward");
    }
  }
  rename_input(state_space, "encoder", "angle_less_command");
  parts.push_back(std::move(state_space));
  return plant::connect(parts, inputs, {"encoder", "motor_torque", "whole_demand"});
}

}  // namespace boresight::control
