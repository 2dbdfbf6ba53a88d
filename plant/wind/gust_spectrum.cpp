#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/gust_spectrum.hpp>

namespace boresight::plant {
namespace {

constexpr double davenport_length = 1200.0;

void require_positive(std::string_view function, const char* name, double value, const char* unit) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidInput(
      fmt::format("{}: expected {} above 0, found {} {}", function, name, value, unit));
}

void require_not_negative(std::string_view function, const char* name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw InvalidInput(fmt::format("{}: expected {} of at least 0, found {}", function, name, value));
}

// 2 sqrt(pi) Gamma(1/3)/Gamma(5/6), the square root of von Karman's c.
double von_karman_root() {
  static const double root =
      2.0 * std::sqrt(std::numbers::pi) * std::tgamma(1.0 / 3.0) / std::tgamma(5.0 / 6.0);
  return root;
}

}  // namespace

std::string_view to_string(GustSpectrumKind kind) {
  switch (kind) {
    case GustSpectrumKind::davenport:
      return "davenport";
    case GustSpectrumKind::von_karman:
      return "von_karman";
    case GustSpectrumKind::kaimal:
      return "kaimal";
    case GustSpectrumKind::eurocode:
      return "eurocode";
  }
  throw InvalidInput("to_string: not a kind of gust spectrum");
}

GustSpectrum davenport_gusts(double surface_drag) {
  const GustSpectrum gusts{GustSpectrumKind::davenport, surface_drag, 0.0, 0.0};
  validate(gusts, "davenport_gusts");
  return gusts;
}

GustSpectrum von_karman_gusts(double turbulence_intensity, double length_scale) {
  const GustSpectrum gusts{GustSpectrumKind::von_karman, 0.0, turbulence_intensity, length_scale};
  validate(gusts, "von_karman_gusts");
  return gusts;
}

GustSpectrum kaimal_gusts(double turbulence_intensity, double height) {
  const GustSpectrum gusts{GustSpectrumKind::kaimal, 0.0, turbulence_intensity,
                           kaimal_length_scale(height)};
  validate(gusts, "kaimal_gusts");
  return gusts;
}

GustSpectrum eurocode_gusts(double height, double roughness_length, double minimum_height) {
  return {GustSpectrumKind::eurocode, 0.0,
          eurocode_turbulence_intensity(height, roughness_length, minimum_height),
          eurocode_length_scale(height, roughness_length, minimum_height)};
}

void validate(const GustSpectrum& gusts, std::string_view function) {
  switch (gusts.kind) {
    case GustSpectrumKind::davenport:
      require_not_negative(function, "a surface_drag", gusts.surface_drag);
      return;
    case GustSpectrumKind::von_karman:
    case GustSpectrumKind::kaimal:
    case GustSpectrumKind::eurocode:
      require_not_negative(function, "a turbulence_intensity", gusts.turbulence_intensity);
      require_positive(function, "a length_scale", gusts.length_scale, "m");
      return;
  }
  throw InvalidInput(fmt::format("{}: not a kind of gust spectrum", function));
}

double gust_spectrum(const GustSpectrum& gusts, double mean_speed, double frequency) {
  require_positive("gust_spectrum", "a mean_speed", mean_speed, "m/s");
  require_positive("gust_spectrum", "a frequency", frequency, "Hz");
  validate(gusts, "gust_spectrum");
  if (gusts.kind == GustSpectrumKind::davenport) {
    const double x = davenport_length * frequency / mean_speed;
    return 4.0 * gusts.surface_drag * mean_speed * mean_speed * x * x /
           (frequency * std::pow(1.0 + x * x, 4.0 / 3.0));
  }
  const double time_scale = gusts.length_scale / mean_speed;
  const double x = frequency * time_scale;
  const double at_zero = gust_variance(gusts, mean_speed) * time_scale;
  switch (gusts.kind) {
    case GustSpectrumKind::von_karman:
      return 4.0 * at_zero / std::pow(1.0 + std::pow(von_karman_root() * x, 2), 5.0 / 6.0);
    case GustSpectrumKind::kaimal:
      return 4.0 * at_zero / std::pow(1.0 + 6.0 * x, 5.0 / 3.0);
    default:
      return 6.8 * at_zero / std::pow(1.0 + 10.2 * x, 5.0 / 3.0);
  }
}

double gust_variance(const GustSpectrum& gusts, double mean_speed) {
  require_positive("gust_variance", "a mean_speed", mean_speed, "m/s");
  validate(gusts, "gust_variance");
  if (gusts.kind == GustSpectrumKind::davenport) {
    return 6.0 * gusts.surface_drag * mean_speed * mean_speed;
  }
  return std::pow(gusts.turbulence_intensity * mean_speed, 2);
}

double davenport_spectrum(double surface_drag, double mean_speed, double frequency) {
  return gust_spectrum({GustSpectrumKind::davenport, surface_drag, 0.0, 0.0}, mean_speed,
                       frequency);
}

double davenport_surface_drag(double height, double roughness_length) {
  require_positive("davenport_surface_drag", "a roughness_length", roughness_length, "m");
  if (!(height > roughness_length) || !std::isfinite(height)) {
    throw InvalidInput(fmt::format(
        "davenport_surface_drag: expected a height above the roughness_length of {} m, found {} m",
        roughness_length, height));
  }
  return std::pow(0.4 / std::log(height / roughness_length), 2);
}

double von_karman_length_scale(double height) {
  require_positive("von_karman_length_scale", "a height", height, "m");
  return 100.0 * std::sqrt(std::max(height / 30.0, 1.0));
}

double kaimal_length_scale(double height) {
  require_positive("kaimal_length_scale", "a height", height, "m");
  return 8.1 * 0.7 * std::min(height, 60.0);
}

double eurocode_length_scale(double height, double roughness_length, double minimum_height) {
  require_positive("eurocode_length_scale", "a height", height, "m");
  require_positive("eurocode_length_scale", "a roughness_length", roughness_length, "m");
  require_positive("eurocode_length_scale", "a minimum_height", minimum_height, "m");
  const double exponent = 0.67 + 0.05 * std::log(roughness_length);
  return 300.0 * std::pow(std::max(height, minimum_height) / 200.0, exponent);
}

double eurocode_turbulence_intensity(double height, double roughness_length,
                                     double minimum_height) {
  constexpr const char* function = "eurocode_turbulence_intensity";
  require_positive(function, "a height", height, "m");
  require_positive(function, "a roughness_length", roughness_length, "m");
  require_positive(function, "a minimum_height", minimum_height, "m");
  const double effective = std::max(height, minimum_height);
  if (!(effective > roughness_length)) {
    throw InvalidInput(fmt::format(
        "{}: expected a height or minimum_height above the roughness_length of {} m, found {} m",
        function, roughness_length, effective));
  }
  return 1.0 / std::log(effective / roughness_length);
}

}  // namespace boresight::plant
