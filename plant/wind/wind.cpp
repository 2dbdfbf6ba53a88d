#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/gauss_rule.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::plant {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int nodes = 48;

// One node of the quadrature over the distance r = 2 R t of two random points of the disc.
struct DistanceNode {
  double t = 0.0;
  double weight = 0.0;    // of the node, times the density of the distance
  double gradient = 0.0;  // mean of y y'/R^2 at that distance
};

// t = end sin^2 softens the ends.
DistanceNode distance_node(double node, double weight, double end) {
  const double phase = pi / 4.0 * (node + 1.0);
  const double sine = std::sin(phase);
  const double t = end * sine * sine;
  const double step = end * 2.0 * sine * std::cos(phase) * pi / 4.0 * weight;
  const double angle = std::acos(t);
  const double height = std::sqrt((1.0 - t) * (1.0 + t));
  const double area = angle - t * height;
  // Mean square distance from the middle of the lens common to two unit discs whose centres are
  // 2 t apart, over that lens, less t^2: two circular segments, integrated in closed form.
  const double tangent_terms = t * t * t * height + t * height * height * height / 3.0;
  const double about_disc = 0.5 * (angle - tangent_terms);
  const double lens = (about_disc - 4.0 / 3.0 * t * height * height * height) / area;
  return {t, 16.0 * t / pi * area * step, 0.5 * lens};
}

std::array<DistanceNode, nodes> distance_nodes(double end) {
  static const numerics::GaussRule rule = numerics::gauss_rule(nodes);
  std::array<DistanceNode, nodes> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = distance_node(rule.node[i], rule.weight[i], end);
  }
  return result;
}

CoherenceAverages average(const std::array<DistanceNode, nodes>& over, double exponent) {
  CoherenceAverages averages;
  for (const auto& [t, weight, gradient] : over) {
    const double density = weight * std::exp(-exponent * t);
    averages.uniform += density;
    averages.gradient += density * gradient;
  }
  return averages;
}

double disc_area(const WindSite& site) {
  return pi / 4.0 * site.dish_diameter * site.dish_diameter;
}

double torque(const WindSite& site, double mean_speed) {
  return 0.5 * site.air_density * mean_speed * mean_speed * disc_area(site) * site.dish_diameter *
         site.torque_coefficient;
}

double vickery_admittance(const WindSite& site, double mean_speed, double frequency) {
  const double x = 2.0 * frequency * std::sqrt(disc_area(site)) / mean_speed;
  return 1.0 / (1.0 + std::pow(x, 4.0 / 3.0));
}

CoherenceAverages averages_over_dish(const WindSite& site, double mean_speed, double frequency) {
  const double radius = 0.5 * site.dish_diameter;
  return coherence_averages(site.coherence_decay * frequency * radius / mean_speed);
}

void check_speed(const char* function, const WindSite& site, double mean_speed) {
  validate(site, function);
  if (mean_speed >= 0.0 && std::isfinite(mean_speed)) return;
  throw InvalidInput(
      fmt::format("{}: expected a mean speed of at least 0, found {} m/s", function, mean_speed));
}

}  // namespace

std::string_view to_string(WindModel model) {
  switch (model) {
    case WindModel::uniform:
      return "uniform";
    case WindModel::vickery:
      return "vickery";
    case WindModel::coherence:
      return "coherence";
  }
  throw InvalidInput("to_string: not a wind model");
}

void validate(const WindSite& site, std::string_view function) {
  const auto refuse = [&](const char* name, double value, const char* expected) {
    throw InvalidInput(
        fmt::format("{}: expected {} that is {}, found {}", function, name, expected, value));
  };
  for (const auto& [name, value] : {std::pair{"an air_density", site.air_density},
                                    std::pair{"a surface_drag", site.surface_drag},
                                    std::pair{"a coherence_decay", site.coherence_decay},
                                    std::pair{"a dish_diameter", site.dish_diameter}}) {
    if (!(value >= 0.0) || !std::isfinite(value)) refuse(name, value, "at least 0");
  }
  for (const auto& [name, value] :
       {std::pair{"a torque_coefficient", site.torque_coefficient},
        std::pair{"a gradient_coefficient", site.gradient_coefficient}}) {
    if (!std::isfinite(value)) refuse(name, value, "finite");
  }
  if (site.gusts) validate(*site.gusts, function);
}

