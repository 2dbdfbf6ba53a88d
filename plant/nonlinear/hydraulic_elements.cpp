#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/hydraulic_elements.hpp>

namespace boresight::plant {
namespace {

enum class Range { positive, not_negative };

void check(const char* function, const char* argument, double value, Range range) {
  const bool positive = range == Range::positive;
  if (std::isfinite(value) && (positive ? value > 0.0 : value >= 0.0)) return;
  throw InvalidInput(fmt::format("{}: expected {} {} 0 and finite, found {}", function, argument,
                                 positive ? "above" : "at least", value));
}

}  // namespace

numerics::ValueAndDerivative orifice(double coefficient, double pressure_difference,
                                     double transition) {
  const double square = pressure_difference * pressure_difference;
  const double transition_square = transition * transition;
  const double sum = square + transition_square;
  const double per_pressure = coefficient / std::sqrt(std::sqrt(sum));
  return {per_pressure * pressure_difference,
          per_pressure * (0.5 * square + transition_square) / sum};
}

double orifice_coefficient(double opening, double discharge_coefficient, double density) {
  constexpr const char* function = "orifice_coefficient";
  check(function, "an opening", opening, Range::not_negative);
  check(function, "a discharge coefficient", discharge_coefficient, Range::positive);
  check(function, "a density", density, Range::positive);
  return discharge_coefficient * opening * std::sqrt(2.0 / density);
}

numerics::ValueAndDerivative check_valve(double coefficient, double pressure_difference,
                                         double transition) {
  if (pressure_difference <= 0.0) return {};
  return orifice(coefficient, pressure_difference, transition);
}

double volume_stiffness(double bulk_modulus, double volume) {
  check("volume_stiffness", "a bulk modulus", bulk_modulus, Range::positive);
  check("volume_stiffness", "a volume", volume, Range::positive);
  return bulk_modulus / volume;
}

void validate(const ReliefValve& valve) {
  constexpr const char* function = "ReliefValve";
  if (!std::isfinite(valve.tank_pressure)) {
    throw InvalidInput(fmt::format("ReliefValve: expected a finite tank_pressure, found {} Pa",
                                   valve.tank_pressure));
  }
  check(function, "an opening_pressure over the tank's",
        valve.opening_pressure - valve.tank_pressure, Range::not_negative);
  check(function, "a flow_force_rate", valve.flow_force_rate, Range::not_negative);
  const std::array<std::pair<const char*, double>, 3> positive{
      {{"a spring_rate", valve.spring_rate},
       {"a largest_opening", valve.largest_opening},
       {"a time_constant", valve.time_constant}}};
  for (const auto& [argument, value] : positive) check(function, argument, value, Range::positive);
}

numerics::ValueAndDerivative free_opening(const ReliefValve& valve, double pressure) {
  const double above = pressure - valve.opening_pressure;
  // Below the tank's pressure nothing flows and no force is there.
  const bool flows = pressure > valve.tank_pressure;
  const double rate =
      valve.spring_rate + (flows ? (pressure - valve.tank_pressure) * valve.flow_force_rate : 0.0);
  const double opening = above / rate;
  return {opening, (1.0 - (flows ? opening * valve.flow_force_rate : 0.0)) / rate};
}

numerics::ValueAndDerivative resting_opening(const ReliefValve& valve, double pressure) {
  const numerics::ValueAndDerivative opening = free_opening(valve, pressure);
  if (opening.value <= 0.0) return {};
  if (opening.value >= valve.largest_opening) return {valve.largest_opening, 0.0};
  return opening;
}

}  // namespace boresight::plant
