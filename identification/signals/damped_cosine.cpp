#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include <boresight/identification/signals/damped_cosine_projection.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace ring;

// All derivatives of the weighted model, free of the background: to the poles, then to each
// channel's amplitudes.
MatrixXd design(const Window& window, const Projection& at, const MatrixXd& background,
                const std::vector<RingPole>& poles, const VectorXd& weight) {
  const Index samples = window.signals.rows(), channels = window.signals.cols();
  const Index modal = at.modal.cols();
  Projection only_background{{background, {}}, at.modal, {}, at.coefficients};
  MatrixXd result = MatrixXd::Zero(samples * channels, modal * (1 + channels));
  result.leftCols(modal) = -jacobian(window, only_background, poles, weight);
  MatrixXd columns = at.modal - background * (background.transpose() * at.modal).eval();
  for (Index k = 1; k < modal; k += 2) columns.col(k) *= -1.0;  // to the imaginary part
  for (Index channel = 0; channel < channels; ++channel) {
    result.block(channel * samples, modal * (1 + channel), samples, modal) =
        weight(channel) * columns;
  }
  return result;
}

// Variance of each parameter's score over the white one: Newey and West's sum of the scores'
// correlations with Bartlett's weights, not below 1.
VectorXd score_inflation(const MatrixXd& slope, const MatrixXd& weighted_residual) {
  const Index samples = weighted_residual.rows(), channels = weighted_residual.cols();
  const Index lags = samples / 12;
  VectorXd inflation(slope.cols());
  for (Index k = 0; k < slope.cols(); ++k) {
    VectorXd score = VectorXd::Zero(samples);
    double white = 0.0;
    for (Index channel = 0; channel < channels; ++channel) {
      const VectorXd own = slope.col(k)
                               .segment(channel * samples, samples)
                               .cwiseProduct(weighted_residual.col(channel));
      score += own;
      white += slope.col(k).segment(channel * samples, samples).squaredNorm() *
               weighted_residual.col(channel).squaredNorm() / static_cast<double>(samples);
    }
    double total = score.squaredNorm();
    for (Index lag = 1; lag <= lags; ++lag) {
      const double fraction = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
      total += 2.0 * fraction * score.head(samples - lag).dot(score.tail(samples - lag));
    }
    inflation(k) = white > 0.0 ? std::sqrt(std::max(total / white, 1.0)) : 1.0;
  }
  return inflation;
}

RingMode mode_of(const RingPole& pole, const Eigen::Matrix2d& covariance,
                 const MatrixXd& coefficients) {
  RingMode mode;
  mode.pole = pole;
  const double w = two_pi * pole.damped_frequency, s = pole.decay_rate;
  const double natural = std::hypot(w, s);
  const double zeta = s / natural;
  // d log natural = (1 - zeta^2) d log w + zeta^2 d log s; d zeta = zeta (1 - zeta^2) (d log s -
  // d log w).
  const Eigen::Vector2d to_frequency(1.0 - zeta * zeta, zeta * zeta);
  const Eigen::Vector2d to_damping(-zeta * (1.0 - zeta * zeta), zeta * (1.0 - zeta * zeta));
  const auto spread = [&covariance](const Eigen::Vector2d& direction) {
    return std::sqrt(std::max(direction.dot(covariance * direction), 0.0));
  };
  mode.natural_frequency =
      numerics::normal_interval(natural / two_pi, natural / two_pi * spread(to_frequency));
  mode.damping_ratio = numerics::normal_interval(zeta, spread(to_damping));
  mode.damping_ratio.lower = std::max(mode.damping_ratio.lower, 0.0);
  mode.amplitude.resize(coefficients.cols());
  for (Index channel = 0; channel < coefficients.cols(); ++channel) {
    mode.amplitude(channel) = {coefficients(0, channel), -coefficients(1, channel)};
  }
  return mode;
}

}  // namespace

bool can_fit_rings(Index samples, double sample_time, std::size_t starts,
                   const RingFitOptions& options) {
  return starts > 0 && samples >= 4 * (background_columns(samples, sample_time, options).cols() +
                                       2 * static_cast<Index>(starts));
}

