#include <algorithm>
#include <complex>
#include <limits>

#include <fmt/format.h>
#include <unsupported/Eigen/FFT>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::numerics {
namespace {

constexpr Eigen::Index max_samples = Eigen::Index{1} << 28;
constexpr Eigen::Index max_work = Eigen::Index{1} << 32;

Eigen::Index largest_prime_factor(Eigen::Index number) {
  Eigen::Index largest = 1;
  for (Eigen::Index factor = 2; factor * factor <= number; ++factor) {
    while (number % factor == 0) {
      largest = factor;
      number /= factor;
    }
  }
  return std::max(largest, number);
}

void check_length(const char* function, Eigen::Index samples) {
  if (samples < 1 || samples > max_samples) {
    throw InvalidInput(
        fmt::format("{}: expected 1 to {} samples, found {}", function, max_samples, samples));
  }
  const Eigen::Index prime = largest_prime_factor(samples);
  if (prime * samples <= max_work) return;
  throw InvalidInput(
      fmt::format("{}: {} samples have the prime factor {}, with which the transform is slow: "
                  "expected small factors only, such as {} samples have",
                  function, samples, prime, fast_transform_length(samples)));
}

Eigen::FFT<double> half_spectrum_transform() {
  return Eigen::FFT<double>(Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum);
}

}  // namespace

Eigen::VectorXcd fourier_transform(const Eigen::Ref<const Eigen::VectorXd>& series) {
  check_length("fourier_transform", series.size());
  if (!series.allFinite()) {
    throw InvalidInput("fourier_transform: expected finite samples, found one that is not");
  }
  const Eigen::Index samples = series.size();
  if (samples == 1) return series.cast<std::complex<double>>();  // which Eigen's does not know
  Eigen::VectorXcd half(samples / 2 + 1);
  auto transform = half_spectrum_transform();
  transform.fwd(half.data(), series.data(), samples);
  half[0] = half[0].real();
  if (samples % 2 == 0) half[samples / 2] = half[samples / 2].real();
  return half;
}

Eigen::VectorXd inverse_fourier_transform(const Eigen::Ref<const Eigen::VectorXcd>& half,
                                          Eigen::Index samples) {
  check_length("inverse_fourier_transform", samples);
  if (half.size() != samples / 2 + 1) {
    throw InvalidInput(
        fmt::format("inverse_fourier_transform: expected {} elements for {} samples, found {}",
                    samples / 2 + 1, samples, half.size()));
  }
  if (!half.allFinite()) {
    throw InvalidInput(
        "inverse_fourier_transform: expected finite elements, found one that is not");
  }
  if (half[0].imag() != 0.0 || (samples % 2 == 0 && half[samples / 2].imag() != 0.0)) {
    throw InvalidInput(
        "inverse_fourier_transform: expected real first and middle elements, found complex ones");
  }
  if (samples == 1) return half.real();
  Eigen::VectorXd series(samples);
  auto transform = half_spectrum_transform();
  transform.inv(series.data(), half.data(), samples);
  return series;
}

Eigen::Index fast_transform_length(Eigen::Index samples) {
  if (samples < 1 || samples > max_samples) {
    throw InvalidInput(fmt::format("fast_transform_length: expected 1 to {} samples, found {}",
                                   max_samples, samples));
  }
  if (samples == 1) return 1;
  Eigen::Index best = std::numeric_limits<Eigen::Index>::max();
  for (Eigen::Index five = 2; five < 2 * samples; five *= 5) {
    for (Eigen::Index three = five; three < 2 * samples; three *= 3) {
      Eigen::Index length = three;
      while (length < samples) length *= 2;
      best = std::min(best, length);
    }
  }
  return best;
}

}  // namespace boresight::numerics
