#include <fmt/format.h>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/friction_leeway.hpp>

namespace boresight::io {
namespace {

// Input of identification::steady_friction_intervals, in the order of the tests.
std::vector<identification::SteadyFriction> steady_friction(
    const std::vector<SteadyFrictionTest>& tests) {
  std::vector<identification::SteadyFriction> points;
  points.reserve(tests.size());
  for (const auto& test : tests) points.push_back({test.rate, test.torque, test.leeway});
  return points;
}

}  // namespace

bool is_loose(const identification::FrictionInterval& interval) {
  constexpr double widest_factor = 1.5;
  return interval.min_open || interval.largest_open ||
         interval.largest > widest_factor * interval.minimum;
}

std::optional<identification::FrictionInterval> loose_stribeck_rate(
    const FrictionCurveEntry& curve) {
  if (curve.tests.empty()) return std::nullopt;
  const auto points = steady_friction(curve.tests);
  if (identification::steady_friction_freedom(points) > 0) return std::nullopt;
  const auto rate = identification::steady_friction_intervals(points).stribeck_rate;
  return rate && is_loose(*rate) ? rate : std::nullopt;
}

std::string loose_stribeck_text(const FrictionCurveEntry& curve) {
  const auto rate = loose_stribeck_rate(curve);
  if (!rate) return "";
  return fmt::format(
      "Limit cycles, reversals and what flywheels do to them depend on the friction curve's "
      "Stribeck rate "
      "of {:.3g} rad/s, which the {} tests, as many as the curve has unknowns, leave at {} as one "
      "torque is moved by its uncertainty, or by half its last digit: more tests at low rates "
      "settle it.",
      curve.stribeck_rate.value, curve.tests.size(), in_words(*rate, "rad/s"));
}

void conclude_friction_doubt(const Case& antenna, std::vector<std::string>& sentences) {
  if (!antenna.simulation) return;
  std::string doubt = loose_stribeck_text(*antenna.friction_curve);
  if (!doubt.empty()) sentences.push_back(std::move(doubt));
}

std::string in_words(const identification::FrictionInterval& interval, std::string_view unit) {
  if (interval.minimum == interval.largest && interval.min_open != interval.largest_open) {
    return fmt::format("{:.3g} {} (its bound) or {}", interval.minimum, unit,
                       interval.min_open ? "less" : "more");
  }
  return fmt::format("{:.3g}{} to {:.3g} {}{}", interval.minimum,
                     interval.min_open ? " (its bound)" : "", interval.largest, unit,
                     interval.largest_open ? " (its bound)" : "");
}

std::string_view moved_torques() {
  return "With one torque after another moved up and down by its standard uncertainty, or by "
         "half a unit of its last digit where none is stated,";
}

}  // namespace boresight::io
