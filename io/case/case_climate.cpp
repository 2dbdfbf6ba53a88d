#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

double fraction(TableReader& entry) {
  const auto probability =
      entry.optional_quantity("probability", Kind::number, Range::positive(1.0));
  return probability ? probability->value : 1.0;
}

// In which way an entry states its winds, by the key that only this way has.
std::string way_of(const TableReader& entry) {
  std::vector<std::string> found;
  for (const char* key : {"speed", "scale", "mean"}) {
    if (entry.has(key)) found.emplace_back(key);
  }
  if (found.size() == 1) return found.front();
  entry.refuse(
      "speed",
      fmt::format("expected either a speed, or of a Weibull distribution scale and shape, or its "
                  "mean, exceeded and exceeded_share, found {}",
                  found.empty() ? "none of them" : fmt::format("{}", fmt::join(found, " and "))));
}

void check_keys_of_way(const TableReader& entry, const std::string& way) {
  constexpr std::array belong{std::pair{"shape", "scale"}, std::pair{"exceeded", "mean"},
                              std::pair{"exceeded_share", "mean"}};
  for (const auto& [key, other] : belong) {
    if (entry.has(key) && way != other) {
      entry.refuse(key, fmt::format("expected it beside a {}, found it beside a {}", other, way));
    }
  }
  if (entry.has("highest") && way == "speed") {
    entry.refuse("highest", "expected it beside a scale or a mean, found it beside a speed");
  }
}

// Shape of the Weibull distribution with that fraction of all winds above `exceeded`.
double shape_by_exceedance(const TableReader& entry, const Quantity& mean, const Quantity& exceeded,
                           const Quantity& exceeded_share) {
  const double ratio = exceeded.value / mean.value;
  const auto found = design::weibull_shapes(ratio, exceeded_share.value);
  if (found.shapes.empty()) {
    const bool more = exceeded_share.value > found.max_fraction;
    entry.refuse(
        "exceeded_share",
        fmt::format(
            "expected a fraction of at {} {:.6g} %, which of Weibull distributions with shapes "
            "from {:g} to {:g} lies above {:.4g} times the mean, found {}",
            more ? "most" : "least", 100.0 * (more ? found.max_fraction : found.min_fraction),
            design::lowest_shape_sought, design::highest_shape_sought, ratio,
            in_quotes(exceeded_share.text)));
  }
  if (found.shapes.size() > 1) {
    entry.refuse("exceeded",
                 fmt::format("expected a speed further above the mean, found {}, which is exceeded "
                             "as often with a shape of {:.4g} as with one of {:.4g}",
                             in_quotes(exceeded.text), found.shapes.front(), found.shapes.back()));
  }
  return found.shapes.front();
}

// One entry is one speed or one Weibull distribution; several make a mixture.
design::ClimatePart read_part(TableReader& entry, const WindEntry& wind) {
  const Range usual = Range::between(0.1, 60.0);
  const auto speed = entry.optional_quantity("speed", Kind::speed, usual);
  const auto scale = entry.optional_quantity("scale", Kind::speed, usual);
  const auto shape = entry.optional_quantity("shape", Kind::number, Range::between(0.5, 10.0));
  const auto mean = entry.optional_quantity("mean", Kind::speed, usual);
  const auto exceeded = entry.optional_quantity("exceeded", Kind::speed, usual);
  const auto exceeded_share =
      entry.optional_quantity("exceeded_share", Kind::number, Range::positive(1.0));
  const auto highest = entry.optional_quantity("highest", Kind::speed, usual);
  const double weight = fraction(entry);
  entry.finish();
  check_keys_of_way(entry, way_of(entry));
  if (speed) return {at_dish_centre(wind, *speed).value, weight};
  if (scale) {
    if (!shape || !highest) {
      entry.refuse(shape ? "highest" : "shape",
                   "expected scale, shape and highest together, found not all");
    }
    return {design::WeibullClimate{at_dish_centre(wind, *scale).value, shape->value,
                                   at_dish_centre(wind, *highest).value},
            weight};
  }
  if (!mean || !exceeded || !exceeded_share || !highest) {
    const char* among_exceedance = exceeded ? "exceeded_share" : "exceeded";
    entry.refuse(exceeded && exceeded_share ? "highest" : among_exceedance,
                 "expected mean, exceeded, exceeded_share and highest together, found not all");
  }
  return {design::weibull_climate(at_dish_centre(wind, *mean).value,
                                  shape_by_exceedance(entry, *mean, *exceeded, *exceeded_share),
                                  at_dish_centre(wind, *highest).value),
          weight};
}

// Speeds and weights of one part.
std::vector<design::WeightedSpeed> speeds_of(const design::ClimatePart& part) {
  const auto* controller = std::get_if<design::WeibullClimate>(&part.winds);
  if (controller == nullptr) return {{std::get<double>(part.winds), part.weight}};
  auto speeds = design::climate_speeds(*controller);
  for (auto& one : speeds) one.weight *= part.weight;
  return speeds;
}

// The torque coefficient in one attitude.
double read_coefficient(TableReader& entry, const Case& antenna, double direction) {
  constexpr double turn = two_pi;
  const auto azimuth = entry.optional_quantity("azimuth", Kind::angle, Range::between(-turn, turn));
  const auto elevation =
      entry.optional_quantity("elevation", Kind::angle, Range::between(0.0, 0.5 * turn));
  const auto coefficient =
      entry.optional_quantity("torque_coefficient", Kind::number, Range::not_negative(10.0));
  const auto& table = antenna.wind->torque_table;
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
    antenna.wind->climate_parts.push_back(read_part(entry, *antenna.wind));
    std::ranges::copy(speeds_of(antenna.wind->climate_parts.back()), std::back_inserter(speeds));
  }
  if (!speeds.empty()) antenna.wind->climate = design::climate_speeds(speeds);
  const auto& attitude = antenna.wind->attitude;
  const auto& azimuth = antenna.antenna->azimuth;
  const double direction = attitude && azimuth ? attitude->yaw + azimuth->value : 0.0;
  double weights = 0.0, squares = 0.0;
  for (auto& entry : wind.tables("attitude")) {
    const double coefficient = read_coefficient(entry, antenna, direction);
    const double weight = fraction(entry);
    entry.finish();
    weights += weight;
    // The torque's spectrum scales with the coefficient's square, and so does every loss.
    squares += weight * coefficient * coefficient;
  }
  if (weights > 0.0) antenna.wind->climate_torque_coefficient = std::sqrt(squares / weights);
}

}  // namespace boresight::io
