#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/design/verification/friction_loop.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/friction_time_stepping.hpp>
#include <boresight/plant/nonlinear/sensor.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;

plant::FrictionAntenna friction_antenna(const SimulatedLoop& loop) {
  plant::FrictionAntenna antenna;
  antenna.linear = loop.linear;
  antenna.linear.drive.viscous_friction = loop.antenna.viscous_friction;
  antenna.friction = loop.antenna.friction;
  antenna.offset_torque = plant::offset_torque(loop.antenna.offset, 0.0).value;
  const plant::OilCircuit& oil = loop.antenna.oil;
  if (oil.supply_torque > oil.return_torque) {
    antenna.supply_torque = oil.supply_torque - oil.return_torque;
  }
  return antenna;
}

// In a sample time, so that a step is short for the motor's oscillation on its bristles.
int steps_of(const SimulatedLoop& loop) {
  constexpr double longest_step = 0.1;  // rad
  constexpr double most = 20.0;
  const double frequency =
      std::sqrt(loop.antenna.friction.bristle_stiffness / loop.linear.drive.motor_inertia);
  constexpr double fewest = 4.0;
  return static_cast<int>(
      std::clamp(std::ceil(loop.sample_time * frequency / longest_step), fewest, most));
}

control::AntennaController controller_of(const SimulatedLoop& loop) {
  control::AntennaControllerOptions options;
  options.anti_windup = loop.anti_windup;
  options.command_limit = loop.antenna.valve.stroke_limit;
  options.feedforward = feedforward_of(loop);
  return {loop.controller, loop.sample_time, options};
}

}  // namespace

LoopRun run_friction_loop(const SimulatedLoop& loop, const ReferenceTrajectory& course) {
  const Index samples = course.reference.size();
  if (samples < 2 || course.reference_rate.size() != samples ||
      course.reference_acceleration.size() != samples || course.interval != loop.sample_time) {
    throw InvalidInput(fmt::format(
        "run_friction_loop: expected references of one length of at least 2 and an interval of "
        "the sample time {} s, found {}, {}, {} and {} s",
        loop.sample_time, samples, course.reference_rate.size(),
        course.reference_acceleration.size(), course.interval));
  }
  const int steps = steps_of(loop);
  plant::FrictionTimeStepping antenna(friction_antenna(loop), loop.sample_time / steps);
  control::AntennaController controller = controller_of(loop);
  LoopRun run;
  try {
    const double lead = controller.start_from(
        {antenna.holding_command(), antenna.tachometer(), antenna.motor_torque()});
    run.reference = course.reference.array() - (course.reference[0] + lead);
  } catch (const NumericalFailure& failure) {
    run.status = RunStatus::failed;
    run.message = failure.what();
    return run;
  }
  const bool reads_torque = loop.controller.structure.feeds_torque_back();
  plant::Sensor tachometer, encoder;
  tachometer.resolution = loop.tachometer_resolution;
  encoder.resolution = loop.encoder_resolution;
  const double factor = plant::boresight_factor(loop.linear.structure);

  run.encoder_error.resize(samples);
  run.boresight_error.resize(samples);
  run.result.names = {"valve_command"};
  run.result.values.resize(samples, 1);
  Eigen::VectorXd measured(reads_torque ? 6 : 5);
  Eigen::VectorXd command = Eigen::VectorXd::Zero(1);
  for (Index k = 0; k < samples; ++k) {
    run.encoder_error[k] = (antenna.encoder() - run.reference[k]) / loop.gear_ratio;
    run.boresight_error[k] = (antenna.boresight() - factor * run.reference[k]) / loop.gear_ratio;
    const double acting = command[0];  // that of the sample before
    run.result.values(k, 0) = acting;
    if (!(std::abs(run.encoder_error[k]) <= lost_error)) {
      run.status = RunStatus::lost;
      run.message = fmt::format("the encoder is more than {:.3g} rad off after {:.3g} s",
                                lost_error, course.interval * static_cast<double>(k));
      run.result.complete = false;
      run.result.values.conservativeResize(k + 1, Eigen::NoChange);
      for (auto* one : {&run.reference, &run.encoder_error, &run.boresight_error}) {
        one->conservativeResize(k + 1);
      }
      break;
    }
    measured[0] = plant::reading(tachometer, antenna.tachometer(), 0.0);
    measured[1] = plant::reading(encoder, antenna.encoder(), 0.0);
    if (reads_torque) measured[2] = antenna.motor_torque();
    measured.tail(3) << run.reference[k], course.reference_rate[k],
        course.reference_acceleration[k];
    controller.update(course.interval * static_cast<double>(k), measured, command);
    for (int step = 0; step < steps; ++step) antenna.advance(acting);
  }
  return run;
}

}  // namespace boresight::design
