#include "simulated_campaign.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include <boresight/identification/records/record_defects.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/recorder_filter.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::coverage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::TestKind;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double rest = 1.0;  // s before and after

struct DriveTest {
  std::string name;
  TestKind kind = TestKind::other;
  double sample_time = 0.0;
  double duration = 0.0;
  bool closed = false;                    // the command is the rate loop's; else the valve's
  std::function<double(double)> command;  // rad/s
};

// 0 at 0, 1 after a quarter of the period, -1 after three quarters.
double triangle(double cycles) {
  const double a = cycles - 0.25 - std::floor(cycles - 0.25);
  return 4.0 * std::abs(a - 0.5) - 1.0;
}

DriveTest ramp(const char* name, TestKind kind, double peak, double period, double periods,
               bool closed) {
  const double length = period * periods;
  return {name, kind, 0.005, length + 2.0 * rest, closed, [=](double t) {
            const double into = t - rest;
            return into < 0.0 || into > length ? 0.0 : peak * triangle(into / period);
          }};
}

double steps_about_a_speed(double t) {
  struct Step {
    double until, height;
  };
  static constexpr std::array<Step, 9> steps{{{7.0, 0.0},
                                              {13.3, 1.0},
                                              {18.1, -0.6},
                                              {25.4, 0.7},
                                              {30.0, 0.0},
                                              {36.7, -1.0},
                                              {41.2, 0.4},
                                              {47.9, -0.8},
                                              {55.0, 0.0}}};
  const auto* step = std::ranges::find_if(steps, [t](const Step& s) { return t < s.until; });
  return step == steps.end() ? 0.0 : step->height;
}

std::vector<DriveTest> campaign_tests(const RandomDrive& drive, const CampaignLength& lengths,
                                      std::vector<double>& speeds) {
  const double stroke = drive.antenna.valve.stroke_limit;
  const double limit = drive.rate_limit;
  std::vector<DriveTest> tests;
  tests.push_back({"slosh", TestKind::slosh, 0.001, 8.0, false, [=](double t) {
                     if (t >= 1.0 && t < 2.0) return 0.4 * stroke;
                     return t >= 5.0 && t < 6.0 ? -0.4 * stroke : 0.0;
                   }});
  tests.push_back(ramp("fast ramp", TestKind::fast_ramp, std::min(1.5 * limit, 0.9 * stroke), 14.0,
                       2.5, false));
  tests.push_back(ramp("slow ramp", TestKind::slow_ramp, 0.053 * limit, 40.0, 1.0, true));
  const double half_period = lengths.half_period;
  for (const double fraction : lengths.speeds) {
    const double speed = fraction * limit;
    speeds.push_back(speed);
    tests.push_back({fmt::format("constant speed {:g}", fraction), TestKind::constant_speed, 0.005,
                     4.0 * half_period + 2.0 * rest, true, [=](double t) {
                       const double into = t - rest;
                       if (into < 0.0 || into >= 4.0 * half_period) return 0.0;
                       return static_cast<long>(into / half_period) % 2 == 0 ? speed : -speed;
                     }});
  }
  tests.push_back({"valve steps", TestKind::valve_steps, 0.005, 55.0, false,
                   [=](double t) { return stroke * (0.1 + 0.02 * steps_about_a_speed(t)); }});
  constexpr double lowest = 0.1, octaves = 4.382026634673881, settle = 8.0;
  const double length = lengths.chirp;
  tests.push_back(
      {"valve chirp", TestKind::valve_chirp, 0.005, settle + length, false, [=](double t) {
         const double into = std::clamp(t - settle, 0.0, length);
         const double cycles = lowest * length / octaves * std::expm1(octaves * into / length);
         return stroke * (0.1 + (t >= settle ? 0.02 * std::sin(turn * cycles) : 0.0));
       }});
  return tests;
}

// u = r + ki/s (r - tachometer): the oil, not the loop, sets the ringing.
plant::StateSpace rate_loop(double integral_gain) {
  Eigen::MatrixXd error(1, 2), direct(1, 2);
  error << 1.0, -1.0;
  direct << 1.0, 0.0;
  return {Eigen::MatrixXd::Zero(1, 1),
          error,
          Eigen::MatrixXd::Constant(1, 1, integral_gain),
          direct,
          {"rate_command", "tachometer"},
          {"valve_command"},
          {"rate_integral"}};
}

