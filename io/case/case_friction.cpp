#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <fmt/format.h>

#include <boresight/identification/friction/steady_friction.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr std::array curve_keys{"coulomb",    "breakaway",       "stribeck_rate",
                                "saturating", "saturating_rate", "viscous"};

struct SteadyTest {
  Quantity rate;            // as said, of the antenna's axis or of the motors
  double motor_rate = 0.0;  // rad/s
  Quantity said;            // as a torque or a pressure
  double torque = 0.0;
  double leeway = 0.0;  // of the torque
  double relative_uncertainty = 0.0;
};

// Of this test alone: what all tests share moves none against another.
double leeway_of(const Quantity& said) {
  return said.uncertainty_given ? said.standard_uncertainty : said.half_unit;
}

// No axis turns faster: whoever says more means the motors.
void check_axis_rate(const TableReader& entry, const Quantity& rate) {
  constexpr double fastest = 10.0;  // rad/s
  if (rate.value <= fastest) return;
  entry.refuse("rate", fmt::format("expected a rate of the antenna's axis, at most {:g} rad/s, "
                                   "found {} (a rate of the motors is motor_rate)",
                                   fastest, in_quotes(rate.text)));
}

SteadyTest read_test(TableReader& entry, const Case& antenna) {
  SteadyTest test;
  const auto rate = entry.optional_quantity("rate", Kind::angular_rate, Range::not_negative());
  const auto motor_rate =
      entry.optional_quantity("motor_rate", Kind::angular_rate, Range::not_negative(1e5));
  const auto torque = entry.optional_quantity("torque", Kind::torque, Range::not_negative());
  const auto pressure =
      entry.optional_quantity("pressure", Kind::pressure, Range::not_negative(1e9));
  entry.finish();
  if (rate.has_value() == motor_rate.has_value()) {
    entry.refuse("rate", std::string("expected either rate (of the axis) or motor_rate, found ") +
                             (rate ? "both" : "neither"));
  }
  if (rate) {
    check_axis_rate(entry, *rate);
    test.rate = *rate;
    test.motor_rate = rate->value * gear_ratio(antenna);
  } else if (motor_rate) {
    test.rate = *motor_rate;
    test.motor_rate = motor_rate->value;
  }
  if (torque.has_value() == pressure.has_value()) {
    entry.refuse("torque", std::string("expected either torque or pressure, found ") +
                               (torque ? "both" : "neither"));
  }
  if (torque) {
    test.said = *torque;
    test.torque = torque->value;
    test.leeway = leeway_of(*torque);
    test.relative_uncertainty = relative_uncertainty(*torque);
  } else if (pressure) {
    test.said = *pressure;
    const double torque_per_pressure = plant::torque_per_pressure(hydraulic_drive(antenna));
    test.torque = pressure->value * torque_per_pressure;
    test.leeway = leeway_of(*pressure) * torque_per_pressure;
    test.relative_uncertainty = std::hypot(relative_uncertainty(*pressure),
                                           relative_uncertainty(antenna.motor->displacement),
                                           relative_uncertainty(antenna.motor->torque_efficiency));
  }
  return test;
}

// Tests are measured unless one says that it is not; what they do not tell follows from the rest.
Basis basis_of(const std::vector<SteadyTest>& tests) {
  Basis weakest = Basis::measured;
  for (const auto& test : tests) {
    weakest = std::max({weakest, test.said.basis, test.rate.basis});
  }
  return weakest;
}

