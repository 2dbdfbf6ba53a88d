#pragma once

#include <variant>
#include <vector>

namespace boresight::design {

/// A mean wind speed and the share of the time it stands for.
struct WeightedSpeed {
  double speed = 0.0;  // m/s
  double weight = 0.0;
};

/// How often the mean speed exceeds v: exp(-(v/scale)^shape), while the antenna tracks, which it
/// does up to `highest` m/s and no more (W. Weibull's law as used for winds: A. Burton et al., Wind
/// Energy Handbook, section 2.4; shape 2 is Rayleigh's).
struct WeibullClimate {
  double scale = 0.0;    // m/s, above 0
  double shape = 2.0;    // 0.5 to 10
  double highest = 0.0;  // m/s, above 0; the law is conditional on speeds below it
};

/// Speeds and weights (sum 1) whose weighted sums are expectations over the climate: composite
/// Gauss-Legendre quadrature, to 1e-6 for what grows like powers of the speed from 1 to 6, and so
/// for rms^2, wind torque spectra and pointing losses. Speeds whose weight is below 1e-12 are left
/// out. @throws InvalidInput outside the ranges above.
std::vector<WeightedSpeed> climate_speeds(const WeibullClimate& climate);

/// The given speeds with their weights scaled to the sum 1, those of weight 0 left out.
/// @throws InvalidInput for none, a speed that is not above 0, a negative or no positive weight.
std::vector<WeightedSpeed> climate_speeds(const std::vector<WeightedSpeed>& table);

/// The law of a mean speed (m/s): scale = mean/Gamma(1 + 1/shape). `highest` as above.
WeibullClimate weibull_climate(double mean, double shape, double highest);

/// The shapes looked for: of the winds of a site they are 1 to 3 as a rule.
constexpr double lowest_shape_sought = 0.8;
constexpr double highest_shape_sought = 10.0;

/// Shapes of the Weibull laws that have a mean and one exceedance.
struct WeibullShapes {
  std::vector<double> shapes;  // ascending
  /// Between what the share of all winds above that speed lies over all shapes looked for.
  double least_share = 0.0;
  double most_share = 0.0;
};

/// Shapes with which the share `share` (above 0, at most 1) of all winds lies above `ratio` times
/// their mean (0.001 to 1000):
///   exp(-(ratio Gamma(1 + 1/shape))^shape) = share.
/// The share falls with the shape above 1.81 times the mean and rises with it up to the mean;
/// between the two it has a maximum, so that there may be two shapes. Shapes within 0.001 of one
/// another count as one. @throws InvalidInput outside those ranges.
WeibullShapes weibull_shapes(double ratio, double share);

/// A part of a site's climate: one mean speed (m/s, above 0) or a Weibull law, and its share of the
/// time. Shares need not sum to 1.
struct ClimatePart {
  std::variant<double, WeibullClimate> winds;
  double weight = 1.0;  // above 0
};

/// Share of the climate's time (0 to 1) in which the mean speed is at most `speed` (m/s; infinite:
/// all of it). Of a Weibull law
///   (1 - exp(-(v/scale)^shape))/(1 - exp(-(highest/scale)^shape)),
/// exactly and not by the speeds of climate_speeds; a single speed counts from itself on.
/// @throws InvalidInput for no part, or no positive weight.
double share_of_time(const std::vector<ClimatePart>& climate, double speed);

/// The highest mean speed (m/s) that the climate knows; 0 without a part.
double highest_speed(const std::vector<ClimatePart>& climate);

}  // namespace boresight::design
