#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/identification/friction/friction_curve_fit.hpp>
#include <boresight/identification/friction/friction_rows.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

constexpr Eigen::Index count = 10;  // parameters
enum Parameter : Eigen::Index { tc, bump, ws, th, wh, bv, off, zero, inertia, common };

struct Model {
  const FrictionRows* rows;
  Eigen::VectorXd prior;            // mean
  Eigen::VectorXd prior_deviation;  // infinite: none
};

// Residual (torque measured less modelled, N m) and its derivatives by the parameters.
void evaluate(const Model& model, const Eigen::VectorXd& p, Eigen::VectorXd& residual,
              Eigen::MatrixXd* jacobian) {
  const auto& rows = *model.rows;
  const double e_tc = std::exp(p(tc)), e_bump = std::exp(p(bump)), e_ws = std::exp(p(ws)),
               e_th = std::exp(p(th)), e_wh = std::exp(p(wh)), e_bv = std::exp(p(bv));
  for (Eigen::Index row = 0; row < rows.size(); ++row) {
    const auto& motion = rows.motion[static_cast<std::size_t>(row)];
    double s_sign = 0.0, s_bump = 0.0, d_ws = 0.0, s_rise = 0.0, d_wh = 0.0, s_rate = 0.0,
           d_zero = 0.0;
    for (Eigen::Index i = 0; i < motion.rate.size(); ++i) {
      const double rate = motion.rate(i) - p(zero);
      const double weight = motion.rate_weight(i);
      const double signed_weight = rate < 0.0 ? -weight : weight;
      const double x = std::abs(rate) / e_ws, y = std::abs(rate) / e_wh;
      const double gauss = std::exp(-x * x), decay = std::exp(-y);
      s_sign += signed_weight;
      s_bump += signed_weight * gauss;
      d_ws += signed_weight * 2.0 * x * x * gauss;
      s_rise += signed_weight * (1.0 - decay);
      d_wh -= signed_weight * y * decay;
      s_rate += weight * rate;
      d_zero -= weight * (-e_bump * 2.0 * x / e_ws * gauss + e_th * decay / e_wh + e_bv);
    }
    const double per = 1.0 / motion.duration;
    residual(row) = rows.torque(row) + rows.structure(row) -
                    per * (e_tc * s_sign + e_bump * s_bump + e_th * s_rise + e_bv * s_rate +
                           p(inertia) * motion.rate_change) -
                    p(off) - p(common) * rows.common_pressure(row);
    if (jacobian == nullptr) continue;
    jacobian->row(row) << -per * e_tc * s_sign, -per * e_bump * s_bump, -per * e_bump * d_ws,
        -per * e_th * s_rise, -per * e_th * d_wh, -per * e_bv * s_rate, -1.0, -per * d_zero,
        -per * motion.rate_change, -rows.common_pressure(row);
  }
}

double prior_cost(const Model& model, const Eigen::VectorXd& p) {
  return ((p - model.prior).array() / model.prior_deviation.array()).square().sum();
}

struct Fit {
  Eigen::VectorXd p;
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  double cost = std::numeric_limits<double>::infinity();
};

