#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/nonlinear/sensor.hpp>

namespace boresight::plant {

void validate(const Sensor& sensor) {
  const auto require = [](bool satisfied, const char* expected, double found) {
    if (satisfied) return;
    throw InvalidInput(fmt::format("sensor: expected {}, found {}", expected, found));
  };
  require(std::isfinite(sensor.gain) && sensor.gain != 0.0, "a gain that is not 0", sensor.gain);
  require(std::isfinite(sensor.zero), "a finite zero error", sensor.zero);
  require(std::isfinite(sensor.noise) && sensor.noise >= 0.0, "a noise of at least 0",
          sensor.noise);
  require(std::isfinite(sensor.resolution) && sensor.resolution >= 0.0,
          "a resolution of at least 0", sensor.resolution);
  require(sensor.lowest < sensor.highest, "a range whose lower end is below its upper end",
          sensor.lowest);
}

double reading(const Sensor& sensor, double value, double normal) {
  const double analog = sensor.gain * value + sensor.zero + sensor.noise * normal;
  const double held = std::clamp(analog, sensor.lowest, sensor.highest);
  if (sensor.resolution == 0.0) return held;
  return std::nearbyint(held / sensor.resolution) * sensor.resolution;
}

Readings readings(const Sensor& sensor, const Eigen::Ref<const Eigen::VectorXd>& signal,
                  std::uint64_t seed, std::uint64_t stream) {
  validate(sensor);
  const numerics::NormalNumbers numbers(seed, stream);
  Readings result{Eigen::VectorXd(signal.size()), 0, -1};
  std::complex<double> pair;
  for (Eigen::Index i = 0; i < signal.size(); ++i) {
    if (i % 2 == 0) pair = numbers.pair(static_cast<std::uint64_t>(i / 2));
    const double normal = i % 2 == 0 ? pair.real() : pair.imag();
    const double analog = sensor.gain * signal[i] + sensor.zero + sensor.noise * normal;
    if (analog < sensor.lowest || analog > sensor.highest) {
      if (result.at_limit == 0) result.first_at_limit = i;
      ++result.at_limit;
    }
    result.values[i] = reading(sensor, signal[i], normal);
  }
  return result;
}

}  // namespace boresight::plant
