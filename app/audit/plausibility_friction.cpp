#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::app {
namespace {

constexpr double large_share = 0.4;  // of the supply's torque
constexpr double clear_factor = 1.5;

std::string as_written(const io::Quantity& quantity) {
  return fmt::format("'{}'{}", quantity.text,
                     quantity.basis == io::Basis::assumed ? " (assumed)" : "");
}

const io::Quantity& largest_part(const io::FrictionCurveEntry& curve, double rate) {
  const std::array<std::pair<double, const io::Quantity*>, 3> parts{
      {{curve.viscous.value * rate, &curve.viscous},
       {curve.saturating.value, &curve.saturating},
       {curve.coulomb.value, &curve.coulomb}}};
  return *std::max_element(parts.begin(), parts.end(), [](const auto& one, const auto& other) {
            return one.first < other.first;
          })->second;
}

std::string taken_by_friction(const CaseNumbers& numbers, const MotorTorque& friction,
                              const io::Quantity& most, bool at_rest) {
  if (at_rest) {
    return fmt::format("to break away takes {:.3g} N.m, by {} {}", friction.value, most.key,
                       as_written(most));
  }
  return fmt::format(
      "at the slew rate of '{}', {:.3g} rad/s of the motors, that is {:.3g} N.m, the most of it by "
      "{} {}",
      numbers.antenna.drive.slew_rate.text, numbers.slew_rate_at_motor, friction.value, most.key,
      as_written(most));
}

// Of what takes more than the whole of the supply's torque, or a large share of it.
std::string too_much_friction(const CaseNumbers& numbers, const MotorTorque& friction,
                              const io::Quantity& most, bool at_rest, bool impossible) {
  std::string claim = fmt::format("Friction takes {:.0f} % of the supply's torque",
                                  100.0 * friction.value / numbers.supply_torque);
  std::string doubt = "wind and acceleration need torque as well, or ";
  if (impossible) {
    claim = fmt::format("The supply cannot {} the antenna against its friction",
                        at_rest ? "move" : "slew");
    doubt = at_rest ? "" : "the slew rate is out of reach, or ";
  }
  return fmt::format(
      "{}: {}, and the motors give {:.3g} N.m at {}: {}one of these numbers or its "
      "unit is wrong.",
      claim, taken_by_friction(numbers, friction, most, at_rest), numbers.supply_torque,
      as_written(numbers.antenna.drive.supply_pressure), doubt);
}

/// Between what a number must lie, with the standard uncertainties of both ends.
struct Reach {
  double least = 0.0, most = 0.0;
  double of_least = 0.0, of_most = 0.0;
};

bool beyond(const io::Quantity& quantity, const Reach& reach) {
  const auto clear = [&](double difference, double uncertainty) {
    return difference > 2.0 * std::hypot(quantity.standard_uncertainty, uncertainty);
  };
  const bool above = quantity.value > clear_factor * reach.most &&
                     clear(quantity.value - reach.most, reach.of_most);
  // Slopes may be below 0, where a factor leads the other way.
  const double lowest = std::min(reach.least / clear_factor, reach.least * clear_factor);
  const bool below = quantity.value < lowest && clear(reach.least - quantity.value, reach.of_least);
  return above || below;
}

// A line through points of the curve, also by least squares, is a mean of the lines through two of
// them, and such a line's intercept and slope are means of the tangents' between the two: no tests,
// at whatever speeds, can leave what the tangents span. With x = w/ws the curve's bump, of height
// Ts - Tc, adds (1 + 2 x^2) exp(-x^2) heights to a tangent's intercept and -2 x exp(-x^2) heights
// over ws to its slope.
Reach intercepts_of(const io::FrictionCurveEntry& curve) {
  const double largest = 2.0 / std::sqrt(std::numbers::e);
  const double height = curve.breakaway.value - curve.coulomb.value;
  return {curve.coulomb.value, curve.coulomb.value + curve.saturating.value + largest * height,
          curve.coulomb.standard_uncertainty,
          std::hypot((largest - 1.0) * curve.coulomb.standard_uncertainty,
                     curve.saturating.standard_uncertainty,
                     largest * curve.breakaway.standard_uncertainty)};
}

Reach slopes_of(const io::FrictionCurveEntry& curve) {
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

void compare(const std::string& what, const io::Quantity& tested, const Reach& reach,
             const std::string& unit, Implausibilities& found) {
  if (!beyond(tested, reach)) return;
  found.push_back(
      {"friction tests",
       tested.key,
       fmt::format("The line through the constant-speed tests has the {} '{}', {:.3g} "
                   "{}; by [friction_curve] lines through any speeds have between "
                   "{:.3g} and {:.3g} {}: tests and curve contradict one another, or "
                   "one is in other units or of another shaft.",
                   what, tested.text, tested.value, unit, reach.least, reach.most, unit),
       {{"tests", tested.value, unit},
        {"least by the curve", reach.least, unit},
        {"most by the curve", reach.most, unit}}});
}

// More than that share of the supply's torque, by more than two standard uncertainties.
bool above(const MotorTorque& friction, double share, const MotorTorque& supply) {
  return friction.value - share * supply.value >
         2.0 * std::hypot(friction.uncertainty, share * supply.uncertainty);
}

}  // namespace

MotorTorque torque_of_supply(const CaseNumbers& numbers) {
  const io::MotorEntry& motor = numbers.antenna.motor;
  const double relative =
      std::hypot(io::relative_uncertainty(numbers.antenna.drive.supply_pressure),
                 io::relative_uncertainty(motor.displacement),
                 io::relative_uncertainty(motor.torque_efficiency));
  return {numbers.supply_torque, relative * numbers.supply_torque};
}

// The rates at which the curve falls and levels off hardly show at slew rate.
MotorTorque friction_at_slew_rate(const CaseNumbers& numbers) {
  const io::FrictionCurveEntry& entry = numbers.antenna.friction_curve;
  const plant::FrictionCurve curve = io::friction_curve(numbers.antenna);
  const double rate = numbers.slew_rate_at_motor;
  const double of_rate = rate * relative_uncertainty(numbers.antenna.drive.slew_rate);
  return {
      plant::friction_torque(curve, rate),
      std::hypot(
          std::hypot(entry.coulomb.standard_uncertainty, entry.saturating.standard_uncertainty),
          rate * entry.viscous.standard_uncertainty, of_rate * plant::friction_slope(curve, rate))};
}

bool friction_stops_slewing(const CaseNumbers& numbers) {
  return above(friction_at_slew_rate(numbers), 1.0, torque_of_supply(numbers));
}

void check_friction_against_supply(const CaseNumbers& numbers, Implausibilities& found) {
  const io::FrictionCurveEntry& curve = numbers.antenna.friction_curve;
  const MotorTorque supply = torque_of_supply(numbers);
  const MotorTorque starting{curve.breakaway.value, curve.breakaway.standard_uncertainty};
  const MotorTorque slewing = friction_at_slew_rate(numbers);
  // What cannot even break away need not be told that it slews too slowly.
  const bool at_rest = starting.value >= slewing.value || above(starting, 1.0, supply);
  const MotorTorque& friction = at_rest ? starting : slewing;
  if (!above(friction, large_share, supply)) return;
  const io::Quantity& most =
      at_rest ? curve.breakaway : largest_part(curve, numbers.slew_rate_at_motor);
  found.push_back(
      {"friction against the supply",
       most.key,
       too_much_friction(numbers, friction, most, at_rest, above(friction, 1.0, supply)),
       {{"breakaway", starting.value, "N.m"},
        {"friction at slew rate", slewing.value, "N.m"},
        {"supply torque", supply.value, "N.m"},
        {"share of the supply torque", friction.value / supply.value, "1"}}});
}

void check_friction_tests(const CaseNumbers& numbers, Implausibilities& found) {
  const io::FrictionTestsEntry& tests = numbers.antenna.friction_tests;
  const io::FrictionCurveEntry& curve = numbers.antenna.friction_curve;
  if (const auto& intercept = tests.constant_speed_coulomb) {
    compare("intercept", *intercept, intercepts_of(curve), "N.m", found);
  }
  if (const auto& slope = tests.constant_speed_slope) {
    compare("slope", *slope, slopes_of(curve), "N.m.s/rad", found);
  }
}

}  // namespace boresight::app
