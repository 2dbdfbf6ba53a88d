#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/friction_leeway.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::io {
namespace {

constexpr double large_fraction = 0.4;  // of the supply's torque
constexpr double clear_factor = 1.5;

const Quantity& largest_part(const FrictionCurveEntry& curve, double rate) {
  const std::array<std::pair<double, const Quantity*>, 3> parts{
      {{curve.viscous.value * rate, &curve.viscous},
       {curve.saturating.value, &curve.saturating},
       {curve.coulomb.value, &curve.coulomb}}};
  return *std::max_element(parts.begin(), parts.end(), [](const auto& one, const auto& other) {
            return one.first < other.first;
          })->second;
}

/// Between what a number must lie, with the standard uncertainties of both ends.
struct Reach {
  double minimum = 0.0, maximum = 0.0;
  double of_least = 0.0, of_most = 0.0;
};

// A line through points of the curve, also by least squares, is a mean of the lines through two of
// them, and such a line's intercept and slope are means of the tangents' between the two: no tests,
// at whatever speeds, can leave what the tangents span. With x = w/ws the curve's bump, of height
// Ts - Tc, adds (1 + 2 x^2) exp(-x^2) heights to a tangent's intercept and -2 x exp(-x^2) heights
// over ws to its slope.
Reach intercepts_of(const FrictionCurveEntry& curve) {
  const double largest = 2.0 / std::sqrt(std::numbers::e);
  const double height = curve.breakaway.value - curve.coulomb.value;
  return {curve.coulomb.value, curve.coulomb.value + curve.saturating.value + largest * height,
          curve.coulomb.standard_uncertainty,
          std::hypot((largest - 1.0) * curve.coulomb.standard_uncertainty,
                     curve.saturating.standard_uncertainty,
                     largest * curve.breakaway.standard_uncertainty)};
}

Reach slopes_of(const FrictionCurveEntry& curve) {
  const double steepest = std::sqrt(2.0 / std::numbers::e);
  const double fall =
      steepest * (curve.breakaway.value - curve.coulomb.value) / curve.stribeck_rate.value;
  const double rise = curve.saturating.value / curve.saturating_rate.value;
  const double of_fall = std::hypot(
      steepest / curve.stribeck_rate.value *
          std::hypot(curve.breakaway.standard_uncertainty, curve.coulomb.standard_uncertainty),
      fall * relative_uncertainty(curve.stribeck_rate));
  const double of_rise =
      std::hypot(curve.saturating.standard_uncertainty / curve.saturating_rate.value,
                 rise * relative_uncertainty(curve.saturating_rate));
  return {curve.viscous.value - fall, curve.viscous.value + rise,
          std::hypot(curve.viscous.standard_uncertainty, of_fall),
          std::hypot(curve.viscous.standard_uncertainty, of_rise)};
}

void compare(const Quantity& tested, const Reach& reach, const std::string& unit,
             PhysicalChecks& found) {
  const auto clear = [&](double uncertainty) {
    return 2.0 * std::hypot(tested.standard_uncertainty, uncertainty);
  };
  // Slopes may be below 0, where a factor leads the other way.
  const double lowest = std::min(reach.minimum / clear_factor, reach.minimum * clear_factor);
  auto& check = begin_check(found, "friction_test_line", tested.key);
  check.entries = {entry_of(tested)};
  check.add("tests", tested.value, unit, std::min(lowest, reach.minimum - clear(reach.of_least)),
            std::max(clear_factor * reach.maximum, reach.maximum + clear(reach.of_most)));
  check.add("least by the curve", reach.minimum, unit);
  check.add("most by the curve", reach.maximum, unit);
}

// That fraction of the supply's torque and two standard uncertainties.
double clearly_above(const MotorTorque& friction, double fraction, const MotorTorque& supply) {
  return fraction * supply.value +
         2.0 * std::hypot(friction.uncertainty, fraction * supply.uncertainty);
}

bool above(const MotorTorque& friction, double fraction, const MotorTorque& supply) {
  return friction.value > clearly_above(friction, fraction, supply);
}

/// A viscous friction (N m s/rad at the motor), and what the test's unit is read as.
struct SlopeReading {
  std::string name;
  double slope = 0.0;
};

// What it would do, within the damping ratio and the torque given.
void add_effect(const Case& antenna, const ShaftNumbers& shaft, const SlopeReading& reading,
                double max_damping, double max_torque, design::PhysicalCheck& check) {
  const auto& intercept = antenna.friction_tests->constant_speed_coulomb;
  const double torque = (intercept ? intercept->value : 0.0) + reading.slope * shaft.slew_rate;
  check.add("slope " + reading.name, reading.slope, "N.m.s/rad");
  check.add(
      "damping ratio " + reading.name,
      plant::hydraulic_damping(shaft.oil_stiffness, shaft.motors + shaft.gear_train + shaft.antenna,
                               antenna.drive->leakage_rate.value, reading.slope),
      "1", -design::unbounded, max_damping);
  check.add("torque at slew rate " + reading.name, torque, "N.m", -design::unbounded, max_torque);
  check.add("power at slew rate " + reading.name, torque * shaft.slew_rate, "W");
}

}  // namespace

MotorTorque torque_of_supply(const Case& antenna, const ShaftNumbers& shaft) {
  const MotorEntry& motor = *antenna.motor;
  const double relative = std::hypot(relative_uncertainty(antenna.drive->supply_pressure),
                                     relative_uncertainty(motor.displacement),
                                     relative_uncertainty(motor.torque_efficiency));
  return {shaft.supply_torque, relative * shaft.supply_torque};
}

