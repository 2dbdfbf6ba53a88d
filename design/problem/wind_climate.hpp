#pragma once

#include <variant>
#include <vector>

namespace boresight::design {

/// A mean wind speed and the fraction of the time it represents.
struct WeightedSpeed {
  double speed = 0.0;  // m/s
  double weight = 0.0;
};

/// Probability that the mean speed exceeds v: exp(-(v/scale)^shape), the Weibull distribution of
/// winds (A. Burton et al., Wind Energy Handbook, section 2.4; shape 2 is the Rayleigh
/// distribution). It applies while the antenna tracks, which is up to `highest` m/s only.
struct WeibullClimate {
  double scale = 0.0;    // m/s, above 0
  double shape = 2.0;    // 0.5 to 10
  double highest = 0.0;  // m/s, above 0; the distribution is conditional on lower speeds
};

/// Speeds and weights (sum 1) whose weighted sums are expectations over the climate. Composite
/// Gauss-Legendre quadrature, accurate to 1e-6 for quantities that grow like powers 1 to 6 of the
/// speed, such as rms^2, wind torque spectra and pointing losses. Speeds with a weight below 1e-12
/// are omitted.
/// @throws InvalidInput outside the ranges above.
std::vector<WeightedSpeed> climate_speeds(const WeibullClimate& climate);

/// The given speeds with their weights scaled to the sum 1; speeds of weight 0 are omitted. @throws
/// InvalidInput for an empty table, a speed not above 0, a negative weight, or no positive weight.
std::vector<WeightedSpeed> climate_speeds(const std::vector<WeightedSpeed>& table);

/// The distribution with a mean speed (m/s): scale = mean/Gamma(1 + 1/shape). `highest` as above.
WeibullClimate weibull_climate(double mean, double shape, double highest);

/// Range of shapes searched. Winds of a site usually have shapes of 1 to 3.
constexpr double lowest_shape_sought = 0.8;
constexpr double highest_shape_sought = 10.0;

/// Shapes of the Weibull distributions with a given mean and one exceedance.
struct WeibullShapes {
  std::vector<double> shapes;  // ascending
  /// Smallest and largest fraction of all winds above that speed, over all shapes searched.
  double min_fraction = 0.0;
  double max_fraction = 0.0;
};

/// Shapes with which the fraction `fraction` (above 0, at most 1) of all winds lies above `ratio`
/// times their mean (0.001 to 1000):
///   exp(-(ratio Gamma(1 + 1/shape))^shape) = fraction.
/// The fraction falls with the shape above 1.81 times the mean and rises with it up to the mean.
/// Between the two it has a maximum, so there may be two shapes. Shapes within 0.001 of one another
/// count as one.
/// @throws InvalidInput outside those ranges.
WeibullShapes weibull_shapes(double ratio, double fraction);

/// A part of a site's climate: one mean speed (m/s, above 0) or a Weibull distribution, and its
/// fraction of the time. The fractions need not sum to 1.
struct ClimatePart {
  std::variant<double, WeibullClimate> winds;
  double weight = 1.0;  // above 0
};

/// Fraction of the climate's time (0 to 1) in which the mean speed is at most `speed` (m/s;
/// infinite: all of the time). For a Weibull distribution
///   (1 - exp(-(v/scale)^shape))/(1 - exp(-(highest/scale)^shape)),
/// computed exactly and not from the speeds of climate_speeds. A single speed counts from itself
/// on.
/// @throws InvalidInput for an empty climate, or no positive weight.
double fraction_of_time(const std::vector<ClimatePart>& climate, double speed);

/// The highest mean speed (m/s) in the climate; 0 for an empty climate.
double highest_speed(const std::vector<ClimatePart>& climate);

}  // namespace boresight::design
