#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/design/simulation/drive_run.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;

constexpr double standstill = 0.02;    // rad/s of motor
constexpr double megapascal = 1e6;     // Pa
constexpr double full_command = 10.0;  // V

// In analog electronics.
plant::StateSpace state_space_of(const RateLoop& loop) {
  Eigen::MatrixXd error(1, 2);
  error << 1.0, -1.0;
  return {Eigen::MatrixXd::Zero(1, 1),
          error,
          Eigen::MatrixXd::Constant(1, 1, loop.gain * (two_pi * loop.corner)),
          loop.gain * error,
          {"rate_command", "tachometer"},
          {"valve_command"},
          {"rate_integral"}};
}

// A test's record under way: the channels that the run's samples give.
class Recording {
 public:
  Recording(DriveTestRecord& record, const plant::LowPass& filter, double interval, Index stride)
      : record_(record), filter_(filter), interval_(interval), stride_(stride) {}

  /// A channel that is written as it is, in its own unit.
  void add(std::string name, std::string unit, int decimals, const Eigen::VectorXd& signal) {
    record_.channels.push_back({std::move(name), std::move(unit), decimals, low_passed(signal)});
  }

  /// One behind a transducer, in units of `scale`; the fraction of its samples at a limit.
  double add(std::string name, std::string unit, int decimals, double scale,
             const plant::Sensor& sensor, const Eigen::VectorXd& signal, std::uint64_t seed,
             std::uint64_t stream) {
    const auto read = plant::readings(sensor, low_passed(signal), seed, stream);
    if (read.at_limit > 0) {
      record_.clipped.push_back(
          {name, read.at_limit, record_.sample_time * static_cast<double>(read.first_at_limit)});
    }
    record_.channels.push_back({std::move(name), std::move(unit), decimals, read.values / scale});
    return static_cast<double>(read.at_limit) / static_cast<double>(read.values.size());
  }

 private:
  Eigen::VectorXd low_passed(const Eigen::VectorXd& signal) const {
    return plant::filtered(filter_, signal, interval_, stride_);
  }

  DriveTestRecord& record_;
  plant::LowPass filter_;
  double interval_;
  Index stride_;
};

// A command at every `stride`-th part of its sample time.
Eigen::VectorXd refined(const DriveTest& test, Index stride) {
  Eigen::VectorXd fine((test.command.size() - 1) * stride + 1);
  for (Index k = 0; k < fine.size(); ++k) {
    const Index from = k / stride;
    const double fraction =
        test.held ? 0.0 : static_cast<double>(k % stride) / static_cast<double>(stride);
    fine[k] = fraction == 0.0
                  ? test.command[from]
                  : (1.0 - fraction) * test.command[from] + fraction * test.command[from + 1];
  }
  return fine;
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

// Samples of the run that fall between two of the record.
Index stride_of(const TestedDrive& drive, double sample_time) {
  double fastest_line = 0.0;
  for (const auto& line : drive.antenna.oil.lines) {
    fastest_line = std::max(fastest_line, line.half_wave * drive.antenna.oil.modes_per_line);
  }
  return plant::steps_per_sample(drive.recorder.low_pass, sample_time, fastest_line);
}

plant::FeedbackSystem system_of(const TestedDrive& drive, bool rate_loop_closed) {
  const auto open = plant::to_feedback_system(drive.antenna);
  return rate_loop_closed ? plant::closed(open, state_space_of(drive.rate_loop)) : open;
}

plant::SimulationPlan plan_of(const TestedDrive& drive, const DriveTest& test, Index states,
                              Index stride, const RunProgress& progress) {
  plant::SimulationPlan plan;
  plan.interval = test.sample_time / static_cast<double>(stride);
  const Eigen::VectorXd at_rest = plant::state_held_by_friction(drive.antenna);
  plan.state = Eigen::VectorXd::Zero(states);
  plan.state.head(at_rest.size()) = at_rest;
  plan.signals = {test.rate_loop_closed ? "rate_command" : "valve_command"};
  plan.values = refined(test, stride);
  plan.held = {test.held};
  if (progress) {
    plan.progress = [&progress](Index done, Index all) {
      return progress(static_cast<double>(done) / static_cast<double>(all));
    };
  }
  return plan;
}

// The true motion: what is in the result beside the channels.
void add_motion(DriveTestRecord& record, const plant::NonlinearAntenna& antenna,
                const plant::SimulationResult& run, const Eigen::VectorXd& valve, double interval) {
  const Eigen::VectorXd rate = column(run, "motor_rate");
  const Eigen::VectorXd angle = column(run, "motor_angle");
  const Eigen::VectorXd friction = column(run, "friction_torque");
  record.largest_rate = largest(rate);
  record.largest_torque = largest(column(run, "motor_torque"));
  for (Index k = 0; k < rate.size(); ++k) {
    if (std::abs(rate[k]) >= standstill) continue;
    const double offset = plant::offset_torque(antenna.offset, angle[k]).value;
    record.static_friction = std::max(record.static_friction, std::abs(friction[k] - offset));
  }
  record.curve_breakaway = antenna.friction.curve.breakaway_torque;
  record.events = plant::events_of(antenna, run, valve, interval);
}

void add_ports(Recording& recording, const plant::SimulationResult& run,
               const plant::RecorderSensors& sensors, double resolution, std::uint64_t noise) {
  const int decimals = decimals_of(resolution / megapascal);
  for (std::size_t motor = 0; motor < sensors.inlet.size(); ++motor) {
    recording.add(fmt::format("p{}_in", motor + 1), "MPa", decimals, megapascal,
                  sensors.inlet[motor], column(run, fmt::format("inlet_pressure_{}", motor + 1)),
                  noise, 2 * motor);
    recording.add(fmt::format("p{}_out", motor + 1), "MPa", decimals, megapascal,
                  sensors.outlet[motor], column(run, fmt::format("outlet_pressure_{}", motor + 1)),
                  noise, 2 * motor + 1);
  }
}

}  // namespace