// The rates at which the curve falls and levels off hardly show at slew rate.
MotorTorque friction_at_slew_rate(const Case& antenna, const ShaftNumbers& shaft) {
  const FrictionCurveEntry& entry = *antenna.friction_curve;
  const plant::FrictionCurve curve = friction_curve(antenna);
  const double rate = shaft.slew_rate;
  const double of_rate = rate * relative_uncertainty(antenna.drive->slew_rate);
  return {
      plant::friction_torque(curve, rate),
      std::hypot(
          std::hypot(entry.coulomb.standard_uncertainty, entry.saturating.standard_uncertainty),
          rate * entry.viscous.standard_uncertainty, of_rate * plant::friction_slope(curve, rate))};
}

bool friction_stops_slewing(const Case& antenna, const ShaftNumbers& shaft) {
  return above(friction_at_slew_rate(antenna, shaft), 1.0, torque_of_supply(antenna, shaft));
}

void check_friction_slope(const Case& antenna, PhysicalChecks& found) {
  const FrictionTestsEntry& tests = *antenna.friction_tests;
  if (!tests.constant_speed_slope) return;
  constexpr double rpm = two_pi / 60.0;
  const ShaftNumbers& shaft = found.shaft;
  const double slope = tests.constant_speed_slope->value;
  auto& check = begin_check(found, "friction_slope", "friction_tests.constant_speed_slope");
  check.add("supply torque", shaft.supply_torque, "N.m");
  check.add("supply power at slew rate", shaft.supply_torque * shaft.slew_rate, "W");
  add_effect(antenna, shaft, {"at the motor's shaft", slope},
             antenna.resonance->frequency ? 1.0 : design::unbounded, shaft.supply_torque, check);
  if (!check.holds && antenna.tachometer) {
    const TachometerEntry& tachometer = *antenna.tachometer;
    add_effect(antenna, shaft,
               {"if the speed is the tachometer's",
                slope / (tachometer.motor_teeth.value / tachometer.tachometer_teeth.value)},
               design::unbounded, design::unbounded, check);
    add_effect(
        antenna, shaft,
        {"if it is per volt of the tachometer", slope * rpm / motor_rate_per_volt(tachometer)},
        design::unbounded, design::unbounded, check);
  }
}

void check_friction_against_supply(const Case& antenna, PhysicalChecks& found) {
  const FrictionCurveEntry& curve = *antenna.friction_curve;
  const MotorTorque supply = torque_of_supply(antenna, found.shaft);
  const MotorTorque starting{curve.breakaway.value, curve.breakaway.standard_uncertainty};
  const MotorTorque slewing = friction_at_slew_rate(antenna, found.shaft);
  // What cannot even break away need not be told that it slews too slowly.
  const bool at_rest = starting.value >= slewing.value || above(starting, 1.0, supply);
  const MotorTorque& friction = at_rest ? starting : slewing;
  const Quantity& maximum = at_rest ? curve.breakaway : largest_part(curve, found.shaft.slew_rate);
  auto& check = begin_check(found, "friction_against_supply", maximum.key);
  check.entries = {entry_of(maximum), entry_of(antenna.drive->supply_pressure)};
  check.explanation = at_rest ? "breakaway" : "slewing";
  if (above(friction, 1.0, supply)) check.explanation += "_beyond_supply";
  check.add("breakaway", starting.value, "N.m");
  check.add("friction at slew rate", slewing.value, "N.m");
  check.add("supply torque", supply.value, "N.m");
  check.add("fraction of the supply torque", friction.value / supply.value, "1", -design::unbounded,
            clearly_above(friction, large_fraction, supply) / supply.value);
}

void check_friction_tests(const Case& antenna, PhysicalChecks& found) {
  const FrictionTestsEntry& tests = *antenna.friction_tests;
  const FrictionCurveEntry& curve = *antenna.friction_curve;
  if (const auto& intercept = tests.constant_speed_coulomb) {
    compare(*intercept, intercepts_of(curve), "N.m", found);
  }
  if (const auto& slope = tests.constant_speed_slope) {
    compare(*slope, slopes_of(curve), "N.m.s/rad", found);
  }
}

void check_friction_curve_tests(const Case& antenna, PhysicalChecks& found) {
  const FrictionCurveEntry& curve = *antenna.friction_curve;
  if (curve.tests.empty()) return;
  const auto rate = loose_stribeck_rate(curve);
  auto& check = begin_check(found, "friction_curve_tests", "friction_curve.test", !rate);
  check.add("Stribeck rate", curve.stribeck_rate.value, "rad/s");
  if (rate) {
    check.add("least Stribeck rate", rate->minimum, "rad/s");
    check.add("largest Stribeck rate", rate->largest, "rad/s");
  }
}

void check_coulomb_levels(const Case& antenna, PhysicalChecks& found) {
  const FrictionTestsEntry& tests = *antenna.friction_tests;
  if (!tests.constant_speed_coulomb || !tests.slow_ramp_up || !tests.slow_ramp_down) return;
  const double intercept = tests.constant_speed_coulomb->value;
  const double ramp = 0.5 * (tests.slow_ramp_up->value + tests.slow_ramp_down->value);
  auto& check = begin_check(found, "coulomb_levels", "friction.slow_ramp.coulomb");
  check.add("constant speed", intercept, "N.m");
  check.add("slow ramp", ramp, "N.m");
  check.add("factor", std::max(intercept, ramp) / std::min(intercept, ramp), "1",
            -design::unbounded, clear_factor);
}

}  // namespace boresight::io
