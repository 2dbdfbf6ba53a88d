#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/problem/pointing.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/gauss_rule.hpp>

namespace boresight::design {
namespace {

// Over the half-power beam neither field nor Bessel function turns more than once: this many panels
// of Gauss's five points leave less than 1e-12.
constexpr int panels = 40;
constexpr int points = 5;

double field(const Illumination& illumination, double radius) {
  const double edge = std::pow(10.0, -illumination.edge_taper_db / 20.0);
  const double square = radius * radius;
  if (illumination.shape == IlluminationShape::gaussian) return std::pow(edge, square);
  return edge + (1.0 - edge) * std::pow(1.0 - square, illumination.exponent);
}

// Integral over the aperture of field J0(u r) r dr. With r = 1 - t^2 the edge, where a parabola of
// broken exponent has no derivatives, is smooth too.
double pattern(const Illumination& illumination, double u) {
  static const numerics::GaussRule rule = numerics::gauss_rule(points);
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double t = (panel + 0.5 * (rule.node[i] + 1.0)) / panels;
      const double r = 1.0 - t * t;
      sum += rule.weight[i] * 0.5 / panels * 2.0 * t * field(illumination, r) *
             std::cyl_bessel_j(0.0, u * r) * r;
    }
  }
  return sum;
}

double loss_factor(LossConvention convention) {
  switch (convention) {
    case LossConvention::mean_loss_two_axes:
      return 24.0;
    case LossConvention::mean_loss_one_axis:
      return 12.0;
    case LossConvention::loss_at_mean_radial_error:
      return 12.0 * std::numbers::pi / 2.0;
  }
  throw InvalidInput("pointing loss: not a loss convention");
}

}  // namespace

std::string_view to_string(LossConvention convention) {
  switch (convention) {
    case LossConvention::mean_loss_two_axes:
      return "mean loss over two equal axes";
    case LossConvention::mean_loss_one_axis:
      return "mean loss, one axis alone";
    case LossConvention::loss_at_mean_radial_error:
      return "loss at the mean radial error";
  }
  throw InvalidInput("to_string: not a loss convention");
}

double half_power_beamwidth(double beamwidth_factor, double frequency, double dish_diameter) {
  constexpr double light_speed = 299792458.0;
  const double wavelength = light_speed / frequency;
  if (!(beamwidth_factor > 0.0) || !(frequency > 0.0) || !(dish_diameter > 0.0) ||
      !(wavelength < dish_diameter)) {
    throw InvalidInput(fmt::format(
        "half_power_beamwidth: expected positive numbers and a wavelength shorter than the dish, "
        "found factor {} rad, {} Hz, {} m",
        beamwidth_factor, frequency, dish_diameter));
  }
  return beamwidth_factor * wavelength / dish_diameter;
}

std::string_view to_string(IlluminationShape shape) {
  return shape == IlluminationShape::gaussian ? "gaussian" : "parabola";
}

double beamwidth_factor(const Illumination& illumination) {
  if (!(illumination.edge_taper_db >= 0.0) || !(illumination.edge_taper_db <= 60.0) ||
      !(illumination.exponent >= 0.5) || !(illumination.exponent <= 8.0)) {
    throw InvalidInput(fmt::format(
        "beamwidth_factor: expected an edge taper of 0 to 60 dB and an exponent of 0.5 to 8, found "
        "{} dB and {}",
        illumination.edge_taper_db, illumination.exponent));
  }
  const double half = pattern(illumination, 0.0) / std::numbers::sqrt2;
  double low = 0.0, high = 12.0;  // beyond the half power of every illumination in range
  while (high - low > 1e-11) {
    const double middle = 0.5 * (low + high);
    (pattern(illumination, middle) > half ? low : high) = middle;
  }
  return 2.0 / std::numbers::pi * low;
}

double pointing_loss_db(double rms, double beamwidth, LossConvention convention) {
  return loss_factor(convention) * (rms / beamwidth) * (rms / beamwidth);
}

double rms_for_loss(double loss_db, double beamwidth, LossConvention convention) {
  return beamwidth * std::sqrt(loss_db / loss_factor(convention));
}

}  // namespace boresight::design
