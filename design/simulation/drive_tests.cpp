#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <boresight/design/simulation/drive_tests.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

constexpr double rest = 1.0;  // s before and after every excitation

// 0 at 0, 1 after a quarter of the period, -1 after three quarters.
double triangle(double cycles) {
  const double a = cycles - 0.25 - std::floor(cycles - 0.25);
  return 4.0 * std::abs(a - 0.5) - 1.0;
}

Eigen::VectorXd sampled(double duration, double sample_time,
                        const std::function<double(double)>& command) {
  const auto samples = static_cast<Eigen::Index>(std::llround(duration / sample_time)) + 1;
  Eigen::VectorXd values(samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    values[k] = command(sample_time * static_cast<double>(k));
  }
  return values;
}

DriveTest ramp(DriveTestKind kind, double sample_time, double peak, double period, double periods,
               bool closed) {
  const double length = period * periods;
  return {kind,
          std::string(to_string(kind)),
          0.0,
          sample_time,
          closed,
          false,
          sampled(length + 2.0 * rest, sample_time, [=](double t) {
            const double into = t - rest;
            return into < 0.0 || into > length ? 0.0 : peak * triangle(into / period);
          })};
}

// One to the valve.
DriveTest valve_test(DriveTestKind kind, double sample_time, bool held, Eigen::VectorXd command) {
  return {kind, std::string(to_string(kind)), 0.0, sample_time, false, held, std::move(command)};
}

DriveTest slosh(double stroke, double sample_time) {
  return valve_test(DriveTestKind::slosh, sample_time, true,
                    sampled(10.0, sample_time, [=](double t) {
                      if (t >= 1.0 && t < 2.0) return 0.3 * stroke;
                      return t >= 6.0 && t < 7.0 ? -0.3 * stroke : 0.0;
                    }));
}

DriveTest constant_speed(double volts, double scale, double sample_time) {
  constexpr double half_period = 9.0;
  constexpr double length = 6.0 * half_period;
  return {DriveTestKind::constant_speed,
          fmt::format("{}-{:g}V", to_string(DriveTestKind::constant_speed), volts),
          volts,
          sample_time,
          true,
          true,
          sampled(length + 2.0 * rest, sample_time, [=](double t) {
            const double into = t - rest;
            if (into < 0.0 || into >= length) return 0.0;
            const bool up = static_cast<long>(into / half_period) % 2 == 0;
            return (up ? 1.0 : -1.0) * volts * scale;
          })};
}

DriveTest valve_steps(double stroke, double sample_time) {
  // Dwell times and heights without a common period, so that no harmonic falls on a mode.
  struct Step {
    double until, height;
  };
  static constexpr std::array<Step, 12> steps{{{8.0, 0.0},
                                               {14.3, 1.0},
                                               {19.1, -0.6},
                                               {27.4, 0.7},
                                               {32.0, 0.0},
                                               {39.7, -1.0},
                                               {44.2, 0.4},
                                               {51.9, -0.3},
                                               {57.5, 0.9},
                                               {64.1, -0.8},
                                               {70.6, 0.2},
                                               {80.0, 0.0}}};
  return valve_test(
      DriveTestKind::valve_steps, sample_time, true, sampled(80.0, sample_time, [=](double t) {
        const auto* step = std::ranges::find_if(steps, [&](const Step& s) { return t < s.until; });
        return stroke * (0.1 + 0.02 * (step == steps.end() ? 0.0 : step->height));
      }));
}

DriveTest valve_chirp(double stroke, double sample_time) {
  constexpr double lowest = 0.1;
  constexpr double highest = 8.0;
  constexpr double settle = 8.0;
  constexpr double length = 90.0;
  return valve_test(DriveTestKind::valve_chirp, sample_time, false,
                    sampled(settle + length + 2.0, sample_time, [=](double t) {
                      const double into = std::clamp(t - settle, 0.0, length);
                      const double octaves = std::log(highest / lowest);
                      const double cycles =
                          lowest * length / octaves * std::expm1(octaves * into / length);
                      const bool on = t >= settle && t < settle + length;
                      return stroke * (0.1 + (on ? 0.02 * std::sin(two_pi * cycles) : 0.0));
                    }));
}

void require_above_0(const char* what, double value) {
  if (!(value > 0.0)) {
    throw InvalidInput(
        fmt::format("drive_tests: expected a recorder's {} above 0, found {:g}", what, value));
  }
}

constexpr std::array all_kinds{DriveTestKind::slosh,       DriveTestKind::fast_ramp,
                               DriveTestKind::slow_ramp,   DriveTestKind::constant_speed,
                               DriveTestKind::valve_steps, DriveTestKind::valve_chirp};

}  // namespace

std::string_view to_string(DriveTestKind kind) {
  switch (kind) {
    case DriveTestKind::slosh:
      return "slosh";
    case DriveTestKind::fast_ramp:
      return "fast-ramp";
    case DriveTestKind::slow_ramp:
      return "slow-ramp";
    case DriveTestKind::constant_speed:
      return "constant-speed";
    case DriveTestKind::valve_steps:
      return "valve-steps";
    case DriveTestKind::valve_chirp:
      return "valve-chirp";
  }
  return "";
}

std::optional<DriveTestKind> drive_test_kind(std::string_view name) {
  const auto* found =
      std::ranges::find_if(all_kinds, [&](DriveTestKind kind) { return to_string(kind) == name; });
  return found == all_kinds.end() ? std::nullopt : std::optional(*found);
}

const std::vector<std::string>& simulated_test_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto kind : all_kinds) all.emplace_back(to_string(kind));
    all.insert(all.end(), {"tracking", "slew"});
    return all;
  }();
  return names;
}

std::vector<DriveTest> drive_tests(const TestedDrive& drive, DriveTestKind kind) {
  const auto& tachometer = drive.recorder.tachometer;
  require_above_0("sample rate", drive.recorder.sample_rate);
  require_above_0("tachometer's scale", tachometer.scale);
  require_above_0("tachometer's limit", tachometer.limit);
  const double step = 1.0 / drive.recorder.sample_rate;
  const double stroke = drive.antenna.valve.stroke_limit;
  const double scale = tachometer.scale;
  const double limit = tachometer.limit * scale;
  std::vector<DriveTest> tests;
  switch (kind) {
    case DriveTestKind::slosh:
      tests.push_back(slosh(stroke, std::min(step, 1e-3)));
      break;
    case DriveTestKind::fast_ramp:
      tests.push_back(ramp(kind, step, std::min(1.5 * limit, 0.9 * stroke), 16.0, 5.0, false));
      break;
    case DriveTestKind::slow_ramp:
      tests.push_back(ramp(kind, step, 0.053 * limit, 60.0, 2.0, true));
      break;
    case DriveTestKind::constant_speed:
      // From just beyond breakaway to near the recorder's limit.
      for (const double fraction : {0.025, 0.05, 0.1, 0.2, 0.4, 0.8}) {
        tests.push_back(constant_speed(fraction * limit / scale, scale, step));
      }
      break;
    case DriveTestKind::valve_steps:
      tests.push_back(valve_steps(stroke, step));
      break;
    case DriveTestKind::valve_chirp:
      tests.push_back(valve_chirp(stroke, step));
      break;
  }
  return tests;
}

}  // namespace boresight::design