// Levenberg-Marquardt with fixed weights 1/deviation^2.
void refine(const Model& model, const Eigen::VectorXd& deviation, Fit& fit) {
  const Eigen::Index size = model.rows->size();
  const Eigen::ArrayXd weight = deviation.array().square().inverse();
  Eigen::VectorXd trial_residual(size);
  Eigen::MatrixXd trial_jacobian(size, count);
  const auto cost_of = [&](const Eigen::VectorXd& p, const Eigen::VectorXd& residual) {
    return (residual.array().square() * weight).sum() + prior_cost(model, p);
  };
  evaluate(model, fit.p, fit.residual, &fit.jacobian);
  fit.cost = cost_of(fit.p, fit.residual);
  double damping = 1e-3;
  const Eigen::ArrayXd prior_weight = model.prior_deviation.array().square().inverse();
  for (int iteration = 0; iteration < 60; ++iteration) {
    Eigen::MatrixXd normal = fit.jacobian.transpose() * weight.matrix().asDiagonal() * fit.jacobian;
    Eigen::VectorXd gradient = fit.jacobian.transpose() * (weight * fit.residual.array()).matrix();
    normal.diagonal().array() += prior_weight;
    gradient.array() += prior_weight * (fit.p - model.prior).array();
    normal.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd step =
        -numerics::positive_definite_solve(normal, gradient, "friction curve's normal equations");
    const Eigen::VectorXd trial = fit.p + step;
    // A logarithm that leaves the range of numbers is no step.
    if (trial.head(6).cwiseAbs().maxCoeff() < 100.0) {
      evaluate(model, trial, trial_residual, &trial_jacobian);
      const double cost = cost_of(trial, trial_residual);
      if (cost <= fit.cost) {
        const double gain = fit.cost - cost;
        fit.p = trial;
        fit.residual.swap(trial_residual);
        fit.jacobian.swap(trial_jacobian);
        fit.cost = cost;
        damping = std::max(1e-9, 0.2 * damping);
        if (gain <= 1e-9 * cost) return;
        continue;
      }
    }
    damping = std::max(1e-6, 8.0 * damping);
    if (damping > 1e8) return;
  }
}

// A record's scatter, but not less than half the middle one's: none may rule alone.
Eigen::VectorXd scatter_by_row(const FrictionRows& rows, const Eigen::VectorXd& residual) {
  std::vector<double> sizes;
  std::vector<std::pair<std::size_t, double>> records;
  for (Eigen::Index begin = 0; begin < rows.size();) {
    Eigen::Index end = begin;
    std::vector<double> size;
    while (end < rows.size() && rows.record[static_cast<std::size_t>(end)] ==
                                    rows.record[static_cast<std::size_t>(begin)]) {
      size.push_back(std::abs(residual(end++)));
    }
    sizes.push_back(numerics::median(size) / 0.6745);
    records.emplace_back(size.size(), sizes.back());
    begin = end;
  }
  const double minimum =
      std::max(0.5 * numerics::median(sizes), 1e-9 * rows.torque.cwiseAbs().maxCoeff());
  Eigen::VectorXd scatter(rows.size());
  Eigen::Index at = 0;
  for (const auto& [length, value] : records) {
    scatter.segment(at, static_cast<Eigen::Index>(length)).setConstant(std::max(minimum, value));
    at += static_cast<Eigen::Index>(length);
  }
  return scatter;
}

// H^-1 (sum over pairs of rows of one record, closer than the correlation time, of Bartlett's
// weight times the scores' product + prior) H^-1.
Eigen::MatrixXd covariance(const Model& model, const Fit& fit, const Eigen::VectorXd& deviation,
                           const Eigen::MatrixXd& inverse, double correlation_time) {
  const auto& rows = *model.rows;
  const Eigen::MatrixXd score =
      (fit.residual.array() / deviation.array().square()).matrix().asDiagonal() * fit.jacobian;
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    for (Eigen::Index j = i; j < rows.size(); ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double fraction = 1.0 - (rows.time[b] - rows.time[a]) / correlation_time;
      if (rows.record[a] != rows.record[b] || fraction <= 0.0) break;
      const Eigen::MatrixXd product = score.row(i).transpose() * score.row(j);
      middle += i == j ? product : Eigen::MatrixXd(fraction * (product + product.transpose()));
    }
  }
  middle.diagonal().array() += model.prior_deviation.array().square().inverse();
  return inverse * middle * inverse;
}

