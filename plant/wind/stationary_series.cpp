#include <bit>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/wind/stationary_series.hpp>

namespace boresight::plant {
namespace {

constexpr double max_samples = 67108864.0;  // 2^26
constexpr int deepest = 16;                 // a jump of the spectrum is placed to 2^-16 of a cell
constexpr double cell_tolerance = 1e-4;
constexpr Eigen::Index values_per_cell = 64;
constexpr Eigen::Index spare_values = 100000;  // for few cells with many jumps

Eigen::Index sample_count(double duration, double sample_time) {
  if (!(sample_time > 0.0) || !std::isfinite(sample_time)) {
    throw InvalidInput(
        fmt::format("StationarySeries: expected a sample_time above 0, found {} s", sample_time));
  }
  const double samples = std::round(duration / sample_time);
  if (!(samples >= 2.0) || !(samples <= max_samples)) {
    throw InvalidInput(
        fmt::format("StationarySeries: expected a duration of 2 to 2^26 samples of {} s, found "
                    "{} s",
                    sample_time, duration));
  }
  return static_cast<Eigen::Index>(samples);
}

Eigen::Index transform_length(Eigen::Index samples, const StationarySeriesOptions& options) {
  if (!options.periodic) {
    return static_cast<Eigen::Index>(std::bit_ceil(2U * static_cast<std::uint64_t>(samples)));
  }
  Eigen::Index rest = samples;
  for (const Eigen::Index prime : {2, 3, 5}) {
    while (rest % prime == 0) rest /= prime;
  }
  if (rest == 1) return samples;
  throw InvalidInput(
      fmt::format("StationarySeries: expected a periodic series of samples with the prime factors "
                  "2, 3 and 5 only, such as {}, found {}",
                  numerics::fast_transform_length(samples), samples));
}

// Integrals of a spectrum over cells by adaptive Simpson quadrature.
class CellIntegral {
 public:
  CellIntegral(const Spectrum& spectrum, Eigen::Index max_values)
      : spectrum_(spectrum), max_values_(max_values) {}

  double at(double frequency) {
    if (++values_ > max_values_) {
      throw NumericalFailure(fmt::format(
          "StationarySeries: the spectrum varies too fast near {} Hz to be integrated between "
          "the lines: smooth it or lengthen the series",
          frequency));
    }
    const double value = spectrum_(frequency);
    if (value >= 0.0 && std::isfinite(value)) return value;
    throw InvalidInput(
        fmt::format("StationarySeries: expected a finite spectrum of at least 0, found {} at {} Hz",
                    value, frequency));
  }

  // Mean over low..high; the values at the ends and the middle are known.
  double mean(double low, double high, double at_low, double at_middle, double at_high,
              int depth = 0) {
    const double simpson = (at_low + 4.0 * at_middle + at_high) / 6.0;
    // Simpson's rule is far better than the difference of its parts, but a jump it may miss.
    if (depth >= deepest || std::abs(simpson - at_middle) <= 1e-3 * at_middle) return simpson;
    const double middle = 0.5 * (low + high);
    const double at_left = at(0.5 * (low + middle));
    const double at_right = at(0.5 * (middle + high));
    const double left = (at_low + 4.0 * at_left + at_middle) / 6.0;
    const double right = (at_middle + 4.0 * at_right + at_high) / 6.0;
    const double refined = 0.5 * (left + right);
    if (std::abs(refined - simpson) <= cell_tolerance * refined) return refined;
    return 0.5 * (mean(low, middle, at_low, at_left, at_middle, depth + 1) +
                  mean(middle, high, at_middle, at_right, at_high, depth + 1));
  }

 private:
  const Spectrum& spectrum_;
  Eigen::Index max_values_;
  Eigen::Index values_ = 0;
};

}  // namespace

StationarySeries::StationarySeries(const Spectrum& spectrum, double duration, double sample_time,
                                   const StationarySeriesOptions& options)
    : samples_(sample_count(duration, sample_time)),
      transform_samples_(transform_length(samples_, options)),
      sample_time_(sample_time),
      line_powers_(transform_samples_ / 2) {
  if (!spectrum) throw InvalidInput("StationarySeries: expected a spectrum, found none");
  const double step = frequency_step();
  CellIntegral cells(spectrum, values_per_cell * line_powers_.size() + spare_values);
  double at_low = cells.at(0.5 * step);
  for (Eigen::Index k = 1; k <= line_powers_.size(); ++k) {
    // The last cell of an even number of samples ends at its middle, fs/2.
    const bool half = 2 * k == transform_samples_;
    const auto low = (static_cast<double>(k) - 0.5) * step;
    const double width = half ? 0.5 * step : step;
    const double at_high = cells.at(low + width);
    const double at_middle = cells.at(low + 0.5 * width);
    line_powers_[k - 1] = width * cells.mean(low, low + width, at_low, at_middle, at_high);
    at_low = at_high;
  }
}

double StationarySeries::frequency_step() const {
  return 1.0 / (static_cast<double>(transform_samples_) * sample_time_);
}

Eigen::VectorXd StationarySeries::draw(std::uint64_t seed, std::uint64_t stream) const {
  const numerics::NormalNumbers normal(seed, stream);
  const auto samples = static_cast<double>(transform_samples_);
  Eigen::VectorXcd half(transform_samples_ / 2 + 1);
  half[0] = 0.0;
  for (Eigen::Index k = 1; k < half.size(); ++k) {
    const std::complex<double> number = normal.pair(static_cast<std::uint64_t>(k));
    const double deviation = samples * std::sqrt(line_powers_[k - 1]);
    // 2 Re(c exp(i phase)) has the variance 2 |c|^2 and c that of two numbers; fs/2 stands alone.
    half[k] = 2 * k == transform_samples_ ? std::complex<double>(deviation * number.real())
                                          : 0.5 * deviation * number;
  }
  return numerics::inverse_fourier_transform(half, transform_samples_).head(samples_);
}

Eigen::VectorXd synthesise(const Spectrum& spectrum, double duration, double sample_time,
                           std::uint64_t seed, const StationarySeriesOptions& options) {
  return StationarySeries(spectrum, duration, sample_time, options).draw(seed);
}

}  // namespace boresight::plant
