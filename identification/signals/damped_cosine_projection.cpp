#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include <boresight/identification/signals/damped_cosine_projection.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification::ring {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void write_pole(const RingPole& pole, double sample_time, MatrixXd& columns, Index first) {
  const std::complex<double> step = std::exp(
      std::complex<double>(-pole.decay_rate, two_pi * pole.damped_frequency) * sample_time);
  std::complex<double> value = 1.0;
  for (Index i = 0; i < columns.rows(); ++i) {
    columns(i, first) = value.real();
    columns(i, first + 1) = value.imag();
    value *= step;
  }
}

double cost_of(const MatrixXd& residual, const VectorXd& weight) {
  return (residual.colwise().squaredNorm().transpose().array() * weight.array().square()).sum();
}

std::vector<RingPole> moved(const std::vector<RingPole>& poles, const VectorXd& step,
                            const Window& window) {
  const double low = window.lowest;
  std::vector<RingPole> result = poles;
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const auto first = 2 * static_cast<Index>(k);
    auto& pole = result[k];
    pole.damped_frequency =
        std::clamp(pole.damped_frequency * std::exp(std::clamp(step(first), -0.2, 0.2)),
                   std::max(0.02 / window.length(), low), 0.4999 / window.sample_time);
    pole.decay_rate =
        std::clamp(pole.decay_rate * std::exp(std::clamp(step(first + 1), -1.5, 1.5)),
                   1e-3 / window.length(), window.largest_damping * two_pi * pole.damped_frequency);
  }
  return result;
}

}  // namespace

Window window_of(const MatrixXd& signals, double sample_time, const RingFitOptions& options) {
  const double zeta = std::clamp(options.largest_damping_ratio, 1e-4, 0.9999);
  return {signals, sample_time, options.low_frequency_limit, zeta / std::sqrt(1.0 - zeta * zeta)};
}

void check(const Window& window, const std::vector<RingPole>& poles, const char* function) {
  if (!(window.sample_time > 0.0) || !std::isfinite(window.sample_time)) {
    throw InvalidInput(fmt::format("{}: expected a positive sample time, found {} s", function,
                                   window.sample_time));
  }
  if (window.signals.cols() == 0 || !window.signals.allFinite()) {
    throw InvalidInput(fmt::format(
        "{}: expected at least one channel of finite samples, found {} channels{}", function,
        window.signals.cols(), window.signals.allFinite() ? "" : ", not all finite"));
  }
  for (const auto& pole : poles) {
    if (!(pole.damped_frequency > 0.0) || !(pole.damped_frequency < 0.5 / window.sample_time) ||
        !(pole.decay_rate >= 0.0) || !std::isfinite(pole.decay_rate)) {
      throw InvalidInput(fmt::format(
          "{}: expected poles between 0 and {} Hz that do not grow, found {} Hz, decay {} 1/s",
          function, 0.5 / window.sample_time, pole.damped_frequency, pole.decay_rate));
    }
  }
}