// How the estimate follows from errors removed from each channel: p -= (J'WJ + P)^-1 J'W dr.
void by_transducers(const Model& model, const Fit& fit, const Eigen::ArrayXd& weight,
                    const Eigen::MatrixXd& inverse, const Campaign& campaign,
                    FrictionCurveFit& result) {
  const auto& rows = *model.rows;
  const Eigen::Index channels = rows.motion.front().pressure_impulse.size();
  Eigen::MatrixXd by_gain(rows.size(), channels), by_zero(rows.size(), channels);
  const double scale = torque_per_pressure(campaign.knowledge);
  for (Eigen::Index row = 0; row < rows.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const auto inlets =
        static_cast<Eigen::Index>(campaign.records[rows.record[at]].inlet_pressure.size());
    const auto& motion = rows.motion[at];
    for (Eigen::Index channel = 0; channel < channels; ++channel) {
      const double sign = channel < inlets ? scale : -scale;
      by_gain(row, channel) = -sign * motion.pressure_impulse(channel) / motion.duration;
      by_zero(row, channel) = -sign;
    }
  }
  const Eigen::MatrixXd solve = -inverse * fit.jacobian.transpose() * weight.matrix().asDiagonal();
  result.by_pressure_gain = solve * by_gain;
  result.by_pressure_zero = solve * by_zero;
  const Eigen::VectorXd by_structure = solve * rows.structure * rows.structure_uncertainty;
  result.covariance += by_structure * by_structure.transpose();
}

void name_parameters(const Model& model, FrictionCurveFit& result) {
  const std::array<const char*, 6> names{"Coulomb torque Tc",  "Stribeck torque Ts - Tc",
                                         "Stribeck rate ws",   "saturating torque Th",
                                         "saturating rate wh", "viscous friction Bv"};
  std::string undetermined;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double deviation = std::sqrt(result.covariance(i, i));
    FittedParameter parameter;
    if (i < 6) {
      parameter.name = names[static_cast<std::size_t>(i)];
      parameter.interval = numerics::normal_interval(result.estimate(i), deviation);
      auto& [value, uncertainty, lower, upper] = parameter.interval;
      value = std::exp(value);
      uncertainty = value * deviation;
      lower = std::exp(lower);
      upper = std::exp(upper);
      parameter.determined =
          deviation < std::min(std::numbers::ln2, 0.7 * model.prior_deviation(i));
    } else {
      parameter.name = i == off       ? "offset torque"
                       : i == zero    ? "tachometer zero"
                       : i == inertia ? "inertia"
                                      : "torque by common pressure";
      parameter.interval = numerics::normal_interval(result.estimate(i), deviation);
      parameter.determined = deviation < 0.7 * model.prior_deviation(i);
    }
    if (!parameter.determined) undetermined += (undetermined.empty() ? "" : ", ") + parameter.name;
    result.parameters.push_back(std::move(parameter));
  }
  result.notes.push_back(
      undetermined.empty()
          ? "The data determine every parameter of the friction curve."
          : fmt::format("The data do not determine {}: the curve between the tested speeds does "
                        "not depend on how they share it, beyond them it does.",
                        undetermined));
}

void list_points(const Model& model, const Fit& fit, FrictionCurveFit& result) {
  const auto& rows = *model.rows;
  result.lowest_rate = std::numeric_limits<double>::infinity();
  for (Eigen::Index row = 0; row < rows.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const auto& motion = rows.motion[at];
    FrictionPoint point{rows.record[at], rows.time[at], motion.mean_rate - fit.p(zero), 0.0, 0.0};
    for (Eigen::Index i = 0; i < motion.rate.size(); ++i) {
      point.fitted += motion.rate_weight(i) / motion.duration *
                      plant::friction_torque(result.curve, motion.rate(i) - fit.p(zero));
    }
    point.friction = point.fitted + fit.residual(row);
    result.lowest_rate = std::min(result.lowest_rate, std::abs(point.rate));
    result.highest_rate = std::max(result.highest_rate, std::abs(point.rate));
    result.points.push_back(point);
  }
  result.scatter = std::sqrt(fit.residual.squaredNorm() / static_cast<double>(rows.size()));
  result.notes.push_back(fmt::format(
      "Friction curve from {} windows, {:.3g} to {:.3g} rad/s, scatter {:.3g} N m rms; offset "
      "{:.4g} N m, tachometer zero {:.2g} rad/s.",
      rows.size(), result.lowest_rate, result.highest_rate, result.scatter, result.offset,
      result.tachometer_zero));
}

}  // namespace

