#pragma once

#include <vector>

namespace boresight::design {

/// A quantity over the plant ensemble.
struct PlantBand {
  double nominal = 0.0;  // on the problem's own
  double minimum = 0.0, largest = 0.0;
  /// Prediction interval for one more plant at the requested confidence: Student's, from the
  /// plants' mean and scatter under a normal distribution, of the logarithms where all are
  /// positive. It contains the plants' own least and largest. Of plant_band it does not go below 0.
  double lower = 0.0, upper = 0.0;
};

/// The band of a quantity's values over the plants; NaN if a value is not finite.
/// @throws InvalidInput for fewer than 3 values or a confidence outside (0, 1).
PlantBand plant_band(double nominal, const std::vector<double>& values, double confidence);

/// The same of a quantity of either sign, such as a phase: a normal distribution of the values.
PlantBand signed_plant_band(double nominal, const std::vector<double>& values, double confidence);

}  // namespace boresight::design
