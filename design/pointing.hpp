#pragma once

#include <string_view>

namespace boresight::design {

/// Half-power beamwidth k lambda/D (rad); k (rad) is 61 to 70 degrees with the illumination,
/// frequency in Hz, dish diameter in m. @throws InvalidInput unless all are positive, or for a
/// wavelength longer than the dish, where a beam has no meaning.
double half_power_beamwidth(double beamwidth_factor, double frequency, double dish_diameter);

/// What "0.1 dB" is taken of; sigma is the rms of one axis.
enum class LossConvention {
  /// Mean loss over two equal axes: 24 sigma^2/HPBW^2.
  mean_loss_two_axes,
  /// Mean loss with one axis alone in error: 12 sigma^2/HPBW^2.
  mean_loss_one_axis,
  /// Loss at the mean radial error sigma sqrt(pi/2) of two equal axes.
  loss_at_mean_radial_error,
};
std::string_view to_string(LossConvention convention);

/// Loss (dB) of a Gaussian beam, 12 (theta/HPBW)^2, at rms error sigma (rad) an axis.
double pointing_loss_db(double rms, double beamwidth, LossConvention convention);

/// The rms error (rad) an axis that costs `loss_db`: the inverse of pointing_loss_db.
double rms_for_loss(double loss_db, double beamwidth, LossConvention convention);

}  // namespace boresight::design