DriveTestRecord run_drive_test(const TestedDrive& drive, const DriveTest& test, std::uint64_t seed,
                               const RunProgress& progress) {
  const plant::NonlinearAntenna& antenna = drive.antenna;
  const plant::Recorder& recorder = drive.recorder;
  const std::size_t motors = antenna.oil.lines.size();
  if (motors == 0) {
    throw InvalidInput(
        "run_drive_test: expected an oil line to each motor, at whose ends pressures are read, "
        "found none");
  }
  if (test.command.size() == 0) {
    throw InvalidInput("run_drive_test: expected a command of at least one sample, found none");
  }
  const auto sensors = plant::drawn_sensors(recorder, motors, seed);
  const auto system = system_of(drive, test.rate_loop_closed);
  const Index stride = stride_of(drive, test.sample_time);
  const auto plan = plan_of(drive, test, system.linear.a.rows(), stride, progress);
  const auto run = plant::simulate(system, plan);
  const Index steps = run.values.rows();
  const Index samples = (steps + stride - 1) / stride;
  const Eigen::VectorXd command = plan.values.col(0).head(steps);
  const Eigen::VectorXd valve = test.rate_loop_closed ? column(run, "valve_command") : command;

  DriveTestRecord record;
  record.test = test.name;
  record.kind = test.kind;
  record.tachometer_volts = test.tachometer_volts;
  record.complete = run.complete;
  record.sample_time = test.sample_time;
  record.duration = test.sample_time * static_cast<double>(samples - 1);
  record.planned_duration = test.sample_time * static_cast<double>(test.command.size() - 1);
  add_motion(record, antenna, run, valve, plan.interval);

  record.channels.push_back({"time", "s", decimals_of(0.5 * test.sample_time),
                             Eigen::VectorXd::LinSpaced(samples, 0.0, record.duration)});
  Recording recording(record, recorder.low_pass, plan.interval, stride);
  const std::uint64_t noise = noise_seed(seed, test.name);
  add_ports(recording, run, sensors, recorder.pressure.resolution, noise);
  record.at_limit = recording.add("tach", "V", 4, recorder.tachometer.scale, sensors.tachometer,
                                  column(run, "tachometer"), noise, 2 * motors);
  recording.add("rate_command", "V", 4,
                test.rate_loop_closed ? (full_command / drive.slew_rate * command).eval()
                                      : Eigen::VectorXd::Zero(steps).eval());
  recording.add("valve_command", "V", 4, full_command / antenna.valve.stroke_limit * valve);
  return record;
}

}  // namespace boresight::design