MatrixXd background_columns(Index samples, double sample_time, const RingFitOptions& options) {
  const double length = static_cast<double>(samples) * sample_time;
  const auto cosines = static_cast<Index>(std::floor(2.0 * length * options.low_frequency_limit));
  const Index polynomials = std::max(options.trend_degree + 1, 0);
  const auto fixed = static_cast<Index>(options.fixed_poles.size());
  MatrixXd columns(samples, polynomials + cosines + 2 * fixed);
  for (Index i = 0; i < samples; ++i) {
    const double x = (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(samples);
    double power = 1.0;
    for (Index k = 0; k < polynomials; ++k, power *= x - 1.0) columns(i, k) = power;
    for (Index k = 0; k < cosines; ++k) {
      columns(i, polynomials + k) =
          std::cos(0.5 * std::numbers::pi * static_cast<double>(k + 1) * x);
    }
  }
  for (Index k = 0; k < fixed; ++k) {
    write_pole(options.fixed_poles[static_cast<std::size_t>(k)], sample_time, columns,
               polynomials + cosines + 2 * k);
  }
  return columns;
}

void append_columns(Orthonormal& basis, const MatrixXd& columns) {
  const Index before = basis.q.cols();
  basis.q.conservativeResize(columns.rows(), before + columns.cols());
  basis.r.conservativeResize(before + columns.cols(), before + columns.cols());
  for (Index k = 0; k < columns.cols(); ++k) {
    VectorXd column = columns.col(k);
    const Index place = before + k;
    basis.r.row(place).setZero();
    basis.r.col(place).setZero();
    const double size = column.norm();
    for (int pass = 0; pass < 2; ++pass) {
      const VectorXd shadow = basis.q.leftCols(place).transpose() * column;
      column.noalias() -= basis.q.leftCols(place) * shadow;
      basis.r.col(place).head(place) += shadow;
    }
    const double rest = column.norm();
    if (rest > 1e-9 * size) {
      basis.q.col(place) = column / rest;
      basis.r(place, place) = rest;
    } else {
      basis.q.col(place).setZero();
      basis.r(place, place) = 1.0;
    }
  }
}

Projection project(const Window& window, const Orthonormal& background,
                   const std::vector<RingPole>& poles) {
  Projection at;
  at.modal.resize(window.signals.rows(), 2 * static_cast<Index>(poles.size()));
  for (std::size_t k = 0; k < poles.size(); ++k) {
    write_pole(poles[k], window.sample_time, at.modal, 2 * static_cast<Index>(k));
  }
  at.basis = background;
  append_columns(at.basis, at.modal);
  const MatrixXd shadow = at.basis.q.transpose() * window.signals;
  at.residual = window.signals - at.basis.q * shadow;
  const Index modal = at.modal.cols();
  at.coefficients = at.basis.r.bottomRightCorner(modal, modal)
                        .triangularView<Eigen::Upper>()
                        .solve(shadow.bottomRows(modal));
  return at;
}

MatrixXd jacobian(const Window& window, const Projection& at, const std::vector<RingPole>& poles,
                  const VectorXd& weight) {
  const Index samples = window.signals.rows(), channels = window.signals.cols();
  MatrixXd result(samples * channels, 2 * static_cast<Index>(poles.size()));
  MatrixXd change(samples, channels);
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const auto first = 2 * static_cast<Index>(k);
    for (Index parameter = 0; parameter < 2; ++parameter) {
      const double rate =
          parameter == 0 ? two_pi * poles[k].damped_frequency : -poles[k].decay_rate;
      for (Index channel = 0; channel < channels; ++channel) {
        const double a = at.coefficients(first, channel);
        const double b = at.coefficients(first + 1, channel);
        // d(a c + b s) to log w is w t (b c - a s), to log s it is -s t (a c + b s).
        const double on_cosine = parameter == 0 ? b : a;
        const double on_sine = parameter == 0 ? -a : b;
        for (Index i = 0; i < samples; ++i) {
          change(i, channel) = rate * static_cast<double>(i) * window.sample_time *
                               (on_cosine * at.modal(i, first) + on_sine * at.modal(i, first + 1));
        }
      }
      change -= at.basis.q * (at.basis.q.transpose() * change).eval();
      for (Index channel = 0; channel < channels; ++channel) {
        result.col(first + parameter).segment(channel * samples, samples) =
            -weight(channel) * change.col(channel);
      }
    }
  }
  return result;
}

VectorXd rms_of(const MatrixXd& residual) {
  return (residual.colwise().squaredNorm() / static_cast<double>(residual.rows()))
      .cwiseSqrt()
      .transpose();
}

Descent descend(const Window& window, const Orthonormal& background,
                const std::vector<RingPole>& poles, const VectorXd& weight, int max_iterations) {
  Descent state{moved(poles, VectorXd::Zero(2 * static_cast<Index>(poles.size())), window), {}};
  state.at = project(window, background, state.poles);
  double cost = cost_of(state.at.residual, weight);
  double damping = 1e-3;
  while (state.iterations < max_iterations && !state.converged) {
    ++state.iterations;
    const MatrixXd slope = jacobian(window, state.at, state.poles, weight);
    MatrixXd normal = slope.transpose() * slope;
    VectorXd residual(slope.rows());
    for (Index channel = 0; channel < weight.size(); ++channel) {
      residual.segment(channel * window.signals.rows(), window.signals.rows()) =
          weight(channel) * state.at.residual.col(channel);
    }
    const VectorXd gradient = slope.transpose() * residual;
    const double floor = 1e-14 * std::max(normal.diagonal().maxCoeff(), 1e-300);
    bool better = false;
    for (int attempt = 0; attempt < 12 && !better; ++attempt, damping *= 8.0) {
      MatrixXd damped = normal;
      damped.diagonal() += damping * normal.diagonal();
      damped.diagonal().array() += floor;
      const VectorXd step =
          -numerics::positive_definite_solve(damped, gradient, "fit_damped_cosines: normal matrix");
      auto poles_there = moved(state.poles, step, window);
      auto there = project(window, background, poles_there);
      const double cost_there = cost_of(there.residual, weight);
      if (cost_there > cost) continue;
      better = true;
      state.converged = cost - cost_there <= 1e-12 * cost || step.cwiseAbs().maxCoeff() < 1e-9;
      state.poles = std::move(poles_there);
      state.at = std::move(there);
      cost = cost_there;
      damping /= 64.0;
      damping = std::max(damping, 1e-12);
    }
    // No step lowers the cost: rounding is all that is left.
    if (!better) state.converged = true;
  }
  return state;
}

}  // namespace boresight::identification::ring
