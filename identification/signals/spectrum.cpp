#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Index default_segment(Index samples) {
  if (samples < 384) return samples;
  Index length = 64;
  while (2 * length <= samples / 6) length *= 2;
  return length;
}

// 1/(1/K + 2/K^2 sum (K - j) rho_j): rho_j the squared correlation of windows j steps apart.
double effective_number(const VectorXd& window, Index step, Index segments) {
  const auto count = static_cast<double>(segments);
  const double power = window.squaredNorm();
  double sum = 1.0;
  for (Index j = 1; j * step < window.size() && j < segments; ++j) {
    const Index shared = window.size() - j * step;
    const double correlation = window.head(shared).dot(window.tail(shared)) / power;
    sum += 2.0 * (count - static_cast<double>(j)) / count * correlation * correlation;
  }
  return count / sum;
}

}  // namespace

void remove_trend(VectorXd& values, Detrend detrend) {
  if (detrend == Detrend::none) return;
  values.array() -= values.mean();
  if (detrend == Detrend::mean) return;
  const auto last = static_cast<double>(values.size() - 1);
  const VectorXd ramp = VectorXd::LinSpaced(values.size(), -0.5 * last, 0.5 * last);
  values -= (ramp.dot(values) / ramp.squaredNorm()) * ramp;
}

VectorXd window_samples(SpectralWindow window, Index samples) {
  VectorXd result(samples);
  for (Index i = 0; i < samples; ++i) {
    const double x = two_pi * static_cast<double>(i) / static_cast<double>(samples);
    switch (window) {
      case SpectralWindow::rectangular:
        result(i) = 1.0;
        break;
      case SpectralWindow::hann:
        result(i) = 0.5 - 0.5 * std::cos(x);
        break;
      case SpectralWindow::flat_top:  // ISO 18431-2
        result(i) = (1.0 - 1.933 * std::cos(x) + 1.286 * std::cos(2.0 * x) -
                     0.388 * std::cos(3.0 * x) + 0.0322 * std::cos(4.0 * x)) /
                    4.6392;
        break;
    }
  }
  return result;
}

VectorXd SpectralMatrix::auto_density(Index channel) const {
  VectorXd result(frequency.size());
  for (Index k = 0; k < frequency.size(); ++k) {
    result(k) = density[static_cast<std::size_t>(k)](channel, channel).real();
  }
  return result;
}

Eigen::VectorXcd SpectralMatrix::cross_density(Index from, Index to) const {
  Eigen::VectorXcd result(frequency.size());
  for (Index k = 0; k < frequency.size(); ++k) {
    result(k) = density[static_cast<std::size_t>(k)](from, to);
  }
  return result;
}

VectorXd SpectralMatrix::coherence(Index from, Index to) const {
  VectorXd result(frequency.size());
  for (Index k = 0; k < frequency.size(); ++k) {
    const auto& at = density[static_cast<std::size_t>(k)];
    const double powers = at(from, from).real() * at(to, to).real();
    result(k) = powers > 0.0 ? std::min(std::norm(at(from, to)) / powers, 1.0) : 0.0;
  }
  return result;
}

SpectralMatrix spectral_matrix(const Eigen::MatrixXd& channels, double sample_time,
                               const SpectrumOptions& options, const std::vector<bool>& valid) {
  const Index samples = channels.rows();
  if (channels.cols() == 0 || samples == 0 || !channels.allFinite() || !(sample_time > 0.0)) {
    throw InvalidInput(fmt::format(
        "spectral_matrix: expected finite samples of at least one channel and a positive sample "
        "time, found {} samples of {} channels, {} s",
        samples, channels.cols(), sample_time));
  }
  if (!valid.empty() && static_cast<Index>(valid.size()) != samples) {
    throw InvalidInput(fmt::format(
        "spectral_matrix: expected a mask of {} samples or none, found {}", samples, valid.size()));
  }
  const Index length =
      options.segment_length > 0 ? options.segment_length : default_segment(samples);
  if (length < 8 || length > samples || !(options.overlap >= 0.0) || !(options.overlap <= 0.9)) {
    throw InvalidInput(fmt::format(
        "spectral_matrix: expected a segment of 8 .. {} samples and an overlap of 0 .. 0.9, found "
        "{} and {}",
        samples, length, options.overlap));
  }
  const auto step =
      std::max<Index>(1, std::llround(static_cast<double>(length) * (1.0 - options.overlap)));
  const VectorXd window = window_samples(options.window, length);
  const Index bins = length / 2 + 1;

  SpectralMatrix result;
  result.sample_time = sample_time;
  const double rate = 1.0 / sample_time;
  result.frequency = VectorXd::LinSpaced(
      bins, 0.0, rate * static_cast<double>(bins - 1) / static_cast<double>(length));
  result.noise_bandwidth = rate * window.squaredNorm() / std::pow(window.sum(), 2);
  result.density.assign(static_cast<std::size_t>(bins),
                        Eigen::MatrixXcd::Zero(channels.cols(), channels.cols()));
  Eigen::MatrixXcd transforms(bins, channels.cols());
  for (Index first = 0; first + length <= samples; first += step) {
    const auto from = valid.begin() + (valid.empty() ? 0 : first);
    if (!valid.empty() && std::find(from, from + length, false) != from + length) {
      ++result.left_out;
      continue;
    }
    ++result.segments;
    for (Index channel = 0; channel < channels.cols(); ++channel) {
      VectorXd segment = channels.col(channel).segment(first, length);
      remove_trend(segment, options.detrend);
      transforms.col(channel) = numerics::fourier_transform(segment.cwiseProduct(window));
    }
    for (Index k = 0; k < bins; ++k) {
      result.density[static_cast<std::size_t>(k)] +=
          transforms.row(k).adjoint() * transforms.row(k);
    }
  }
  if (result.segments == 0) {
    throw NumericalFailure(fmt::format(
        "spectral_matrix: all {} segments of {} samples hold invalid ones; take shorter segments",
        result.left_out, length));
  }
  result.effective_averages = effective_number(window, step, result.segments);
  const double scale =
      2.0 * sample_time / (window.squaredNorm() * static_cast<double>(result.segments));
  for (Index k = 0; k < bins; ++k) {
    const bool single = k == 0 || 2 * k == length;
    result.density[static_cast<std::size_t>(k)] *= single ? 0.5 * scale : scale;
  }
  return result;
}

}  // namespace boresight::identification
