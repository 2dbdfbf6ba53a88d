#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include <boresight/identification/resonance/drive_response_fit.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

VectorXcd windowed_transform(VectorXd part) {
  const auto samples = static_cast<double>(part.size());
  VectorXd window(part.size());
  for (Index i = 0; i < part.size(); ++i) {
    window(i) = std::pow(std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / samples), 2);
  }
  part.array() -= part.dot(window) / window.sum();
  return numerics::fourier_transform(part.cwiseProduct(window));
}

VectorXd equation_weights(const WindowedTransforms& rate, const WindowedTransforms& torque,
                          const FrequencyBand& band, const BinNoise& noise) {
  // Smooth |Z|^2, so that a bin's own noise does not change its weight.
  VectorXd weight(band.count);
  for (Index k = 0; k < band.count; ++k) {
    const Index from = std::max<Index>(band.first + k - 3, 1);
    const Index count = std::min<Index>(7, rate.value.size() - from);
    const double z2 = torque.value.segment(from, count).squaredNorm() /
                      std::max(rate.value.segment(from, count).squaredNorm(), 1e-300);
    weight(k) = 1.0 / std::sqrt(noise.torque * noise.torque + z2 * noise.rate * noise.rate);
  }
  return weight;
}

}  // namespace

Complex FrequencyBand::s(Index k) const {
  return {0.0, two_pi * bin * static_cast<double>(first + k)};
}

WindowedTransforms windowed_transforms(const VectorXd& signal, const MovingPart& part,
                                       double sample_time) {
  const VectorXd own = signal.segment(part.first, part.samples);
  VectorXd slope(own.size());
  for (Index i = 1; i + 1 < own.size(); ++i) slope(i) = own(i + 1) - own(i - 1);
  slope(0) = slope(1);
  slope(own.size() - 1) = slope(own.size() - 2);
  slope /= 2.0 * sample_time;
  WindowedTransforms result{windowed_transform(own), windowed_transform(slope)};
  // The central difference's own response.
  for (Index k = 1; 2 * k < own.size(); ++k) {
    const double angle = two_pi * static_cast<double>(k) / static_cast<double>(own.size());
    result.derivative(k) *= angle / std::sin(angle);
  }
  return result;
}

FrequencyBand frequency_band(double lowest, double highest, double bin, Index bins) {
  const auto first = std::max<Index>(1, std::llround(lowest / bin));
  const Index last = std::min<Index>(bins - 2, std::llround(highest / bin));
  return {bin, first, std::max<Index>(0, last - first + 1)};
}

RealFit real_least_squares(const Eigen::MatrixXcd& columns, const VectorXcd& right,
                           const VectorXd& weight, Index nonlinear, const char* what) {
  if (2 * columns.rows() < columns.cols() + nonlinear) {
    throw NumericalFailure(
        fmt::format("{}: {} frequencies do not determine {} numbers; a longer record or a wider "
                    "band of excitation would",
                    what, columns.rows(), columns.cols() + nonlinear));
  }
  const Eigen::MatrixXcd scaled = weight.asDiagonal() * columns;
  const VectorXcd target = weight.asDiagonal() * right;
  MatrixXd normal = (scaled.adjoint() * scaled).real();
  normal.diagonal() *= 1.0 + 1e-13;
  RealFit fit;
  fit.x = numerics::positive_definite_solve(normal, (scaled.adjoint() * target).real(), what);
  fit.residual = target - scaled * fit.x;
  // Hann's window leaves two of three bins independent.
  const double freedom = 2.0 * static_cast<double>(columns.rows()) / 1.5 -
                         static_cast<double>(columns.cols() + nonlinear);
  const double variance = fit.residual.squaredNorm() / std::max(freedom, 1.0);
  fit.covariance = 1.5 * variance *
                   numerics::positive_definite_solve(
                       normal, MatrixXd::Identity(normal.rows(), normal.cols()), what);
  return fit;
}

Eigen::MatrixXcd impedance_columns(const WindowedTransforms& rate, const FrequencyBand& band,
                                   const VectorXd& poles) {
  const Index modes = poles.size() / 2;
  Eigen::MatrixXcd columns(band.count, 2 + modes);
  columns.col(0) = rate.value.segment(band.first, band.count);
  columns.col(1) = rate.derivative.segment(band.first, band.count);
  for (Index m = 0; m < modes; ++m) {
    const double w = two_pi * std::exp(poles(2 * m)), zeta = std::exp(poles(2 * m + 1));
    for (Index k = 0; k < band.count; ++k) {
      const Complex s = band.s(k) / w;
      const Complex spring = 1.0 + 2.0 * zeta * s;
      columns(k, 2 + m) = columns(k, 1) * spring / (spring + s * s);
    }
  }
  return columns;
}