GustSpectrum site_gusts(const WindSite& site) {
  return site.gusts ? *site.gusts : davenport_gusts(site.surface_drag);
}

double mean_wind_torque(const WindSite& site, double mean_speed) {
  check_speed("mean_wind_torque", site, mean_speed);
  return torque(site, mean_speed);
}

double wind_torque_sensitivity(const WindSite& site, double mean_speed) {
  check_speed("wind_torque_sensitivity", site, mean_speed);
  return site.air_density * mean_speed * disc_area(site) * site.dish_diameter *
         site.torque_coefficient;
}

CoherenceAverages coherence_averages(double decay_per_radius) {
  if (!(decay_per_radius >= 0.0) || !std::isfinite(decay_per_radius)) {
    throw InvalidInput(
        fmt::format("coherence_averages: expected a decay_per_radius of at least 0, found {}",
                    decay_per_radius));
  }
  static const auto whole = distance_nodes(1.0);
  const double exponent = 2.0 * decay_per_radius;
  // Beyond 45 decay lengths the integrand is below rounding.
  return exponent > 45.0 ? average(distance_nodes(45.0 / exponent), exponent)
                         : average(whole, exponent);
}

double wind_admittance(const WindSite& site, WindModel model, double mean_speed, double frequency) {
  validate(site, "wind_admittance");
  if (!(mean_speed > 0.0) || !(frequency >= 0.0) || !std::isfinite(mean_speed) ||
      !std::isfinite(frequency)) {
    throw InvalidInput(
        fmt::format("wind_admittance: expected a mean speed above 0 and a frequency of at least 0, "
                    "found {} m/s, {} Hz",
                    mean_speed, frequency));
  }
  switch (model) {
    case WindModel::uniform:
      return 1.0;
    case WindModel::vickery:
      return vickery_admittance(site, mean_speed, frequency);
    case WindModel::coherence:
      return std::sqrt(averages_over_dish(site, mean_speed, frequency).uniform);
  }
  throw InvalidInput("wind_admittance: not a wind model");
}

double wind_torque_spectrum(const WindSite& site, WindModel model, double mean_speed,
                            double frequency, WindTorquePart part) {
  if (!(mean_speed > 0.0) || !(frequency > 0.0) || !std::isfinite(mean_speed * frequency)) {
    throw InvalidInput(
        fmt::format("wind_torque_spectrum: expected positive finite mean speed and frequency, "
                    "found {} m/s, {} Hz",
                    mean_speed, frequency));
  }
  validate(site, "wind_torque_spectrum");
  const double gust = gust_spectrum(site_gusts(site), mean_speed, frequency);
  const double per_gust =
      part == WindTorquePart::gradient ? 0.0 : 2.0 * torque(site, mean_speed) / mean_speed;
  switch (model) {
    case WindModel::uniform:
      return per_gust * per_gust * gust;
    case WindModel::vickery: {
      const double admittance = vickery_admittance(site, mean_speed, frequency);
      return per_gust * per_gust * gust * admittance * admittance;
    }
    case WindModel::coherence: {
      const auto [uniform, gradient] = averages_over_dish(site, mean_speed, frequency);
      const double lever = part == WindTorquePart::uniform
                               ? 0.0
                               : site.air_density * mean_speed * site.gradient_coefficient *
                                     disc_area(site) * (0.5 * site.dish_diameter);
      return gust * (per_gust * per_gust * uniform + lever * lever * gradient);
    }
  }
  throw InvalidInput("wind_torque_spectrum: not a wind model");
}

}  // namespace boresight::plant
