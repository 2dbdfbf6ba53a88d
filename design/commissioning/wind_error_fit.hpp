#pragma once

#include <array>
#include <vector>

#include <boresight/design/commissioning/ratio_band.hpp>

namespace boresight::design {

/// Exponent of the mean wind speed in the variance of an error, and its standard deviation between
/// antennas and controllers: the prior of WindErrorFit.
inline constexpr double usual_wind_exponent = 5.3, usual_wind_exponent_deviation = 0.7;
/// The same of the gusts' exponent.
inline constexpr double usual_gust_exponent = 0.5, usual_gust_exponent_deviation = 0.5;

/// One record's error in its wind.
struct ErrorInWind {
  bool after = false;      // which of the two conditions
  double variance = 0.0;   // of the error, above 0
  double freedom = 0.0;    // equivalent degrees of freedom of the variance, above 0
  double speed = 0.0;      // mean wind speed, m/s, above 0
  double log_gusts = 0.0;  // log of the variance of the gusts over what is usual at that speed
};

/// Variance of the error against the wind, of two conditions (0 before, 1 after):
///   E variance = a + b (speed/reference)^p exp(theta log_gusts),   a, b >= 0
/// with a and b of each condition and p and theta in common. a is the error in still air.
///
/// Torque is proportional to the square of the speed, hence its fluctuation to speed times gust,
/// and the gusts to the speed: p is 4 for gusts uniform over the dish at all frequencies. A loop
/// suppresses the slow ones. At a frequency f above V/L the spectrum of the gusts has
/// (V/f)^(2/3) more, and the dish averages fewer of them with increasing V: up to 2 more. p
/// therefore has a prior of 5.3 +- 0.7. theta is below 1 because a mast measures other small gusts
/// than the dish takes; its prior is 0.5 +- 0.5.
///
/// Quasi-likelihood of the gamma distribution (P. McCullagh, J. A. Nelder, Generalized Linear
/// Models, 2nd ed., 8 and 9): the scatter of a variance is proportional to its mean. A record has
/// the weight freedom/(freedom + median freedom), twice that: the turbulence of a longer one
/// scatters less, but differs from day to day as well. The dispersion is Pearson's of both
/// conditions together, and not below what the records' freedom alone implies.
class WindErrorFit {
 public:
  /// @throws InvalidInput unless both conditions have 3 records or more and all values are in
  /// range.
  WindErrorFit(std::vector<ErrorInWind> records, double reference_speed);

  /// Ratio of rms, after over before, at a speed (m/s): interval by the delta method for its
  /// logarithm and Student's t of the residual degrees of freedom.
  RatioBand ratio(double speed, double confidence) const;
  RmsBand error(bool after, double speed, double confidence) const;
  /// Rms in still air, sqrt(a).
  double still_air_rms(bool after) const;

  double exponent() const { return exponent_; }
  double gust_exponent() const { return gust_exponent_; }
  double dispersion() const { return dispersion_; }
  double residual_freedom() const { return residual_freedom_; }

 private:
  struct Line {
    double still = 0.0, wind = 0.0;  // a, b
  };
  static constexpr int parameters = 6;  // a, b before, a, b after, p, theta
  using Gradient = std::array<double, parameters>;

  double forcing(const ErrorInWind& record, double exponent, double gust_exponent) const;
  Line fitted_line(bool after, double exponent, double gust_exponent) const;
  double deviance(double exponent, double gust_exponent) const;
  void minimise();
  void estimate_dispersion();
  Gradient log_gradient(bool after, double speed) const;
  double standard_error(const Gradient& gradient) const;

  std::vector<ErrorInWind> records_;
  std::vector<double> weight_;
  double reference_;
  double scale_;  // variances are divided by it
  std::array<Line, 2> line_{};
  double exponent_ = usual_wind_exponent, gust_exponent_ = usual_gust_exponent;
  double dispersion_;
  double residual_freedom_ = 0.0;
  std::vector<double> covariance_;  // parameters x parameters
};

}  // namespace boresight::design
