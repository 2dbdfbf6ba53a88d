#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::plant {
namespace {

// Unknowns: ln gain, ln zeros, ln poles. Model: ln 2 + 2 ln g + sum ln(1 + w^2/z^2) - sum ln(1 +
// w^2/p^2).
struct Fit {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd residual;
  double cost = std::numeric_limits<double>::infinity();
};

void model(const Eigen::ArrayXd& w, const Eigen::VectorXd& target, int order,
           const Eigen::VectorXd& unknowns, Eigen::VectorXd& residual, Eigen::MatrixXd& jacobian) {
  residual = Eigen::VectorXd::Constant(w.size(), std::numbers::ln2 + 2.0 * unknowns[0]) - target;
  jacobian.col(0).setConstant(2.0);
  for (Eigen::Index k = 1; k < unknowns.size(); ++k) {
    const double sign = k < order ? 1.0 : -1.0;
    const Eigen::ArrayXd x = (w / std::exp(unknowns[k])).square();
    residual.array() += sign * (1.0 + x).log();
    jacobian.col(k) = -2.0 * sign * x / (1.0 + x);
  }
}

Fit levenberg_marquardt(const Eigen::ArrayXd& w, const Eigen::VectorXd& target, int order,
                        Eigen::VectorXd unknowns) {
  Eigen::MatrixXd jacobian(w.size(), unknowns.size());
  Fit fit;
  fit.unknowns = std::move(unknowns);
  model(w, target, order, fit.unknowns, fit.residual, jacobian);
  fit.cost = fit.residual.squaredNorm();
  double damping = 1e-2;
  Eigen::VectorXd residual;
  for (int iteration = 0; iteration < 300 && damping < 1e12; ++iteration) {
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * fit.residual;
    normal.diagonal().array() += damping * (1.0 + normal.diagonal().array());
    const Eigen::VectorXd step = numerics::linear_solve(normal, -gradient, "fit_shaping_filter");
    const Eigen::VectorXd trial = fit.unknowns + step;
    Eigen::MatrixXd trial_jacobian(w.size(), trial.size());
    model(w, target, order, trial, residual, trial_jacobian);
    const double cost = residual.squaredNorm();
    if (std::isfinite(cost) && cost < fit.cost) {
      const bool converged = fit.cost - cost < 1e-13 * fit.cost;
      fit = {trial, residual, cost};
      jacobian = trial_jacobian;
      // Not so small that a pole and a zero on one another make the equations singular.
      damping = std::max(0.3 * damping, 1e-10);
      if (converged) break;
    } else {
      damping *= 4.0;
    }
  }
  return fit;
}

}  // namespace

ShapingFilter fit_shaping_filter(const Eigen::ArrayXd& frequency, const Eigen::ArrayXd& spectrum,
                                 int order) {
  if (order < 1 || frequency.size() < 2 * order || frequency.size() != spectrum.size()) {
    throw InvalidInput(
        fmt::format("fit_shaping_filter: expected an order of at least 1 and at least {} points, "
                    "found order {}, {} frequencies, {} values",
                    2 * order, order, frequency.size(), spectrum.size()));
  }
  if (!(frequency > 0.0).all() || !(spectrum > 0.0).all() || !spectrum.allFinite()) {
    throw InvalidInput("fit_shaping_filter: expected positive finite frequencies and values");
  }
  const Eigen::ArrayXd w = two_pi * frequency;
  const Eigen::VectorXd target = spectrum.log().matrix();
  const double low = std::log(w.minCoeff());
  const double high = std::log(w.maxCoeff());
  Fit best;
  for (const double shift : {0.15, 0.3, 0.45, 0.6, 0.75}) {
    Eigen::VectorXd start(2 * order);
    start[0] = 0.5 * target.maxCoeff();
    const double step = (high - low) / (order + 0.5);
    for (int k = 0; k < order; ++k) start[order + k] = low + (k + shift) * step;
    for (int k = 0; k + 1 < order; ++k) start[1 + k] = low + (k + shift + 0.5) * step;
    Fit fit = levenberg_marquardt(w, target, order, std::move(start));
    if (fit.cost < best.cost) best = std::move(fit);
  }
  ShapingFilter filter;
  filter.gain = std::exp(best.unknowns[0]);
  for (int k = 1; k < order; ++k) filter.zeros.push_back(std::exp(best.unknowns[k]));
  for (int k = order; k < 2 * order; ++k) filter.poles.push_back(std::exp(best.unknowns[k]));
  std::sort(filter.zeros.begin(), filter.zeros.end());
  std::sort(filter.poles.begin(), filter.poles.end());
  filter.worst_log_error = best.residual.cwiseAbs().maxCoeff();
  return filter;
}

double filter_spectrum(const ShapingFilter& filter, double frequency) {
  const double w = two_pi * frequency;
  double square = filter.gain * filter.gain;
  for (const double zero : filter.zeros) square *= 1.0 + std::pow(w / zero, 2);
  for (const double pole : filter.poles) square /= 1.0 + std::pow(w / pole, 2);
  return 2.0 * square;
}

StateSpace to_state_space(const ShapingFilter& filter, const std::string& output) {
  std::vector<StateSpace> sections;
  std::string from = "white_noise";
  for (std::size_t k = 0; k < filter.poles.size(); ++k) {
    const bool last = k + 1 == filter.poles.size();
    const std::string to = last ? output : fmt::format("{}_section_{}", output, k + 1);
    std::vector<double> numerator{1.0};
    if (k < filter.zeros.size()) numerator.push_back(1.0 / filter.zeros[k]);
    if (k == 0) {
      for (double& coefficient : numerator) coefficient *= filter.gain;
    }
    sections.push_back(rational(numerator, {1.0, 1.0 / filter.poles[k]}, from, to,
                                fmt::format("{}_filter_{}", output, k + 1)));
    from = to;
  }
  return connect(sections, {"white_noise"}, {output});
}

}  // namespace boresight::plant