plant::FrictionCurve friction_curve(const Eigen::VectorXd& p) {
  return {std::exp(p(tc)), std::exp(p(tc)) + std::exp(p(bump)),
          std::exp(p(ws)), std::exp(p(th)),
          std::exp(p(wh)), std::exp(p(bv))};
}

FrictionCurveFit fit_friction_curve(const Campaign& campaign,
                                    const numerics::Uncertain& inertia_prior,
                                    const FrictionCurveOptions& options) {
  if (!(inertia_prior.value > 0.0) || !(inertia_prior.standard_uncertainty > 0.0)) {
    throw InvalidInput(fmt::format(
        "fit_friction_curve: expected a positive inertia and uncertainty, found {} and {}",
        inertia_prior.value, inertia_prior.standard_uncertainty));
  }
  const FrictionRows rows = friction_rows(campaign, options);
  const Eigen::ArrayXd relative = options.relative_scatter * rows.torque.array().abs();
  Eigen::VectorXd deviation = (relative + 0.01 * rows.torque.cwiseAbs().maxCoeff()).matrix();
  Model model{&rows, Eigen::VectorXd::Zero(count), Eigen::VectorXd(count)};
  Fit fit{friction_start(rows, inertia_prior, deviation), Eigen::VectorXd(rows.size()),
          Eigen::MatrixXd(rows.size(), count)};
  model.prior = fit.p;
  model.prior(zero) = 0.0;
  model.prior(inertia) = inertia_prior.value;
  const double common_prior =
      std::max(1e-12 * rows.torque.cwiseAbs().maxCoeff() / rows.mean_common_pressure,
               torque_per_pressure(campaign.knowledge) * campaign.instruments.pressure_gain *
                   std::sqrt(static_cast<double>(rows.motion.front().pressure_impulse.size())));
  // Wide: a factor of 20 in a torque, of 4 in a rate, at one standard deviation.
  model.prior_deviation << 3.0, 3.0, 1.4, 3.0, 1.4, 3.0, rows.torque.cwiseAbs().maxCoeff(),
      std::max(1e-12 * rows.highest_rate, rows.tachometer_zero), inertia_prior.standard_uncertainty,
      common_prior;
  for (int pass = 0; pass < 6; ++pass) {
    refine(model, deviation, fit);
    const Eigen::ArrayXd scatter =
        (scatter_by_row(rows, fit.residual).array().square() + relative.square()).sqrt();
    constexpr double huber = 2.5;
    deviation =
        (scatter * (fit.residual.array().abs() / (huber * scatter)).max(1.0).sqrt()).matrix();
  }
  refine(model, deviation, fit);
  const Eigen::ArrayXd weight = deviation.array().square().inverse();
  Eigen::MatrixXd normal = fit.jacobian.transpose() * weight.matrix().asDiagonal() * fit.jacobian;
  normal.diagonal().array() += model.prior_deviation.array().square().inverse();
  const Eigen::MatrixXd inverse = numerics::positive_definite_solve(
      normal, Eigen::MatrixXd::Identity(count, count), "friction curve's normal equations");
  FrictionCurveFit result;
  result.estimate = fit.p;
  result.curve = friction_curve(fit.p);
  result.offset = fit.p(off);
  result.tachometer_zero = fit.p(zero);
  result.inertia = fit.p(inertia);
  result.torque_by_common_pressure = fit.p(common);
  result.mean_common_pressure = rows.mean_common_pressure;
  result.common_pressure_variation =
      std::sqrt(rows.common_pressure.squaredNorm() / static_cast<double>(rows.size()));
  result.covariance = covariance(model, fit, deviation, inverse, options.correlation_time);
  by_transducers(model, fit, weight, inverse, campaign, result);
  name_parameters(model, result);
  list_points(model, fit, result);
  return result;
}

}  // namespace boresight::identification
