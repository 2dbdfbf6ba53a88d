#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/design/wind_climate.hpp>
#include <boresight/plant/error.hpp>
#include <boresight/plant/gauss_rule.hpp>

namespace boresight::design {
namespace {

constexpr int points = 4;  // of a panel
// They shrink towards calm, where a Weibull density may have no derivatives.
constexpr int panels = 12;
constexpr double negligible = 1e-12;

bool within(double value, double least, double most) {
  return value >= least && value <= most;
}

double highest_of(const ClimatePart& part) {
  const auto* law = std::get_if<WeibullClimate>(&part.winds);
  return law != nullptr ? law->highest : std::get<double>(part.winds);
}

// How much of the part's time its speed is at most that.
double share_of(const ClimatePart& part, double speed) {
  if (speed >= highest_of(part) * (1.0 - 1e-9)) return 1.0;
  const auto* law = std::get_if<WeibullClimate>(&part.winds);
  if (law == nullptr) return 0.0;
  const auto below = [&](double v) { return -std::expm1(-std::pow(v / law->scale, law->shape)); };
  return below(std::max(0.0, speed)) / below(law->highest);
}

}  // namespace

std::vector<WeightedSpeed> climate_speeds(const WeibullClimate& climate) {
  if (!within(climate.scale, 1e-3, 1e3) || !within(climate.shape, 0.5, 10.0) ||
      !within(climate.highest, 1e-3, 1e3)) {
    throw InvalidInput(
        fmt::format("climate_speeds: expected a scale and a highest speed of 0.001 to 1000 m/s and "
                    "a shape of 0.5 to 10, found {} m/s, {} m/s and {}",
                    climate.scale, climate.highest, climate.shape));
  }
  // Beyond this (v/scale)^shape there is less than 1e-13 of all winds.
  const double rarest = climate.scale * std::pow(30.0, 1.0 / climate.shape);
  const double end = std::min(climate.highest, rarest);
  std::vector<WeightedSpeed> speeds;
  const plant::GaussRule rule = plant::gauss_rule(points);
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double t = (panel + 0.5 * (rule.node[i] + 1.0)) / panels;
      const double speed = end * t * t;
      const double relative = std::pow(speed / climate.scale, climate.shape);
      // dv = 2 end t dt, density (shape/v) (v/scale)^shape exp(-(v/scale)^shape)
      speeds.push_back(
          {speed, rule.weight[i] * t * climate.shape / speed * relative * std::exp(-relative)});
    }
  }
  return climate_speeds(speeds);
}

std::vector<WeightedSpeed> climate_speeds(const std::vector<WeightedSpeed>& table) {
  double sum = 0.0;
  for (const auto& [speed, weight] : table) {
    if (!(speed > 0.0) || !std::isfinite(speed) || !(weight >= 0.0) || !std::isfinite(weight)) {
      throw InvalidInput(fmt::format(
          "climate_speeds: expected speeds above 0 and weights of at least 0, found {} m/s of "
          "weight {}",
          speed, weight));
    }
    sum += weight;
  }
  if (!(sum > 0.0)) {
    throw InvalidInput("climate_speeds: expected a speed of a weight above 0, found none");
  }
  std::vector<WeightedSpeed> speeds;
  for (const auto& [speed, weight] : table) {
    if (weight > negligible * sum) speeds.push_back({speed, weight / sum});
  }
  return speeds;
}

double share_of_time(const std::vector<ClimatePart>& climate, double speed) {
  double sum = 0.0, below = 0.0;
  for (const auto& part : climate) {
    sum += part.weight;
    below += part.weight * share_of(part, speed);
  }
  if (!(sum > 0.0)) {
    throw InvalidInput("share_of_time: expected a climate of a weight above 0, found none");
  }
  return below / sum;
}

double highest_speed(const std::vector<ClimatePart>& climate) {
  double highest = 0.0;
  for (const auto& part : climate) highest = std::max(highest, highest_of(part));
  return highest;
}

}  // namespace boresight::design
