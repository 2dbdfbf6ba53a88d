#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/studies/export_study.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

// Of the drive's largest rate and torque: beyond so many times a signal is no signal.
constexpr double fault_factor = 4.0;

}  // namespace

control::CommandLimits slew_limits(const Mission& mission, const SimulatedLoop& loop) {
  const double gear = loop.gear_ratio;
  const auto limits =
      achievable_limits(loop.antenna, plant::reflected_inertia(loop.linear),
                        {mission.antenna.drive.slew_rate * gear, slew_acceleration * gear});
  if (!(limits.rate > 0.0) || !(limits.acceleration > 0.0)) {
    throw InfeasibleRequirement("the supply cannot move the antenna against its friction");
  }
  return {limits.rate / gear, limits.acceleration / gear};
}

ExportedController exported_controller(const Mission& mission,
                                       const control::Controller& controller,
                                       const control::program::ComputerSignals& signals) {
  const TrackingProblem problem = tracking_problem(mission);
  const SimulatedLoop loop =
      make_simulated_loop(problem, plant::nonlinear_antenna(mission.antenna), controller);
  ExportedController exported;
  exported.controller = controller;
  exported.sample_time = loop.sample_time;
  exported.friction_feedforward = loop.friction_feedforward;
  auto& options = exported.options;
  options.feedforward = feedforward_of(loop);
  options.command_limit = loop.antenna.valve.stroke_limit;
  options.limits = slew_limits(mission, loop);
  options.gear_ratio = loop.gear_ratio;
  options.signals = signals;
  options.signals.largest_rate = fault_factor * options.command_limit;
  options.signals.largest_torque = fault_factor * loop.antenna.oil.supply_torque;
  // As asked, but for the rounding of the way to the motors and back.
  constexpr double rounding = 1e-12;
  exported.wanted = {mission.antenna.drive.slew_rate, slew_acceleration};
  exported.achievable_limits =
      options.limits.rate >= (1.0 - rounding) * exported.wanted.rate &&
      options.limits.acceleration >= (1.0 - rounding) * exported.wanted.acceleration;
  exported.program =
      control::program::controller_program(controller, exported.sample_time, options);
  exported.vectors = control::program::test_vectors(exported.program, options);
  return exported;
}

}  // namespace boresight::design
