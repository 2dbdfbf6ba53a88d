#pragma once

#include <string_view>

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
};

/// Davenport's spectrum of the longitudinal gust, one-sided in Hz, (m/s)^2/Hz:
/// S_v(f) = 4 kappa V^2 x^2 / (f (1 + x^2)^(4/3)), x = 1200 f/V. Integrates to 6 kappa V^2.
/// f > 0 (Hz), mean speed V > 0 (m/s).
double davenport_spectrum(double surface_drag, double mean_speed, double frequency);

/// Mean torque at the antenna axis, 1/2 rho V^2 A D CT (N m).
double mean_wind_torque(const WindSite& site, double mean_speed);

/// Averages of exp(-a r/R) over pairs of points of a disc of radius R, r their distance:
/// `uniform` is <coh>, `gradient` is <y y' coh>/R^2, y one coordinate from the centre. At a = 0
/// they are 1 and 0. One-dimensional integrals over the density of the distance (physics of the
/// reference antenna, section 4), by Gauss-Legendre quadrature to about 1e-10.
struct CoherenceAverages {
  double uniform = 0.0;
  double gradient = 0.0;
};
CoherenceAverages coherence_averages(double decay_per_radius);

/// One-sided spectrum of the wind torque at the antenna axis, (N m)^2/Hz; V the mean speed, used at
/// every height. @throws InvalidInput unless frequency and speed are positive and finite.
double wind_torque_spectrum(const WindSite& site, WindModel model, double mean_speed,
                            double frequency);

}  // namespace boresight::plant
