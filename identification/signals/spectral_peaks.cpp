#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/signals/spectral_peaks.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double background(const VectorXd& power, Index at, Index bins) {
  const Index from = std::max<Index>(at - bins, 0);
  const Index to = std::min<Index>(at + bins, power.size() - 1);
  return numerics::median(VectorXd(power.segment(from, to - from + 1)));
}

// Offset (bins) of the maximum of a parabola through three ordinates, and its height.
struct Vertex {
  double offset, height;
};

Vertex vertex(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  if (!(curvature < 0.0)) return {0.0, at};
  const double offset = std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  return {offset, at - 0.25 * (before - after) * offset};
}

// Bins from the peak to where the power has fallen to half on one side; nothing where it rises
// again before.
std::optional<double> half_width(const VectorXd& power, Index peak, double height, int side) {
  double before = power(peak);
  for (Index k = peak + side; k > 0 && k + 1 < power.size(); k += side) {
    const double here = power(k);
    if (here <= 0.5 * height) {
      const double fraction = (before - 0.5 * height) / (before - here);
      return static_cast<double>(std::abs(k - peak)) - 1.0 + fraction;
    }
    if (here > before) return std::nullopt;
    before = here;
  }
  return std::nullopt;
}

}  // namespace

std::vector<SpectralPeak> spectral_peaks(const VectorXd& frequency, const VectorXd& power,
                                         const PeakOptions& options) {
  const Index bins = power.size();
  const double bin = bins > 1 && frequency.size() == bins
                         ? (frequency(bins - 1) - frequency(0)) / static_cast<double>(bins - 1)
                         : 0.0;
  if (bins < 5 || !(bin > 0.0) || !power.allFinite() || power.minCoeff() < 0.0) {
    throw InvalidInput(fmt::format(
        "spectral_peaks: expected at least 5 bins of rising frequency with a power that is finite "
        "and not negative, found {} frequencies and {} powers",
        frequency.size(), bins));
  }
  for (Index k = 0; k < bins; ++k) {
    if (std::abs(frequency(k) - frequency(0) - bin * static_cast<double>(k)) >
        1e-6 * bin * static_cast<double>(bins)) {
      throw InvalidInput(
          fmt::format("spectral_peaks: expected evenly spaced frequencies, found {} Hz at bin {}",
                      frequency(k), k));
    }
  }
  const double highest = options.highest > 0.0 ? options.highest : frequency(bins - 1);
  std::vector<SpectralPeak> peaks;
  for (Index k = 1; k + 1 < bins; ++k) {
    if (frequency(k) < options.lowest || frequency(k) > highest) continue;
    if (!(power(k) > power(k - 1)) || !(power(k) >= power(k + 1))) continue;
    const double about = background(power, k, options.background_bins);
    if (power(k) < options.min_over_background * about) continue;
    const double minimum = 1e-300;
    const Vertex top = vertex(std::log(std::max(power(k - 1), minimum)), std::log(power(k)),
                              std::log(std::max(power(k + 1), minimum)));
    SpectralPeak peak;
    peak.frequency = frequency(k) + top.offset * bin;
    peak.height = std::exp(top.height);
    peak.over_background = about > 0.0 ? peak.height / about : peak.height / minimum;
    const auto down = half_width(power, k, peak.height, -1);
    const auto up = half_width(power, k, peak.height, 1);
    if (down && up) peak.half_power_damping = 0.5 * (*down + *up) * bin / peak.frequency;
    peaks.push_back(peak);
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const SpectralPeak& a, const SpectralPeak& b) {
    return a.height > b.height;
  });
  return peaks;
}

void label_harmonics(std::vector<SpectralPeak>& peaks, double period, double tolerance) {
  if (!(period > 0.0) || !(tolerance > 0.0)) {
    throw InvalidInput(fmt::format(
        "label_harmonics: expected a positive period and tolerance, found {} s and {} Hz", period,
        tolerance));
  }
  for (auto& peak : peaks) {
    const double number = std::max(1.0, std::round(peak.frequency * period));
    peak.from_harmonic = peak.frequency - number / period;
    peak.harmonic = std::abs(peak.from_harmonic) <= tolerance ? static_cast<int>(number) : 0;
  }
}

std::optional<double> repetition_period(const VectorXd& signal, double sample_time,
                                        double min_correlation) {
  const Index samples = signal.size();
  if (samples < 16 || !signal.allFinite() || !(sample_time > 0.0)) {
    throw InvalidInput(fmt::format(
        "repetition_period: expected at least 16 finite samples and a positive sample time, found "
        "{} and {} s",
        samples, sample_time));
  }
  const VectorXd centred = signal.array() - signal.mean();
  if (!(centred.squaredNorm() > 0.0)) return std::nullopt;
  const Index padded = numerics::fast_transform_length(2 * samples);
  VectorXd longer = VectorXd::Zero(padded);
  longer.head(samples) = centred;
  Eigen::VectorXcd power =
      numerics::fourier_transform(longer).cwiseAbs2().cast<std::complex<double>>();
  const VectorXd product = numerics::inverse_fourier_transform(power, padded);
  // Correlation coefficient of the two overlapping parts.
  VectorXd square(samples + 1);
  square(0) = 0.0;
  for (Index i = 0; i < samples; ++i) square(i + 1) = square(i) + centred(i) * centred(i);
  const Index longest = samples * 2 / 3;
  VectorXd correlation(longest);
  for (Index lag = 0; lag < longest; ++lag) {
    const double head = square(samples - lag), tail = square(samples) - square(lag);
    correlation(lag) = head > 0.0 && tail > 0.0 ? product(lag) / std::sqrt(head * tail) : 0.0;
  }
  Index first = 1;
  while (first < longest && correlation(first) > 0.0) ++first;
  if (first + 2 >= longest) return std::nullopt;
  const double best = correlation.segment(first, longest - first).maxCoeff();
  if (best < min_correlation) return std::nullopt;
  // The first maximum as high as any: a signal that repeats after P does so after 2 P.
  Index at = 0;
  for (Index lag = first; lag + 1 < longest && at == 0; ++lag) {
    const Index from = std::max<Index>(first, lag * 3 / 4);
    const Index to = std::min<Index>(longest - 1, lag * 5 / 4 + 1);
    if (correlation(lag) >= std::max(min_correlation, best - 0.1) &&
        correlation(lag) >= correlation.segment(from, to - from + 1).maxCoeff()) {
      at = lag;
    }
  }
  if (at == 0) return std::nullopt;
  // Each repetition within the reach is a better ruler than the one before.
  double period = static_cast<double>(at);
  for (Index count = 1;; ++count) {
    const auto guess = static_cast<Index>(std::llround(period * static_cast<double>(count)));
    const Index reach = std::max<Index>(1, at / 20);
    if (guess + reach + 1 >= longest) break;
    Index top = 0;
    correlation.segment(guess - reach, 2 * reach + 1).maxCoeff(&top);
    const Index place = guess - reach + top;
    if (place < 1 || correlation(place) < 0.7 * min_correlation) break;
    const Vertex peak = vertex(correlation(place - 1), correlation(place), correlation(place + 1));
    period = (static_cast<double>(place) + peak.offset) / static_cast<double>(count);
  }
  return period * sample_time;
}

}  // namespace boresight::identification
