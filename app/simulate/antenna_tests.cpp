#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <boresight/app/simulate/antenna_tests.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
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

AntennaTest ramp(std::string name, std::string description, double sample_time, double peak,
                 double period, double periods, bool closed) {
  const double length = period * periods;
  return {std::move(name),
          std::move(description),
          sample_time,
          closed,
          false,
          sampled(length + 2.0 * rest, sample_time, [=](double t) {
            const double into = t - rest;
            return into < 0.0 || into > length ? 0.0 : peak * triangle(into / period);
          })};
}

AntennaTest slosh(double stroke, double sample_time) {
  return {"slosh",
          "the valve opens and closes suddenly",
          sample_time,
          false,
          true,
          sampled(10.0, sample_time, [=](double t) {
            if (t >= 1.0 && t < 2.0) return 0.3 * stroke;
            return t >= 6.0 && t < 7.0 ? -0.3 * stroke : 0.0;
          })};
}

AntennaTest constant_speed(double volts, double scale, double sample_time) {
  constexpr double half_period = 9.0;
  constexpr double length = 6.0 * half_period;
  return {fmt::format("constant-speed-{:g}V", volts),
          fmt::format("square wave of +-{:g} V of tachometer into the rate loop", volts),
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

AntennaTest valve_steps(double stroke, double sample_time) {
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
  return {"valve-steps",
          "small valve steps about a constant speed",
          sample_time,
          false,
          true,
          sampled(80.0, sample_time, [=](double t) {
            const auto* step =
                std::ranges::find_if(steps, [&](const Step& s) { return t < s.until; });
            return stroke * (0.1 + 0.02 * (step == steps.end() ? 0.0 : step->height));
          })};
}

AntennaTest valve_chirp(double stroke, double sample_time) {
  constexpr double lowest = 0.1;
  constexpr double highest = 8.0;
  constexpr double settle = 8.0;
  constexpr double length = 90.0;
  return {"valve-chirp",
          "valve sine, 0.1 to 8 Hz, on a bias",
          sample_time,
          false,
          false,
          sampled(settle + length + 2.0, sample_time, [=](double t) {
            const double into = std::clamp(t - settle, 0.0, length);
            const double octaves = std::log(highest / lowest);
            const double cycles = lowest * length / octaves * std::expm1(octaves * into / length);
            const bool on = t >= settle && t < settle + length;
            return stroke * (0.1 + (on ? 0.02 * std::sin(two_pi * cycles) : 0.0));
          })};
}

}  // namespace

const std::vector<std::string>& simulated_test_names() {
  static const std::vector<std::string> names{"slosh",          "fast-ramp",   "slow-ramp",
                                              "constant-speed", "valve-steps", "valve-chirp",
                                              "tracking",       "slew"};
  return names;
}

std::vector<AntennaTest> drive_tests(const io::Case& antenna, const std::string& name) {
  const auto& names = simulated_test_names();
  if (std::ranges::find(names, name) == names.end()) {
    throw InvalidInput(fmt::format("simulate: expected tests out of {}, found '{}'",
                                   fmt::join(names, ", "), name));
  }
  if (name == "tracking" || name == "slew") return {};
  const auto model = make_recorded_antenna(antenna);
  const double step = 1.0 / recorder_of(antenna).sample_rate.value;
  const double stroke = model.valve.stroke_limit;
  const auto [scale, full_scale] = tachometer_of(antenna);
  const double limit = full_scale * scale;
  if (name == "slosh") return {slosh(stroke, std::min(step, 1e-3))};
  if (name == "fast-ramp") {
    return {ramp(name, "triangle to the valve, fast enough to leave the recorder's range", step,
                 std::min(1.5 * limit, 0.9 * stroke), 16.0, 5.0, false)};
  }
  if (name == "slow-ramp") {
    return {ramp(name, "slow triangle into the rate loop, through breakaway", step, 0.053 * limit,
                 60.0, 2.0, true)};
  }
  if (name == "constant-speed") {
    // A factor of two apart, from just beyond breakaway to near the recorder's limit.
    std::vector<AntennaTest> tests;
    for (const double share : {0.025, 0.05, 0.1, 0.2, 0.4, 0.8}) {
      tests.push_back(constant_speed(share * limit / scale, scale, step));
    }
    return tests;
  }
  if (name == "valve-steps") return {valve_steps(stroke, step)};
  return {valve_chirp(stroke, step)};
}

}  // namespace boresight::app
