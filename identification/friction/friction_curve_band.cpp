#include <cmath>

#include <boresight/identification/friction/friction_curve_fit.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

// All parameters: beyond the six none moves the curve itself.
Eigen::VectorXd gradient(const FrictionCurveFit& fit, double rate) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(fit.estimate.size());
  slope.head(6) = friction_gradient(fit.curve, rate);
  return slope;
}

double relative(const numerics::Uncertain& number) {
  return number.value == 0.0 ? 0.0 : number.standard_uncertainty / number.value;
}

// Variance of slope . estimate by the fit's scatter and by the transducers.
double variance(const FrictionCurveFit& fit, const Instruments& instruments,
                const Eigen::VectorXd& slope) {
  const Eigen::Index channels = fit.by_pressure_gain.cols();
  Eigen::VectorXd by_gain = fit.by_pressure_gain.transpose() * slope;
  by_gain = remaining_gain_errors(by_gain, channels / 2);
  const Eigen::VectorXd by_zero = fit.by_pressure_zero.transpose() * slope;
  return slope.dot(fit.covariance * slope) +
         by_gain.squaredNorm() * instruments.pressure_gain * instruments.pressure_gain +
         by_zero.squaredNorm() * instruments.pressure_zero * instruments.pressure_zero;
}

}  // namespace

Eigen::VectorXd friction_gradient(const plant::FrictionCurve& curve, double rate) {
  const double w = std::abs(rate);
  const double x = w / curve.stribeck_rate, y = w / curve.saturating_rate;
  const double bump = (curve.breakaway_torque - curve.coulomb_torque) * std::exp(-x * x);
  Eigen::VectorXd slope(6);
  slope << curve.coulomb_torque, bump, 2.0 * x * x * bump,
      curve.saturating_torque * (1.0 - std::exp(-y)), -curve.saturating_torque * y * std::exp(-y),
      curve.viscous_friction * w;
  return rate < 0.0 ? Eigen::VectorXd(-slope) : slope;
}

Eigen::VectorXd remaining_gain_errors(const Eigen::VectorXd& pressure_gain, Eigen::Index inlets) {
  const Eigen::Index channels = pressure_gain.size();
  if (channels == 0) return pressure_gain;
  Eigen::VectorXd sign = Eigen::VectorXd::Ones(channels);
  sign.tail(channels - inlets).setConstant(-1.0);
  return pressure_gain - sign * (sign.dot(pressure_gain) / static_cast<double>(channels));
}

numerics::Interval friction_as_recorded(const FrictionCurveFit& fit, double rate) {
  const Eigen::VectorXd slope = gradient(fit, rate);
  return numerics::normal_interval(plant::friction_torque(fit.curve, rate),
                                   std::sqrt(slope.dot(fit.covariance * slope)));
}

numerics::Interval friction_of_antenna(const FrictionCurveFit& fit, const Campaign& campaign,
                                       double rate) {
  const double torque = plant::friction_torque(fit.curve, rate);
  const double by_tachometer =
      plant::friction_slope(fit.curve, rate) * rate * campaign.instruments.tachometer_scale;
  const double by_constants = torque * std::hypot(relative(campaign.knowledge.displacement),
                                                  relative(campaign.knowledge.torque_efficiency));
  return numerics::normal_interval(
      torque, std::sqrt(variance(fit, campaign.instruments, gradient(fit, rate)) +
                        by_tachometer * by_tachometer + by_constants * by_constants));
}

numerics::Interval offset_as_recorded(const FrictionCurveFit& fit) {
  return numerics::normal_interval(
      fit.offset, std::hypot(std::sqrt(fit.covariance(6, 6)),
                             fit.torque_by_common_pressure * fit.common_pressure_variation));
}

numerics::Interval offset_of_antenna(const FrictionCurveFit& fit, const Campaign& campaign) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(fit.estimate.size());
  slope(6) = 1.0;
  slope(9) = -fit.mean_common_pressure;
  const double offset = slope.dot(fit.estimate);
  const double by_constants = offset * std::hypot(relative(campaign.knowledge.displacement),
                                                  relative(campaign.knowledge.torque_efficiency));
  return numerics::normal_interval(
      offset, std::sqrt(variance(fit, campaign.instruments, slope) + by_constants * by_constants));
}

Eigen::VectorXd draw_friction(const FrictionCurveFit& fit, const Eigen::MatrixXd& factor,
                              const InstrumentErrors& errors, std::uint64_t seed,
                              std::uint64_t draw) {
  const numerics::NormalNumbers normal(seed, draw);
  Eigen::VectorXd number(factor.cols());
  for (Eigen::Index i = 0; i < number.size(); ++i) {
    const auto pair = normal.pair(static_cast<std::uint64_t>(i / 2));
    number(i) = i % 2 == 0 ? pair.real() : pair.imag();
  }
  const Eigen::Index channels = fit.by_pressure_gain.cols();
  return factor * number +
         fit.by_pressure_gain *
             remaining_gain_errors(errors.pressure_gain.head(channels), channels / 2) +
         fit.by_pressure_zero * errors.pressure_zero.head(channels);
}

}  // namespace boresight::identification