// First-order noise of the wind's corner.
VectorXd wind_torque(const RandomDrive& drive, Index samples, double interval,
                     const numerics::NormalNumbers& numbers) {
  VectorXd torque(samples);
  const double keep = std::exp(-turn * drive.wind_corner * interval);
  const double fresh = std::sqrt(1.0 - keep * keep) * drive.wind_rms;
  double now = drive.wind_rms * numbers.pair(0).real();
  for (Index k = 0; k < samples; ++k) {
    torque[k] = now;
    now = keep * now + fresh * numbers.pair(static_cast<std::uint64_t>(k) + 1U).real();
  }
  return torque;
}

plant::NonlinearAntenna with_line_modes(plant::NonlinearAntenna antenna, int modes) {
  antenna.oil.modes_per_line = modes;
  return antenna;
}

struct MeanPressure {
  double sum = 0.0, time = 0.0;  // Pa s, s
};

class Bench {
 public:
  /// With so many modes of every line.
  Bench(const RandomDrive& drive, int modes_per_line, std::uint64_t seed)
      : drive_(drive),
        antenna_(with_line_modes(drive.antenna, modes_per_line)),
        seed_(seed),
        open_(plant::to_feedback_system(antenna_)),
        closed_(plant::closed(open_, rate_loop(drive.integral_gain))),
        start_(plant::state_held_by_friction(antenna_)) {}

  identification::RawRecord record(const DriveTest& test, std::uint64_t number,
                                   MeanPressure& mean) const;

 private:
  const RandomDrive& drive_;
  plant::NonlinearAntenna antenna_;
  std::uint64_t seed_;
  plant::FeedbackSystem open_, closed_;
  VectorXd start_;
};

identification::RawRecord Bench::record(const DriveTest& test, std::uint64_t number,
                                        MeanPressure& mean) const {
  const auto& system = test.closed ? closed_ : open_;
  const plant::LowPass filter{4, 0.35 / test.sample_time};
  double fastest_line = 0.0;
  for (const auto& line : antenna_.oil.lines) {
    fastest_line = std::max(fastest_line, line.half_wave * antenna_.oil.modes_per_line);
  }
  const Index stride = plant::steps_per_sample(filter, test.sample_time, fastest_line);
  plant::SimulationPlan plan;
  plan.interval = test.sample_time / static_cast<double>(stride);
  plan.state = VectorXd::Zero(system.linear.a.rows());
  plan.state.head(start_.size()) = start_;
  plan.signals = {test.closed ? "rate_command" : "valve_command", "wind_torque"};
  const auto steps = static_cast<Index>(std::llround(test.duration / plan.interval)) + 1;
  plan.values.resize(steps, 2);
  for (Index k = 0; k < steps; ++k) {
    // The command as a computer gives it out: held over the recorder's sample.
    const double t = test.sample_time * static_cast<double>(k / stride);
    plan.values(k, 0) = test.command(t);
  }
  plan.held = {true, false};
  const std::uint64_t streams = 100 * number;
  plan.values.col(1) =
      wind_torque(drive_, steps, plan.interval, numerics::NormalNumbers(seed_, streams + 99));
  const auto run = plant::simulate(system, plan);

  const auto recorded = [&](const VectorXd& signal) {
    return plant::filtered(filter, signal, plan.interval, stride);
  };
  identification::RawRecord raw;
  raw.name = test.name;
  raw.test = test.kind;
  raw.rate_loop_closed = test.closed;
  std::uint64_t stream = streams;
  const auto port = [&](const std::string& name, const plant::Sensor& sensor) {
    const VectorXd pressure = recorded(plant::column(run, name));
    mean.sum += pressure.sum() * test.sample_time;
    mean.time += static_cast<double>(pressure.size()) * test.sample_time;
    identification::RawChannel channel;
    channel.name = name;
    channel.values = plant::readings(sensor, pressure, seed_, stream++).values;
    return channel;
  };
  for (std::size_t motor = 0; motor < drive_.inlet.size(); ++motor) {
    raw.inlet.push_back(port(fmt::format("inlet_pressure_{}", motor + 1), drive_.inlet[motor]));
    raw.outlet.push_back(port(fmt::format("outlet_pressure_{}", motor + 1), drive_.outlet[motor]));
  }
  VectorXd rate = plant::column(run, "tachometer");
  const VectorXd angle = plant::column(run, "motor_angle");
  rate.array() *= 1.0 + drive_.tachometer_ripple * (drive_.ripple_order * angle.array()).sin();
  raw.tachometer.name = "tachometer";
  raw.tachometer.values =
      plant::readings(drive_.tachometer, recorded(rate), seed_, stream++).values;
  raw.tachometer.upper_limit = drive_.rate_limit;
  raw.tachometer.lower_limit = -drive_.rate_limit;
  const VectorXd command = plan.values.col(0);
  identification::RawChannel rate_command, valve_command;
  rate_command.name = "rate_command";
  rate_command.values =
      test.closed ? recorded(command) : VectorXd::Zero(raw.tachometer.values.size()).eval();
  valve_command.name = "valve_command";
  valve_command.values =
      drive_.valve_scale * recorded(test.closed ? plant::column(run, "valve_command") : command);
  raw.rate_command = rate_command;
  raw.valve_command = valve_command;
  raw.encoder.emplace();
  raw.encoder->name = "encoder";
  raw.encoder->values =
      plant::readings(drive_.encoder,
                      recorded(plant::column(run, "encoder")) / drive_.knowledge.gear_ratio, seed_,
                      streams + 98)
          .values;
  raw.time =
      VectorXd::LinSpaced(raw.tachometer.values.size(), 0.0,
                          test.sample_time * static_cast<double>(raw.tachometer.values.size() - 1));
  return raw;
}

