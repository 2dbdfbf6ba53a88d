#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/commissioning/plant_band.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::design {
namespace {

PlantBand band_of(double nominal, const std::vector<double>& values, double confidence,
                  bool logarithmic) {
  const auto [minimum, largest] = std::ranges::minmax(values);
  const auto count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) mean += (logarithmic ? std::log(value) : value) / count;
  double square = 0.0;
  for (const double value : values) {
    square += std::pow((logarithmic ? std::log(value) : value) - mean, 2);
  }
  const double reach = numerics::student_quantile(0.5 + 0.5 * confidence, count - 1.0) *
                       std::sqrt(square / (count - 1.0) * (1.0 + 1.0 / count));
  double lower = mean - reach;
  double upper = mean + reach;
  if (logarithmic) {
    lower = std::exp(lower);
    upper = std::exp(upper);
  }
  return {nominal, minimum, largest, std::min(lower, minimum), std::max(upper, largest)};
}

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

void check(const std::vector<double>& values, double confidence) {
  const bool within = confidence > 0.0 && confidence < 1.0;
  if (values.size() < 3 || !within) {
    throw InvalidInput(
        fmt::format("plant_band: expected at least 3 values and a confidence within "
                    "(0, 1), found {} and {}",
                    values.size(), confidence));
  }
}

PlantBand unknown_band(double nominal) {
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  return {nominal, no_number, no_number, no_number, no_number};
}

}  // namespace

PlantBand plant_band(double nominal, const std::vector<double>& values, double confidence) {
  check(values, confidence);
  if (!all_finite(values)) return unknown_band(nominal);
  PlantBand band = band_of(nominal, values, confidence, std::ranges::min(values) > 0.0);
  band.lower = std::clamp(band.lower, 0.0, std::max(band.minimum, 0.0));
  return band;
}

PlantBand signed_plant_band(double nominal, const std::vector<double>& values, double confidence) {
  check(values, confidence);
  return all_finite(values) ? band_of(nominal, values, confidence, false) : unknown_band(nominal);
}

}  // namespace boresight::design
