#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <boresight/plant/error.hpp>
#include <boresight/plant/wind.hpp>

namespace boresight::plant {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int nodes = 48;

struct Quadrature {
  std::array<double, nodes> abscissa;
  std::array<double, nodes> weight;
};

// Gauss-Legendre on [-1, 1] by Newton's iteration on the Legendre polynomial.
Quadrature gauss_legendre() {
  Quadrature rule{};
  for (int i = 0; i < nodes; ++i) {
    double x = std::cos(pi * (i + 0.75) / (nodes + 0.5));
    double slope = 1.0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double previous = 1.0, value = x;
      for (int k = 2; k <= nodes; ++k) {
        previous = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * previous) / k);
      }
      slope = nodes * (x * value - previous) / (x * x - 1.0);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.abscissa[static_cast<std::size_t>(i)] = x;
    rule.weight[static_cast<std::size_t>(i)] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

// Density of the distance r = 2 R t of two random points of the disc, per t.
double distance_density(double t) {
  return 16.0 * t / pi * (std::acos(t) - t * std::sqrt((1.0 - t) * (1.0 + t)));
}

// Mean square distance from the middle of the lens common to two unit discs whose centres are
// 2 t apart, over that lens: two circular segments, integrated in closed form.
double lens_mean_square(double t) {
  const double angle = std::acos(t);
  const double height = std::sqrt((1.0 - t) * (1.0 + t));
  const double area = angle - t * height;
  const double tangent_terms = t * t * t * height + t * height * height * height / 3.0;
  const double about_disc = 0.5 * (angle - tangent_terms);
  return (about_disc - 4.0 / 3.0 * t * height * height * height) / area + t * t;
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

double davenport_spectrum(double surface_drag, double mean_speed, double frequency) {
  const double x = 1200.0 * frequency / mean_speed;
  return 4.0 * surface_drag * mean_speed * mean_speed * x * x /
         (frequency * std::pow(1.0 + x * x, 4.0 / 3.0));
}

double mean_wind_torque(const WindSite& site, double mean_speed) {
  const double area = pi / 4.0 * site.dish_diameter * site.dish_diameter;
  return 0.5 * site.air_density * mean_speed * mean_speed * area * site.dish_diameter *
         site.torque_coefficient;
}

CoherenceAverages coherence_averages(double decay_per_radius) {
  static const Quadrature rule = gauss_legendre();
  const double exponent = 2.0 * decay_per_radius;
  // Beyond 45 decay lengths the integrand is below rounding. t = end sin^2 softens the ends.
  const double end = exponent > 45.0 ? 45.0 / exponent : 1.0;
  CoherenceAverages averages;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double phase = pi / 4.0 * (rule.abscissa[i] + 1.0);
    const double sine = std::sin(phase);
    const double t = end * sine * sine;
    const double step = end * 2.0 * sine * std::cos(phase) * pi / 4.0 * rule.weight[i];
    const double density = distance_density(t) * std::exp(-exponent * t) * step;
    averages.uniform += density;
    averages.gradient += density * 0.5 * (lens_mean_square(t) - t * t);
  }
  return averages;
}

double wind_torque_spectrum(const WindSite& site, WindModel model, double mean_speed,
                            double frequency) {
  if (!(mean_speed > 0.0) || !(frequency > 0.0) || !std::isfinite(mean_speed * frequency)) {
    throw InvalidInput(
        fmt::format("wind_torque_spectrum: expected positive finite mean speed and frequency, "
                    "found {} m/s, {} Hz",
                    mean_speed, frequency));
  }
  const double gust = davenport_spectrum(site.surface_drag, mean_speed, frequency);
  const double per_gust = 2.0 * mean_wind_torque(site, mean_speed) / mean_speed;
  const double area = pi / 4.0 * site.dish_diameter * site.dish_diameter;
  switch (model) {
    case WindModel::uniform:
      return per_gust * per_gust * gust;
    case WindModel::vickery: {
      const double x = 2.0 * frequency * std::sqrt(area) / mean_speed;
      const double admittance = 1.0 / (1.0 + std::pow(x, 4.0 / 3.0));
      return per_gust * per_gust * gust * admittance * admittance;
    }
    case WindModel::coherence: {
      const double radius = 0.5 * site.dish_diameter;
      const auto [uniform, gradient] =
          coherence_averages(site.coherence_decay * frequency * radius / mean_speed);
      const double lever =
          site.air_density * mean_speed * site.gradient_coefficient * area * radius;
      return gust * (per_gust * per_gust * uniform + lever * lever * gradient);
    }
  }
  throw InvalidInput("wind_torque_spectrum: not a wind model");
}

}  // namespace boresight::plant
