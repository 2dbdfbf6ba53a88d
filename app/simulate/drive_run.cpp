#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/simulate/drive_run.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/plant/error.hpp>
#include <boresight/plant/feedback_interconnection.hpp>
#include <boresight/plant/operating_point.hpp>
#include <boresight/plant/simulation.hpp>

namespace boresight::app {
namespace {

using Eigen::Index;

constexpr double standstill = 0.02;  // rad/s of motor

// u = kr (1 + wi/s) (rate_command - tachometer), in analog electronics.
plant::StateSpace rate_loop(double gain, double corner) {
  Eigen::MatrixXd error(1, 2);
  error << 1.0, -1.0;
  return {Eigen::MatrixXd::Zero(1, 1),
          error,
          Eigen::MatrixXd::Constant(1, 1, gain * corner),
          gain * error,
          {"rate_command", "tachometer"},
          {"valve_command"},
          {"rate_integral"}};
}

Eigen::VectorXd column(const plant::SimulationResult& run, const std::string& name) {
  return run.values.col(std::ranges::find(run.names, name) - run.names.begin());
}

void add_pressures(CsvTable& record, const plant::SimulationResult& run,
                   const RecorderSensors& sensors, std::uint64_t seed) {
  for (std::size_t motor = 0; motor < sensors.inlet.size(); ++motor) {
    for (const bool inlet : {true, false}) {
      const auto& sensor = inlet ? sensors.inlet[motor] : sensors.outlet[motor];
      const auto read = plant::readings(
          sensor, column(run, fmt::format("{}_pressure_{}", inlet ? "inlet" : "outlet", motor + 1)),
          seed, 2 * motor + (inlet ? 0 : 1));
      record.columns.push_back(
          {fmt::format("p{}_{}", motor + 1, inlet ? "in" : "out"), "MPa", 6, 1e-6 * read.values});
    }
  }
}

// At rest with the bristles bent by gravity's offset; or, where that would break them away, with
// the offset carried by the pressures.
Eigen::VectorXd held_by_friction(const plant::NonlinearAntenna& model) {
  const double offset = plant::offset_torque(model.offset, 0.0).value;
  if (std::abs(offset) >= model.friction.curve.breakaway_torque) {
    return plant::trim(model, {}).state;
  }
  Eigen::VectorXd state = plant::state_at_rest(model);
  state[plant::AntennaStates::bristle] = -offset / model.friction.bristle_stiffness;
  return state;
}

double largest(const Eigen::VectorXd& values) {
  return values.cwiseAbs().maxCoeff();
}

}  // namespace

DriveRecord run_drive_test(const Case& antenna, const AntennaTest& test, std::uint64_t seed,
                           const RunProgress& progress) {
  const auto model = make_nonlinear_antenna(antenna);
  const std::size_t motors = model.oil.lines.size();
  if (motors == 0) {
    throw InvalidInput(
        fmt::format("{}: expected [[oil.line]] entries, whose ends the recorder's transducers sit "
                    "at, found none",
                    antenna.path));
  }
  const RecorderSensors sensors = make_sensors(antenna, motors, seed);
  const auto drive = plant::to_feedback_system(model);
  const SimulationEntry& entry = simulation_of(antenna);
  const auto system =
      test.rate_loop_closed
          ? plant::closed(drive, rate_loop(entry.rate_loop_gain.value,
                                           2.0 * std::numbers::pi * entry.rate_loop_corner.value))
          : drive;
  plant::SimulationPlan plan;
  plan.interval = test.sample_time;
  plan.state = Eigen::VectorXd::Zero(system.linear.a.rows());
  const Eigen::VectorXd at_rest = held_by_friction(model);
  plan.state.head(at_rest.size()) = at_rest;
  plan.signals = {test.rate_loop_closed ? "rate_command" : "valve_command"};
  plan.values = test.command;
  plan.held = {test.held};
  if (progress) {
    plan.progress = [&](Index done, Index all) {
      return progress(static_cast<double>(done) / static_cast<double>(all));
    };
  }
  const auto run = plant::simulate(system, plan);

  DriveRecord result;
  result.test = test.name;
  result.description = test.description;
  result.complete = run.complete;
  result.sample_time = test.sample_time;
  const Index samples = run.values.rows();
  result.duration = test.sample_time * static_cast<double>(samples - 1);
  const Eigen::VectorXd rate = column(run, "motor_rate");
  const Eigen::VectorXd friction = column(run, "friction_torque");
  result.largest_rate = largest(rate);
  result.largest_torque = largest(column(run, "motor_torque"));
  const double offset = plant::offset_torque(model.offset, 0.0).value;
  for (Index k = 0; k < samples; ++k) {
    if (std::abs(rate[k]) < standstill) {
      result.static_friction = std::max(result.static_friction, std::abs(friction[k] - offset));
    }
  }

  auto& record = result.record;
  if (!run.complete) {
    record.comments.push_back(
        fmt::format("incomplete: interrupted after {:.3f} s of {:.3f} s", result.duration,
                    test.sample_time * static_cast<double>(test.command.size() - 1)));
  }
  const double slew = antenna.drive.slew_rate.value * gear_ratio(antenna);
  record.columns.push_back(
      {"time", "s", 6, Eigen::VectorXd::LinSpaced(samples, 0.0, result.duration)});
  add_pressures(record, run, sensors, seed);
  const auto tachometer =
      plant::readings(sensors.tachometer, column(run, "tachometer"), seed, 2 * motors);
  result.at_limit = static_cast<double>(tachometer.at_limit) / static_cast<double>(samples);
  record.columns.push_back({"tach", "V", 4, tachometer.values / tachometer_scale(antenna)});
  const Eigen::VectorXd command = test.command.head(samples);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(samples);
  record.columns.push_back(
      {"rate_command", "V", 4, test.rate_loop_closed ? (10.0 / slew * command).eval() : none});
  const Eigen::VectorXd valve = test.rate_loop_closed ? column(run, "valve_command") : command;
  record.columns.push_back({"valve_command", "V", 4, 10.0 / model.valve.stroke_limit * valve});
  return result;
}

}  // namespace boresight::app