ImpedanceFit fit_impedance(const WindowedTransforms& rate, const WindowedTransforms& torque,
                           const FrequencyBand& band, const BinNoise& noise,
                           const VectorXd& centres, Index fitted, double tolerance) {
  const VectorXd weight = equation_weights(rate, torque, band, noise);
  const VectorXcd target = torque.value.segment(band.first, band.count);
  const char* what = "drive_response: torque on rate and its derivative";
  ImpedanceFit fit;
  fit.poles.resize(2 * centres.size());
  for (Index m = 0; m < centres.size(); ++m) {
    fit.poles(2 * m) = std::log(centres(m));
    fit.poles(2 * m + 1) = std::log(0.01);
  }
  const auto at = [&](const VectorXd& poles) {
    return real_least_squares(impedance_columns(rate, band, poles), target, weight, 2 * fitted,
                              what);
  };
  const auto bounded = [&](VectorXd poles) {
    for (Index m = 0; m < fitted; ++m) {
      const double centre = std::log(centres(m));
      poles(2 * m) = std::clamp(poles(2 * m), centre - tolerance, centre + tolerance);
      poles(2 * m + 1) = std::clamp(poles(2 * m + 1), std::log(5e-4), std::log(0.2));
    }
    return poles;
  };
  fit.linear = at(fit.poles);
  // Mode by mode the best of a grid first: far from its place a lightly damped mode sees nothing.
  for (Index m = 0; m < fitted; ++m) {
    VectorXd best = fit.poles;
    for (int step = -20; step <= 20; ++step) {
      VectorXd poles = fit.poles;
      poles(2 * m) = std::log(centres(m)) + 0.05 * tolerance * static_cast<double>(step);
      poles(2 * m + 1) = std::log(0.02);
      auto there = at(poles);
      if (there.residual.squaredNorm() < fit.linear.residual.squaredNorm()) {
        fit.linear = std::move(there);
        best = poles;
      }
    }
    fit.poles = best;
  }
  MatrixXd normal;
  double damping = 1e-2;
  for (int iteration = 0; iteration < 40 && fitted > 0; ++iteration) {
    // Derivatives of the eliminated residual by differences: a few hundred bins.
    MatrixXd slope(2 * band.count, 2 * fitted);
    for (Index p = 0; p < slope.cols(); ++p) {
      VectorXd poles = fit.poles;
      poles(p) += 1e-5;
      const VectorXcd change = (at(poles).residual - fit.linear.residual) / 1e-5;
      slope.col(p) << change.real(), change.imag();
    }
    VectorXd residual(2 * band.count);
    residual << fit.linear.residual.real(), fit.linear.residual.imag();
    normal = slope.transpose() * slope;
    const double before = fit.linear.residual.squaredNorm();
    bool better = false;
    double gain = 0.0;
    for (int attempt = 0; attempt < 8 && !better; ++attempt, damping *= 10.0) {
      MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-12 * std::max(normal.diagonal().maxCoeff(), 1e-300);
      VectorXd step =
          -numerics::positive_definite_solve(damped, slope.transpose() * residual, what);
      for (Index p = 0; p < step.size(); ++p) {
        step(p) = std::clamp(step(p), p % 2 == 0 ? -0.05 : -1.0, p % 2 == 0 ? 0.05 : 1.0);
      }
      VectorXd poles = fit.poles;
      poles.head(2 * fitted) += step;
      poles = bounded(poles);
      auto there = at(poles);
      gain = before - there.residual.squaredNorm();
      if (gain < 0.0) continue;
      better = true;
      fit.poles = poles;
      fit.linear = std::move(there);
      damping /= 1000.0;
    }
    if (!better || gain < 1e-9 * before) break;
  }
  if (fitted > 0) {
    normal.diagonal().array() += 1e-9 * std::max(normal.diagonal().maxCoeff(), 1e-300);
    const double variance = fit.linear.residual.squaredNorm() /
                            std::max(2.0 * static_cast<double>(band.count) / 1.5, 1.0);
    fit.pole_covariance = 1.5 * variance *
                          numerics::positive_definite_solve(
                              normal, MatrixXd::Identity(normal.rows(), normal.cols()), what);
  }
  fit.total = fit.linear.x.tail(fit.linear.x.size() - 1).sum();
  return fit;
}

BinNoise bin_noise(const WindowedTransforms& rate, const WindowedTransforms& torque, double highest,
                   double bin) {
  // What is left far above the band; the window's own factor is in it.
  const auto floor = [&](const VectorXcd& transform) {
    const Index first = std::min<Index>(std::llround(2.0 * highest / bin), transform.size() / 2);
    const Index count = std::max<Index>(8, std::min(first, transform.size() - first) / 2);
    VectorXd power = transform.segment(transform.size() - count - 1, count).cwiseAbs2();
    const Index near = std::min(count, transform.size() - first);
    const double above = transform.segment(first, near).squaredNorm() / static_cast<double>(near);
    return std::sqrt(std::max(above, power.mean()));
  };
  return {floor(torque.value), floor(rate.value)};
}

numerics::Interval scaled_interval(double value, double statistical, double relative) {
  return numerics::normal_interval(value, std::hypot(statistical, relative * value));
}

}  // namespace boresight::identification
