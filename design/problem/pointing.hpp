#pragma once

#include <string_view>

namespace boresight::design {

/// Half-power beamwidth k lambda/D (rad). k (rad) is 61 to 70 degrees, depending on the
/// illumination; frequency in Hz, dish diameter in m.
/// @throws InvalidInput unless all are positive, or for a wavelength longer than the dish diameter,
/// where the beamwidth is undefined.
double half_power_beamwidth(double beamwidth_factor, double frequency, double dish_diameter);

/// Illumination of the aperture by the feed: field over the radius r (0 at the centre, 1 at the
/// edge). Edge level b = 10^(-T/20), T the edge taper in dB:
///   parabola_on_pedestal   b + (1 - b) (1 - r^2)^p
///   gaussian               b^(r^2)
/// J. W. M. Baars, The Paraboloidal Reflector Antenna in Radio Astronomy and Communication, 2007,
/// section 4.3 (both, with their beamwidths).
enum class IlluminationShape { parabola_on_pedestal, gaussian };
std::string_view to_string(IlluminationShape shape);
struct Illumination {
  IlluminationShape shape = IlluminationShape::parabola_on_pedestal;
  double edge_taper_db = 0.0;  // T, 0 (uniform) to 60
  double exponent = 1.0;       // p of the parabola, 0.5 to 8
};

/// k (rad) of the half-power beamwidth k lambda/D of a circular aperture without blockage. It is
/// 2/pi times the u at which the pattern has half of its on-axis power (small angles, u = pi D
/// theta/lambda). The pattern is the integral of field(r) J0(u r) r dr. Values: 1.02899 rad (58.96
/// deg) for uniform illumination, 65.3 deg for a parabola with 10 dB, (2/pi) sqrt(T ln 10 ln 2/10)
/// for a strongly tapered Gaussian. Computed by Gauss-Legendre quadrature and bisection to 1e-10.
/// @throws InvalidInput outside the ranges above.
double beamwidth_factor(const Illumination& illumination);

/// Definition of a pointing loss such as "0.1 dB"; sigma is the rms error per axis.
enum class LossConvention {
  /// Mean loss with equal errors in two axes: 24 sigma^2/HPBW^2.
  mean_loss_two_axes,
  /// Mean loss with an error in one axis only: 12 sigma^2/HPBW^2.
  mean_loss_one_axis,
  /// Loss at the mean radial error sigma sqrt(pi/2) of two equal axes.
  loss_at_mean_radial_error,
};
std::string_view to_string(LossConvention convention);

/// Loss (dB) of a Gaussian main lobe, 12 (theta/HPBW)^2, at rms error sigma (rad) per axis.
double pointing_loss_db(double rms, double beamwidth, LossConvention convention);

/// The rms error (rad) per axis at a loss of `loss_db`: the inverse of pointing_loss_db.
double rms_for_loss(double loss_db, double beamwidth, LossConvention convention);

}  // namespace boresight::design