void fit_tests(const std::vector<SteadyTest>& tests, FrictionCurveEntry& friction) {
  std::vector<identification::SteadyFriction> points;
  double squares = 0.0, sum = 0.0;
  for (const auto& test : tests) {
    points.push_back({test.motor_rate, test.torque, test.leeway});
    squares += std::pow(test.relative_uncertainty, 2);
    sum += test.torque;
  }
  const auto fit = identification::fit_steady_friction(points);
  // What the tests share, and what they scatter by, moves all of the curve.
  const auto count = static_cast<double>(tests.size());
  const double relative =
      std::hypot(std::sqrt(squares / count), sum > 0.0 ? fit.scatter * count / sum : 0.0);
  const Basis told = basis_of(tests), untold = std::max(told, Basis::inferred);
  const bool at_rest = std::ranges::any_of(points, [](const auto& p) { return p.rate == 0.0; });
  const std::size_t moving = points.size() - (at_rest ? 1 : 0);
  const auto found = [&](const Quantity& from, Kind kind, double value, const char* unit,
                         bool by_tests = true) {
    Quantity quantity = derived_quantity(from, kind, value, unit);
    quantity.standard_uncertainty = relative * value;
    quantity.basis = by_tests ? told : untold;
    return quantity;
  };
  const Quantity& torque = tests.front().said;
  const Quantity& rate = tests.front().rate;
  const plant::FrictionCurve& curve = fit.curve;
  friction.coulomb = found(torque, Kind::torque, curve.coulomb_torque, "N.m");
  friction.breakaway = found(torque, Kind::torque, curve.breakaway_torque, "N.m", at_rest);
  friction.stribeck_rate =
      found(rate, Kind::angular_rate, curve.stribeck_rate, "rad/s", points.size() >= 4);
  friction.saturating = found(torque, Kind::torque, 0.0, "N.m");
  friction.saturating_rate = found(rate, Kind::angular_rate, curve.saturating_rate, "rad/s");
  friction.viscous =
      found(torque, Kind::viscous_friction, curve.viscous_friction, "N.m.s/rad", moving >= 2);
  friction.tests.clear();
  for (const auto& point : points) {
    const double by_curve =
        point.rate > 0.0 ? plant::friction_torque(curve, point.rate) : curve.breakaway_torque;
    friction.tests.push_back({point.rate, point.torque, point.torque - by_curve, point.leeway});
  }
}

void read_tests_of_curve(TableReader& curve, std::vector<TableReader>& entries, Case& antenna) {
  for (const char* key : curve_keys) {
    if (curve.has(key)) {
      curve.refuse(key, fmt::format("expected either {} or tests, found both", key));
    }
  }
  std::vector<SteadyTest> tests;
  std::set<double> rates;
  for (auto& entry : entries) {
    tests.push_back(read_test(entry, antenna));
    if (!rates.insert(tests.back().motor_rate).second) {
      entry.refuse(entry.has("rate") ? "rate" : "motor_rate",
                   "expected one test a rate, found another at this one");
    }
  }
  if (*rates.rbegin() == 0.0) {
    curve.refuse("test", "expected a test at a rate above 0, found only one at rest");
  }
  fit_tests(tests, *antenna.friction_curve);
}

}  // namespace

void read_friction_curve(TableReader& file, Case& antenna) {
  TableReader curve = file.table("friction_curve");
  FrictionCurveEntry& friction = *antenna.friction_curve;
  auto entries = curve.tables("test");
  if (!entries.empty()) {
    read_tests_of_curve(curve, entries, antenna);
    curve.finish();
    return;
  }
  friction.coulomb = curve.quantity("coulomb", Kind::torque, Range::not_negative());
  friction.breakaway = curve.quantity("breakaway", Kind::torque, Range::not_negative());
  friction.stribeck_rate = curve.quantity("stribeck_rate", Kind::angular_rate, Range::positive());
  friction.saturating = curve.quantity("saturating", Kind::torque, Range::not_negative());
  friction.saturating_rate =
      curve.quantity("saturating_rate", Kind::angular_rate, Range::positive());
  friction.viscous = curve.quantity("viscous", Kind::viscous_friction, Range::not_negative());
  curve.finish();
  if (friction.breakaway.value < friction.coulomb.value) {
    curve.refuse("breakaway", "expected at least the Coulomb torque, found less");
  }
}

}  // namespace boresight::io
