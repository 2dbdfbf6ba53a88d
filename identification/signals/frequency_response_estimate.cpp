#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/signals/frequency_response_estimate.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double infinity = std::numeric_limits<double>::infinity();

void check(const SpectralMatrix& spectra, std::initializer_list<Index> channels,
           const char* function) {
  const Index count = spectra.density.empty() ? 0 : spectra.density.front().rows();
  for (const Index channel : channels) {
    if (channel < 0 || channel >= count) {
      throw InvalidInput(
          fmt::format("{}: expected channels below {}, found {}", function, count, channel));
    }
  }
}

FrequencyResponseEstimate empty_estimate(const SpectralMatrix& spectra) {
  FrequencyResponseEstimate estimate;
  estimate.frequency = spectra.frequency;
  estimate.response.resize(spectra.frequency.size());
  estimate.coherence.resize(spectra.frequency.size());
  estimate.relative_uncertainty.resize(spectra.frequency.size());
  return estimate;
}

Complex quotient(Complex above, Complex below) {
  return below != 0.0 ? above / below : Complex(0.0);
}

// The larger root of the total least squares of y on x, noise powers in the given ratio.
Complex total_least_squares(double xx, double yy, Complex xy, double ratio) {
  const double excess = yy - ratio * xx;
  const double root = std::hypot(excess, 2.0 * std::sqrt(ratio) * std::abs(xy));
  // Of the two equal forms the one that does not cancel.
  return excess >= 0.0 ? quotient(excess + root, 2.0 * std::conj(xy))
                       : quotient(2.0 * ratio * xy, root - excess);
}

}  // namespace

FrequencyResponseEstimate frequency_response_estimate(const SpectralMatrix& spectra, Index input,
                                                      Index output, ResponseEstimator estimator,
                                                      double noise_ratio) {
  check(spectra, {input, output}, "frequency_response_estimate");
  if (!(noise_ratio > 0.0) || !std::isfinite(noise_ratio)) {
    throw InvalidInput(fmt::format(
        "frequency_response_estimate: expected a positive ratio of noise powers, found {}",
        noise_ratio));
  }
  auto estimate = empty_estimate(spectra);
  estimate.coherence = spectra.coherence(input, output);
  for (Index k = 0; k < estimate.frequency.size(); ++k) {
    const auto& at = spectra.density[static_cast<std::size_t>(k)];
    const double xx = at(input, input).real(), yy = at(output, output).real();
    const Complex xy = at(input, output);
    switch (estimator) {
      case ResponseEstimator::h1:
        estimate.response(k) = quotient(xy, xx);
        break;
      case ResponseEstimator::h2:
        estimate.response(k) = quotient(yy, std::conj(xy));
        break;
      case ResponseEstimator::hv:
        estimate.response(k) = total_least_squares(xx, yy, xy, noise_ratio);
        break;
    }
    const double coherence = estimate.coherence(k);
    estimate.relative_uncertainty(k) =
        spectra.segments > 1 && coherence > 0.0
            ? std::sqrt((1.0 - coherence) / (2.0 * coherence * spectra.effective_averages))
            : infinity;
  }
  return estimate;
}

FrequencyResponseEstimate referenced_response_estimate(const SpectralMatrix& spectra,
                                                       Index reference, Index input, Index output) {
  check(spectra, {reference, input, output}, "referenced_response_estimate");
  auto estimate = empty_estimate(spectra);
  estimate.coherence =
      spectra.coherence(reference, input).cwiseMin(spectra.coherence(reference, output));
  for (Index k = 0; k < estimate.frequency.size(); ++k) {
    const auto& at = spectra.density[static_cast<std::size_t>(k)];
    const Complex h = quotient(at(reference, output), at(reference, input));
    estimate.response(k) = h;
    // Power of y - h x, and what of it the reference's average lets through.
    const double rest = at(output, output).real() + std::norm(h) * at(input, input).real() -
                        2.0 * (h * at(output, input)).real();
    const double seen = std::norm(at(reference, input)) * std::norm(h);
    estimate.relative_uncertainty(k) =
        spectra.segments > 1 && seen > 0.0
            ? std::sqrt(std::max(rest, 0.0) * at(reference, reference).real() /
                        (2.0 * seen * spectra.effective_averages))
            : infinity;
  }
  return estimate;
}

}  // namespace boresight::identification