RingFit fit_damped_cosines(const MatrixXd& channels, double sample_time,
                           const std::vector<RingPole>& starts, const RingFitOptions& options) {
  const Window window = window_of(channels, sample_time, options);
  check(window, starts, "fit_damped_cosines");
  check(window, options.fixed_poles, "fit_damped_cosines");
  const MatrixXd slow = background_columns(channels.rows(), sample_time, options);
  const Index modal = 2 * static_cast<Index>(starts.size());
  const Index samples = channels.rows();
  if (starts.empty() || samples < 4 * (slow.cols() + modal)) {
    throw InvalidInput(
        fmt::format("fit_damped_cosines: expected at least one start and four samples a "
                    "coefficient, found {} starts and {} samples for {} coefficients; lower the "
                    "trend's degree or low_frequency_limit, or take a longer window",
                    starts.size(), samples, slow.cols() + modal));
  }
  Orthonormal background{MatrixXd(samples, 0), MatrixXd(0, 0)};
  append_columns(background, slow);

  // Weights by the rms of what a first fit leaves; exact data keep a weight by their size.
  const auto weights = [&](const MatrixXd& residual) {
    const VectorXd floor = 1e-12 * rms_of(channels).array() + 1e-300;
    return VectorXd(rms_of(residual).cwiseMax(floor).cwiseInverse());
  };
  const MatrixXd without = channels - background.q * (background.q.transpose() * channels).eval();
  Descent state = descend(window, background, starts, weights(without), options.max_iterations);
  if (channels.cols() > 1) {
    const int first_pass = state.iterations;
    state = descend(window, background, state.poles, weights(state.at.residual),
                    options.max_iterations);
    state.iterations += first_pass;
  }
  const VectorXd weight = weights(state.at.residual);
  const MatrixXd slope = design(window, state.at, background.q, state.poles, weight);
  const MatrixXd weighted_residual = state.at.residual * weight.asDiagonal();

  RingFit fit;
  fit.converged = state.converged;
  fit.iterations = state.iterations;
  fit.residual_rms = rms_of(state.at.residual);
  fit.oscillation = state.at.modal * state.at.coefficients;
  fit.residual = state.at.residual;
  const double unknowns = static_cast<double>(slow.cols() + modal) +
                          static_cast<double>(modal) / static_cast<double>(channels.cols());
  const double variance =
      weighted_residual.squaredNorm() /
      (static_cast<double>(channels.cols()) * (static_cast<double>(samples) - unknowns));
  // An amplitude or a decay that the window does not show gets a large variance, not a failure.
  MatrixXd normal = slope.transpose() * slope;
  normal.diagonal() *= 1.0 + 1e-12;
  auto of_poles = normal.diagonal().head(modal);
  of_poles.array() += 1e-14 * std::max(of_poles.maxCoeff(), 1e-300);
  const MatrixXd white =
      variance * numerics::positive_definite_solve(
                     normal, MatrixXd::Identity(normal.rows(), normal.cols()),
                     "fit_damped_cosines: normal matrix of poles and amplitudes");
  const VectorXd inflation = score_inflation(slope, weighted_residual);
  fit.covariance = inflation.asDiagonal() * white * inflation.asDiagonal();

  for (std::size_t k = 0; k < state.poles.size(); ++k) {
    const auto first = 2 * static_cast<Index>(k);
    fit.modes.push_back(mode_of(state.poles[k], fit.covariance.block<2, 2>(first, first),
                                state.at.coefficients.middleRows(first, 2)));
  }
  return fit;
}

std::vector<RingPole> ring_starts(const MatrixXd& channels, double sample_time, int count,
                                  double lowest, double highest, const RingFitOptions& options) {
  const Window window = window_of(channels, sample_time, options);
  check(window, options.fixed_poles, "ring_starts");
  if (!(lowest >= 0.0) || !(lowest < highest) || !(highest <= 0.5 / sample_time) || count < 1) {
    throw InvalidInput(
        fmt::format("ring_starts: expected a band within 0 .. {} Hz and at least one oscillation, "
                    "found {} .. {} Hz and {}",
                    0.5 / sample_time, lowest, highest, count));
  }
  const Index samples = channels.rows();
  const Index padded = numerics::fast_transform_length(4 * samples);
  const double bin = 1.0 / (static_cast<double>(padded) * sample_time);
  Orthonormal background{MatrixXd(samples, 0), MatrixXd(0, 0)};
  append_columns(background, background_columns(samples, sample_time, options));
  const VectorXd scale =
      rms_of(channels - background.q * (background.q.transpose() * channels).eval())
          .cwiseMax(1e-300)
          .cwiseInverse();
  const auto first = std::max<Index>(1, static_cast<Index>(std::ceil(lowest / bin)));
  const auto last = std::min(padded / 2 - 1, static_cast<Index>(std::floor(highest / bin)));
  std::vector<RingPole> poles;
  for (int found = 0; found < count; ++found) {
    const MatrixXd rest = project(window, background, poles).residual * scale.asDiagonal();
    RingPole best;
    double best_energy = 0.0;
    for (const double decays : {0.3, 1.5, 4.0, 10.0, 25.0, 60.0}) {
      const double decay_rate = decays / window.length();
      if (decay_rate > 2.0 * window.largest_damping * two_pi * highest) break;
      VectorXd energy = VectorXd::Zero(last - first + 3);
      double norm = 0.0;
      VectorXd weighted = VectorXd::Zero(padded);
      for (Index channel = 0; channel < channels.cols(); ++channel) {
        norm = 0.0;
        for (Index i = 0; i < samples; ++i) {
          const double w = std::exp(-decay_rate * static_cast<double>(i) * sample_time);
          weighted(i) = w * rest(i, channel);
          norm += w * w;
        }
        energy +=
            numerics::fourier_transform(weighted).segment(first - 1, last - first + 3).cwiseAbs2();
      }
      for (Index k = 1; k + 1 < energy.size(); ++k) {
        const bool peak = energy(k) > energy(k - 1) && energy(k) >= energy(k + 1);
        if (peak && energy(k) / norm > best_energy) {
          best_energy = energy(k) / norm;
          best = {static_cast<double>(first - 1 + k) * bin, decay_rate};
        }
      }
    }
    if (best_energy == 0.0) break;
    poles.push_back(best);
    poles = descend(window, background, poles, scale, 12).poles;
  }
  return poles;
}

}  // namespace boresight::identification
