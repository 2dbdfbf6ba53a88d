#pragma once

#include <optional>
#include <string_view>

#include <boresight/plant/wind/gust_spectrum.hpp>

namespace boresight::plant {

/// How gusts over the dish add up to axis torque.
enum class WindModel {
  /// One gust over the whole dish: (2T/V)^2 S_v.
  uniform,
  /// The same with Vickery's drag admittance squared, 1/(1 + (2 f sqrt(A)/V)^(4/3))^2.
  vickery,
  /// Davenport's coherence exp(-c f r/V) over pairs of points of the disc: a uniform part
  /// (2T/V)^2 S_v <coh> and a gradient part (rho V Cn A)^2 S_v <y y' coh>, which gives torque even
  /// where the mean torque coefficient is zero.
  coherence,
};
std::string_view to_string(WindModel model);

/// The wind at the site and how the dish takes it.
struct WindSite {
  double air_density = 0.0;           // kg/m3
  double surface_drag = 0.0;          // Davenport's kappa; gust variance 6 kappa V^2
  double torque_coefficient = 0.0;    // CT: mean torque 1/2 rho V^2 A D CT
  double gradient_coefficient = 0.0;  // Cn
  double coherence_decay = 0.0;       // c
  double dish_diameter = 0.0;         // m
  /// The spectrum of the gusts, if not Davenport's with the surface_drag above.
  std::optional<GustSpectrum> gusts = std::nullopt;

  bool operator==(const WindSite&) const = default;
};

/// @throws InvalidInput, naming `function`, unless all is finite, air_density, surface_drag,
/// coherence_decay and dish_diameter are at least 0, and the gusts are valid.
void validate(const WindSite& site, std::string_view function);

/// The spectrum of the gusts at the site: its `gusts`, or else Davenport's.
GustSpectrum site_gusts(const WindSite& site);

/// Mean torque at the antenna axis, 1/2 rho V^2 A D CT (N m); V >= 0 (m/s).
/// @throws InvalidInput for the speed and as validate.
double mean_wind_torque(const WindSite& site, double mean_speed);

/// What a slow gust over the whole dish adds to the torque per speed, dT/dV = 2T/V = rho V A D CT
/// (N m per m/s); V >= 0 (m/s). @throws InvalidInput for the speed and as validate.
double wind_torque_sensitivity(const WindSite& site, double mean_speed);

/// Averages of exp(-a r/R) over pairs of points of a disc of radius R, r their distance:
/// `uniform` is <coh>, `gradient` is <y y' coh>/R^2, y one coordinate from the centre. At a = 0
/// they are 1 and 0. One-dimensional integrals over the density of the distance (physics of the
/// reference antenna, section 4), by Gauss-Legendre quadrature to about 1e-10.
/// @throws InvalidInput unless a is finite and at least 0.
struct CoherenceAverages {
  double uniform = 0.0;
  double gradient = 0.0;
};
CoherenceAverages coherence_averages(double decay_per_radius);

/// Fraction of a gust's amplitude that acts on the whole dish at a frequency, relative to a gust
/// uniform over the dish; 1 at low frequencies. uniform: 1.
/// vickery: 1/(1 + (2 f sqrt(A)/V)^(4/3)). coherence: sqrt<coh>, of the uniform part.
/// f >= 0 (Hz), V > 0 (m/s).
/// @throws InvalidInput for these and as validate.
double wind_admittance(const WindSite& site, WindModel model, double mean_speed, double frequency);

/// The part of the torque from the mean of the gust over the dish, the part from its gradient
/// (none in the uniform and Vickery models), or both. The two are independent.
enum class WindTorquePart { both, uniform, gradient };

/// One-sided spectrum of the wind torque at the antenna axis, (N m)^2/Hz, with the site's gusts; V
/// the mean speed, used at every height. @throws InvalidInput unless frequency and speed are
/// positive and finite, and as validate.
double wind_torque_spectrum(const WindSite& site, WindModel model, double mean_speed,
                            double frequency, WindTorquePart part = WindTorquePart::both);

}  // namespace boresight::plant
