#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <boresight/app/io/case_sections.hpp>

namespace boresight::app {
namespace {

double share(TableReader& entry) {
  const auto probability =
      entry.optional_quantity("probability", Kind::number, Range::positive(1.0));
  return probability ? probability->value : 1.0;
}

// One entry is one speed or one Weibull law; several make a mixture.
design::ClimatePart read_part(TableReader& entry, const WindEntry& wind) {
  const Range usual = Range::between(0.1, 60.0);
  const auto speed = entry.optional_quantity("speed", Kind::speed, usual);
  const auto scale = entry.optional_quantity("scale", Kind::speed, usual);
  const auto shape = entry.optional_quantity("shape", Kind::number, Range::between(0.5, 10.0));
  const auto highest = entry.optional_quantity("highest", Kind::speed, usual);
  const double weight = share(entry);
  entry.finish();
  if (speed.has_value() == scale.has_value()) {
    entry.refuse("speed", std::string("expected either a speed, or scale, shape and highest of a "
                                      "Weibull law, found ") +
                              (speed ? "both" : "neither"));
  }
  if (speed) {
    if (shape || highest) {
      entry.refuse(shape ? "shape" : "highest",
                   "expected it beside a scale, found it beside a speed");
    }
    return {at_dish_centre(wind, *speed).value, weight};
  }
  if (!scale || !shape || !highest) {
    entry.refuse(shape ? "highest" : "shape",
                 "expected scale, shape and highest together, found not all");
  }
  return {design::WeibullClimate{at_dish_centre(wind, *scale).value, shape->value,
                                 at_dish_centre(wind, *highest).value},
          weight};
}

// Speeds and weights of one part.
std::vector<design::WeightedSpeed> speeds_of(const design::ClimatePart& part) {
  const auto* law = std::get_if<design::WeibullClimate>(&part.winds);
  if (law == nullptr) return {{std::get<double>(part.winds), part.weight}};
  auto speeds = design::climate_speeds(*law);
  for (auto& one : speeds) one.weight *= part.weight;
  return speeds;
}

// The torque coefficient in one attitude.
double read_coefficient(TableReader& entry, const Case& antenna, double direction) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const auto azimuth = entry.optional_quantity("azimuth", Kind::angle, Range::between(-turn, turn));
  const auto elevation =
      entry.optional_quantity("elevation", Kind::angle, Range::between(0.0, 0.5 * turn));
  const auto coefficient =
      entry.optional_quantity("torque_coefficient", Kind::number, Range::not_negative(10.0));
  const auto& table = antenna.wind.torque_table;
  if (!table) {
    if (!coefficient) {
      entry.refuse("torque_coefficient",
                   "expected a torque_coefficient, or a wind.torque_table to take it from, found "
                   "neither");
    }
    return coefficient->value;
  }
  if (coefficient) {
    entry.refuse("torque_coefficient",
                 "expected azimuth and elevation for the torque_table, found a coefficient");
  }
  if (!azimuth || !elevation) {
    entry.refuse(azimuth ? "elevation" : "azimuth",
                 "expected azimuth and elevation for the torque_table, found not both");
  }
  try {
    return table->at(std::remainder(direction - azimuth->value, turn), elevation->value);
  } catch (const InvalidInput& error) {
    entry.refuse("azimuth", error.what());
  }
}

}  // namespace

void read_climate(TableReader& wind, Case& antenna) {
  std::vector<design::WeightedSpeed> speeds;
  for (auto& entry : wind.tables("climate")) {
    antenna.wind.climate_parts.push_back(read_part(entry, antenna.wind));
    std::ranges::copy(speeds_of(antenna.wind.climate_parts.back()), std::back_inserter(speeds));
  }
  if (!speeds.empty()) antenna.wind.climate = design::climate_speeds(speeds);
  const auto& attitude = antenna.wind.attitude;
  const auto& azimuth = antenna.antenna.azimuth;
  const double direction = attitude && azimuth ? attitude->yaw + azimuth->value : 0.0;
  double weights = 0.0, squares = 0.0;
  for (auto& entry : wind.tables("attitude")) {
    const double coefficient = read_coefficient(entry, antenna, direction);
    const double weight = share(entry);
    entry.finish();
    weights += weight;
    // The torque's spectrum goes with the coefficient's square, and so does every loss.
    squares += weight * coefficient * coefficient;
  }
  if (weights > 0.0) antenna.wind.climate_torque_coefficient = std::sqrt(squares / weights);
}

}  // namespace boresight::app
