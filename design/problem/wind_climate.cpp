#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/gauss_rule.hpp>

namespace boresight::design {
namespace {

constexpr int points = 4;  // of a panel
// They shrink towards calm, where a Weibull density may have no derivatives.
constexpr int panels = 12;
constexpr double negligible = 1e-12;

bool within(double value, double minimum, double maximum) {
  return value >= minimum && value <= maximum;
}

// ln((v/scale)^shape) at v = ratio x mean. Convex in the shape: its slope, with x = 1/shape
// ln(ratio) + ln(Gamma(1 + x)) - x psi(1 + x), falls with x.
double log_exponent(double ratio, double shape) {
  return shape * std::log(ratio * std::tgamma(1.0 + 1.0 / shape));
}

double fraction_above(double ratio, double shape) {
  return std::exp(-std::exp(log_exponent(ratio, shape)));
}

// The shape with the largest fraction, which is that of the least exponent.
double shape_of_most(double ratio) {
  double low = lowest_shape_sought, high = highest_shape_sought;
  for (int step = 0; step < 100; ++step) {
    const double third = (high - low) / 3.0;
    if (log_exponent(ratio, low + third) > log_exponent(ratio, high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  return 0.5 * (low + high);
}

// By bisection, between a shape of a lower exponent and one of a higher.
std::optional<double> shape_between(double ratio, double exponent, double lower, double higher) {
  if (log_exponent(ratio, lower) > exponent || log_exponent(ratio, higher) < exponent) {
    return std::nullopt;
  }
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (lower + higher);
    (log_exponent(ratio, middle) < exponent ? lower : higher) = middle;
  }
  return 0.5 * (lower + higher);
}

double highest_of(const ClimatePart& part) {
  const auto* controller = std::get_if<WeibullClimate>(&part.winds);
  return controller != nullptr ? controller->highest : std::get<double>(part.winds);
}

// How much of the part's time its speed is at most that.
double fraction_of(const ClimatePart& part, double speed) {
  if (speed >= highest_of(part) * (1.0 - 1e-9)) return 1.0;
  const auto* controller = std::get_if<WeibullClimate>(&part.winds);
  if (controller == nullptr) return 0.0;
  const auto below = [&](double v) {
    return -std::expm1(-std::pow(v / controller->scale, controller->shape));
  };
  return below(std::max(0.0, speed)) / below(controller->highest);
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
  const numerics::GaussRule rule = numerics::gauss_rule(points);
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

WeibullClimate weibull_climate(double mean, double shape, double highest) {
  return {mean / std::tgamma(1.0 + 1.0 / shape), shape, highest};
}

WeibullShapes weibull_shapes(double ratio, double fraction) {
  if (!within(ratio, 1e-3, 1e3) || !(fraction > 0.0) || !(fraction <= 1.0)) {
    throw InvalidInput(fmt::format(
        "weibull_shapes: expected a speed of 0.001 to 1000 times the mean and a fraction "
        "above 0 and at most 1, found {} times and {}",
        ratio, fraction));
  }
  const double maximum = shape_of_most(ratio);
  const double exponent = std::log(-std::log(fraction));
  WeibullShapes found;
  found.min_fraction = std::min(fraction_above(ratio, lowest_shape_sought),
                                fraction_above(ratio, highest_shape_sought));
  found.max_fraction = fraction_above(ratio, maximum);
  constexpr double same = 1e-3;
  for (const double end : {lowest_shape_sought, highest_shape_sought}) {
    const auto shape = shape_between(ratio, exponent, maximum, end);
    if (!shape) continue;
    if (found.shapes.empty() || *shape > found.shapes.front() + same) {
      found.shapes.push_back(*shape);
    }
  }
  return found;
}

double fraction_of_time(const std::vector<ClimatePart>& climate, double speed) {
  double sum = 0.0, below = 0.0;
  for (const auto& part : climate) {
    sum += part.weight;
    below += part.weight * fraction_of(part, speed);
  }
  if (!(sum > 0.0)) {
    throw InvalidInput("fraction_of_time: expected a climate of a weight above 0, found none");
  }
  return below / sum;
}

double highest_speed(const std::vector<ClimatePart>& climate) {
  double highest = 0.0;
  for (const auto& part : climate) highest = std::max(highest, highest_of(part));
  return highest;
}

}  // namespace boresight::design