double mean_gain(const RandomDrive& drive) {
  double sum = 0.0;
  for (const auto& sensor : drive.inlet) sum += sensor.gain;
  for (const auto& sensor : drive.outlet) sum += sensor.gain;
  return sum / static_cast<double>(drive.inlet.size() + drive.outlet.size());
}

// What unlike gains at a pressure of all ports and the zeros add up to, Pa.
double false_difference(const RandomDrive& drive, double common) {
  double sum = 0.0;
  for (const auto& sensor : drive.inlet) sum += sensor.gain * common + sensor.zero;
  for (const auto& sensor : drive.outlet) sum -= sensor.gain * common + sensor.zero;
  return sum;
}

}  // namespace

SimulatedCampaign simulate_campaign(const RandomDrive& drive, std::uint64_t seed,
                                    const CampaignLength& length) {
  SimulatedCampaign result;
  result.campaign.knowledge = drive.knowledge;
  result.campaign.instruments = drive.instruments;
  // Beyond the recorder's band of all tests but slosh the lines' second modes only cost time.
  const Bench lines(drive, 2, seed), bench(drive, 1, seed);
  MeanPressure mean;
  std::uint64_t number = 0;
  for (const auto& test : campaign_tests(drive, length, result.speeds)) {
    const Bench& on = test.kind == TestKind::slosh ? lines : bench;
    result.raw.push_back(on.record(test, number++, mean));
    auto clean = identification::clean_record(result.raw.back());
    if (!clean.record) {
      throw NumericalFailure(fmt::format("record {}: {}", test.name, clean.refusal));
    }
    result.campaign.records.push_back(std::move(*clean.record));
  }
  const double common = mean.sum / mean.time;
  // Recorded torque per true torque; torque_per_pressure of the knowledge is that of one motor.
  const double stated = identification::torque_per_pressure(drive.knowledge);
  const double gain =
      stated * drive.knowledge.motor_count / drive.torque_per_pressure * mean_gain(drive);
  result.inertia_as_recorded = drive.inertia * gain / drive.tachometer.gain;
  result.offset_as_recorded =
      gain * drive.antenna.offset.constant + stated * false_difference(drive, common);
  const auto& oil = drive.antenna.oil;
  result.oil_stiffness =
      drive.oil_stiffness * plant::stiffness_ratio(oil, common * oil.torque_per_pressure).value;
  return result;
}

}  // namespace boresight::coverage
