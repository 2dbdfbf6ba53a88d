#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace boresight::plant {

/// What a transducer and the converter behind it make of a quantity, all in that quantity's unit:
/// gain error, zero error, white noise, range, steps. Lags belong to the plant.
struct Sensor {
  double gain = 1.0;
  double zero = 0.0;
  double noise = 0.0;       // rms of a sample
  double resolution = 0.0;  // step of the converter; 0: none
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// The reading of a value: gain value + zero + noise normal, held within the range, then rounded to
/// the nearest step (halves to even); `normal` a standard normal number.
double reading(const Sensor& sensor, double value, double normal);

/// Readings of a signal sampled evenly, noise of sample i the number i of `stream` of the seed.
struct Readings {
  Eigen::VectorXd values;
  Eigen::Index at_limit = 0;         // samples held at either end of the range
  Eigen::Index first_at_limit = -1;  // the first of them; -1: none
};

/// @throws InvalidInput for a gain of 0, a negative noise or resolution, a range without extent, or
/// parameters that are not finite (the range's ends may be infinite).
Readings readings(const Sensor& sensor, const Eigen::Ref<const Eigen::VectorXd>& signal,
                  std::uint64_t seed, std::uint64_t stream);

/// As readings; throws alike.
void validate(const Sensor& sensor);

}  // namespace boresight::plant
