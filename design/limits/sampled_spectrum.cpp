#include <cmath>
#include <complex>
#include <numbers>

#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/numerics/real_schur.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::design {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXXcd;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr Index sensors = 3;
// Of a variance: what is left out of the densities.
constexpr double negligible = 1e-9;

// V with V V' = Q to `negligible` of each diagonal element: the factor's columns fall off.
MatrixXd leading_factor(const MatrixXd& q, const char* what) {
  MatrixXd factor = numerics::semidefinite_factor(q, what);
  Index kept = factor.cols();
  const auto fraction = [&](Index column) {
    double largest = 0.0;
    for (Index row = 0; row < q.rows(); ++row) {
      if (!(q(row, row) > 0.0)) continue;
      largest = std::max(largest, factor(row, column) * factor(row, column) / q(row, row));
    }
    return largest;
  };
  while (kept > 1 && fraction(kept - 1) < negligible) --kept;
  return factor.leftCols(kept);
}

Eigen::ArrayXd trapezoidal_weights(const Eigen::ArrayXd& frequency, double sample_time) {
  const Index count = frequency.size();
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(count);
  const Eigen::ArrayXd half = 0.5 * (frequency.tail(count - 1) - frequency.head(count - 1));
  weights.head(count - 1) += half;
  weights.tail(count - 1) += half;
  // The ends, down to 0 and up to the Nyquist frequency.
  weights[0] += frequency[0];
  weights[count - 1] += std::numbers::pi / sample_time - frequency[count - 1];
  return weights * sample_time / std::numbers::pi;
}

// Phi (S K)^H, frequencies x sensors.
ArrayXXcd sensors_with_command(const SampledSpectrum& spectrum, const ArrayXXcd& closed) {
  ArrayXXcd result(closed.rows(), sensors);
  for (Index i = 0; i < sensors; ++i) {
    result.col(i) = spectrum.sensors.col(sensors * i) * closed.col(0).conjugate();
    for (Index j = 1; j < sensors; ++j) {
      result.col(i) += spectrum.sensors.col(sensors * i + j) * closed.col(j).conjugate();
    }
  }
  return result;
}

double boresight_mean_square(const SampledSpectrum& spectrum, const ArrayXXcd& closed,
                             const ArrayXXcd& seen) {
  const Eigen::ArrayXd density = spectrum.boresight +
                                 2.0 * (closed * spectrum.cross).rowwise().sum().real() +
                                 spectrum.by_command * (closed * seen).rowwise().sum().real();
  return (spectrum.weights * density).sum() + spectrum.unavoidable_cost;
}

}  // namespace

SampledSpectrum sampled_spectrum(const SampledSetting& setting, const Eigen::ArrayXd& frequency) {
  const control::SampledLqgProblem& problem = setting.sampled();
  const double sample_time = setting.problem().sample_time;
  const Index states = problem.plant.a.rows(), count = frequency.size();
  MatrixXd cost(states + 1, states + 1);
  cost << problem.q, problem.s, problem.s.transpose(), problem.r;
  const MatrixXd weighted = leading_factor(cost, "cost of boresight").transpose();
  const MatrixXd process = leading_factor(problem.process_covariance, "process noise");
  const Index sources = process.cols();
  const auto schur = numerics::complex_schur(numerics::real_schur(problem.plant.a));
  MatrixXd inputs(states, sources + 1);
  inputs << process, problem.plant.b;
  const MatrixXcd from = schur.u.adjoint() * inputs;
  const MatrixXcd to_sensors = problem.plant.c * schur.u;
  const MatrixXcd to_boresight = weighted.leftCols(states) * schur.u;

  SampledSpectrum result;
  result.response.resize(count, sensors);
  result.sensors.resize(count, sensors * sensors);
  result.cross.resize(count, sensors);
  result.boresight.resize(count);
  result.by_command.resize(count);
  result.noise = problem.measurement_covariance.diagonal().array();
  result.unavoidable_cost = problem.unavoidable_cost;
  result.weights = trapezoidal_weights(frequency, sample_time);
  MatrixXcd shifted = -schur.t, state;
  for (Index k = 0; k < count; ++k) {
    shifted.diagonal() = std::polar(1.0, frequency[k] * sample_time) - schur.t.diagonal().array();
    state = shifted.triangularView<Eigen::Upper>().solve(from);
    const MatrixXcd at_sensors = to_sensors * state;
    MatrixXcd at_boresight = to_boresight * state;
    at_boresight.col(sources) += weighted.col(states);
    const auto by_sources = at_boresight.leftCols(sources);
    result.response.row(k) = at_sensors.col(sources).transpose().array();
    result.boresight[k] = by_sources.squaredNorm();
    result.by_command[k] = at_boresight.col(sources).squaredNorm();
    const MatrixXcd both = by_sources.adjoint() * at_boresight.col(sources);
    result.cross.row(k) = (at_sensors.leftCols(sources) * both).transpose().array();
    MatrixXcd density = at_sensors.leftCols(sources) * at_sensors.leftCols(sources).adjoint();
    density.diagonal().array() += result.noise;
    for (Index i = 0; i < sensors; ++i) {
      result.sensors.row(k).segment(sensors * i, sensors) = density.row(i).array();
    }
  }
  return result;
}

ArrayXcd sensitivity_function(const SampledSpectrum& spectrum, const ArrayXXcd& controller) {
  return (1.0 - (controller * spectrum.response).rowwise().sum()).inverse();
}

Eigen::ArrayXXd effort_curvature(const SampledSpectrum& spectrum, const ArrayXXcd& controller) {
  const Eigen::ArrayXd size =
      spectrum.weights.sqrt() * sensitivity_function(spectrum, controller).abs();
  const Eigen::RowVectorXd deviation = spectrum.noise.sqrt().matrix().transpose();
  const Eigen::ArrayXXd factors = (size.matrix() * deviation).array();
  return (factors / (factors * controller.abs()).matrix().norm()).square();
}

ArrayXXcd boresight_curvature(const SampledSpectrum& spectrum, const ArrayXXcd& controller) {
  const ArrayXcd sensitivity = sensitivity_function(spectrum, controller);
  const ArrayXXcd with_command = controller.colwise() * sensitivity;
  const double mean_square =
      boresight_mean_square(spectrum, with_command, sensors_with_command(spectrum, with_command));
  ArrayXXcd result(controller.rows(), sensors * sensors);
  for (Index k = 0; k < controller.rows(); ++k) {
    // Sensors in the closed loop: their density.
    Eigen::Matrix3cd closed = Eigen::Matrix3cd::Identity(), density;
    for (Index i = 0; i < sensors; ++i) {
      for (Index j = 0; j < sensors; ++j) {
        closed(i, j) += spectrum.response(k, i) * with_command(k, j);
        density(i, j) = spectrum.sensors(k, sensors * i + j);
      }
    }
    density = closed * density * closed.adjoint();
    const double scale =
        spectrum.weights[k] * spectrum.by_command[k] / mean_square * std::norm(sensitivity[k]);
    for (Index i = 0; i < sensors; ++i) {
      for (Index j = 0; j < sensors; ++j) {
        result(k, sensors * i + j) = scale * density(j, i);
      }
    }
  }
  return result;
}

}  // namespace boresight::design
