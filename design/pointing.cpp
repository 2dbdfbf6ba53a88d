#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/pointing.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::design {
namespace {

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

double pointing_loss_db(double rms, double beamwidth, LossConvention convention) {
  return loss_factor(convention) * (rms / beamwidth) * (rms / beamwidth);
}

double rms_for_loss(double loss_db, double beamwidth, LossConvention convention) {
  return beamwidth * std::sqrt(loss_db / loss_factor(convention));
}

}  // namespace boresight::design
