#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/simulate/drive_run.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/recorder_filter.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

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

// A test's record under way: the channels that the run's samples give.
class Recording {
 public:
  Recording(DriveRecord& record, const io::Case& antenna, double interval, Index stride)
      : record_(record), filter_(low_pass_of(antenna)), interval_(interval), stride_(stride) {}

  /// A channel that is written as it is, in its own unit.
  void add(std::string name, std::string unit, int decimals, const Eigen::VectorXd& signal) {
    record_.record.columns.push_back(
        {std::move(name), std::move(unit), decimals, low_passed(signal)});
  }

  /// One behind a transducer, in units of `scale`; the share of its samples at a limit.
  double add(std::string name, std::string unit, int decimals, double scale,
             const plant::Sensor& sensor, const Eigen::VectorXd& signal, std::uint64_t seed,
             std::uint64_t stream) {
    const auto read = plant::readings(sensor, low_passed(signal), seed, stream);
    if (read.at_limit > 0) {
      record_.clipped.push_back(
          {name, read.at_limit, record_.sample_time * static_cast<double>(read.first_at_limit)});
    }
    record_.record.columns.push_back(
        {std::move(name), std::move(unit), decimals, read.values / scale});
    return static_cast<double>(read.at_limit) / static_cast<double>(read.values.size());
  }

 private:
  Eigen::VectorXd low_passed(const Eigen::VectorXd& signal) const {
    return filtered(filter_, signal, interval_, stride_);
  }

  DriveRecord& record_;
  LowPass filter_;
  double interval_;
  Index stride_;
};

// A command at every `stride`-th part of its sample time.
Eigen::VectorXd refined(const AntennaTest& test, Index stride) {
  Eigen::VectorXd fine((test.command.size() - 1) * stride + 1);
  for (Index k = 0; k < fine.size(); ++k) {
    const Index from = k / stride;
    const double share =
        test.held ? 0.0 : static_cast<double>(k % stride) / static_cast<double>(stride);
    fine[k] = share == 0.0 ? test.command[from]
                           : (1.0 - share) * test.command[from] + share * test.command[from + 1];
  }
  return fine;
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

// Gains and zeros are the sensors' and the same in every test; noise is not.
std::uint64_t noise_seed(std::uint64_t seed, const std::string& test) {
  std::uint64_t hash = 14695981039346656037ULL ^ seed;  // FNV-1a
  for (const char c : test) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return hash;
}

// Digits behind the point that show a fifth of a sensor's step.
int decimals_of(double resolution) {
  return resolution > 0.0
             ? std::clamp(static_cast<int>(std::ceil(-std::log10(resolution / 5.0))), 0, 9)
             : 6;
}

double largest(const Eigen::VectorXd& values) {
  return values.cwiseAbs().maxCoeff();
}

}  // namespace

DriveRecord run_drive_test(const io::Case& antenna, const AntennaTest& test, std::uint64_t seed,
                           const RunProgress& progress) {
  const auto model = make_recorded_antenna(antenna);
  const std::size_t motors = model.oil.lines.size();
  const RecorderSensors sensors = make_sensors(antenna, motors, seed);
  const auto drive = plant::to_feedback_system(model);
  const io::SimulationEntry& entry = simulation_of(antenna);
  const auto system = test.rate_loop_closed
                          ? plant::closed(drive, rate_loop(entry.rate_loop_gain.value,
                                                           two_pi * entry.rate_loop_corner.value))
                          : drive;
  plant::SimulationPlan plan;
  double fastest_line = 0.0;
  for (const auto& line : model.oil.lines) {
    fastest_line = std::max(fastest_line, line.half_wave * model.oil.modes_per_line);
  }
  const Index stride = steps_per_sample(low_pass_of(antenna), test.sample_time, fastest_line);
  plan.interval = test.sample_time / static_cast<double>(stride);
  plan.state = Eigen::VectorXd::Zero(system.linear.a.rows());
  const Eigen::VectorXd at_rest = held_by_friction(model);
  plan.state.head(at_rest.size()) = at_rest;
  plan.signals = {test.rate_loop_closed ? "rate_command" : "valve_command"};
  plan.values = refined(test, stride);
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
  const Index steps = run.values.rows();
  const Index samples = (steps + stride - 1) / stride;
  result.duration = test.sample_time * static_cast<double>(samples - 1);
  const Eigen::VectorXd rate = column(run, "motor_rate");
  const Eigen::VectorXd angle = column(run, "motor_angle");
  const Eigen::VectorXd friction = column(run, "friction_torque");
  result.largest_rate = largest(rate);
  result.largest_torque = largest(column(run, "motor_torque"));
  for (Index k = 0; k < steps; ++k) {
    if (std::abs(rate[k]) >= standstill) continue;
    const double offset = plant::offset_torque(model.offset, angle[k]).value;
    result.static_friction = std::max(result.static_friction, std::abs(friction[k] - offset));
  }
  result.curve_breakaway = model.friction.curve.breakaway_torque;
  const Eigen::VectorXd command = plan.values.col(0).head(steps);
  const Eigen::VectorXd valve = test.rate_loop_closed ? column(run, "valve_command") : command;
  result.events = events_of(model, run, valve, plan.interval);

  if (!run.complete) {
    result.record.comments.push_back(
        fmt::format("incomplete: interrupted after {:.3f} s of {:.3f} s", result.duration,
                    test.sample_time * static_cast<double>(test.command.size() - 1)));
  }
  const double slew = antenna.drive.slew_rate.value * gear_ratio(antenna);
  result.record.columns.push_back({"time", "s", decimals_of(0.5 * test.sample_time),
                                   Eigen::VectorXd::LinSpaced(samples, 0.0, result.duration)});
  Recording recording(result, antenna, plan.interval, stride);
  const std::uint64_t noise = noise_seed(seed, test.name);
  const int decimals = decimals_of(recorder_of(antenna).pressure_resolution.value / megapascal);
  for (std::size_t motor = 0; motor < motors; ++motor) {
    recording.add(fmt::format("p{}_in", motor + 1), "MPa", decimals, megapascal,
                  sensors.inlet[motor], column(run, fmt::format("inlet_pressure_{}", motor + 1)),
                  noise, 2 * motor);
    recording.add(fmt::format("p{}_out", motor + 1), "MPa", decimals, megapascal,
                  sensors.outlet[motor], column(run, fmt::format("outlet_pressure_{}", motor + 1)),
                  noise, 2 * motor + 1);
  }
  result.at_limit = recording.add("tach", "V", 4, tachometer_scale(antenna), sensors.tachometer,
                                  column(run, "tachometer"), noise, 2 * motors);
  recording.add(
      "rate_command", "V", 4,
      test.rate_loop_closed ? (10.0 / slew * command).eval() : Eigen::VectorXd::Zero(steps).eval());
  recording.add("valve_command", "V", 4, 10.0 / model.valve.stroke_limit * valve);
  return result;
}

}  // namespace boresight::app
