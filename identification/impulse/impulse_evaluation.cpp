#include <cmath>

#include <boresight/identification/impulse/impulse_evaluation.hpp>

namespace boresight::identification {
namespace {

double line_impulse(const IntegratedMotion& motion, const ImpulseFriction& friction) {
  double sum = friction.offset * motion.duration;
  for (Eigen::Index i = 0; i < motion.rate.size(); ++i) {
    const double rate = motion.rate(i);
    const double torque = friction.intercept + friction.slope * std::abs(rate);
    sum += motion.rate_weight(i) * (rate < 0.0 ? -torque : torque);
  }
  return sum;
}

// Sums over the accelerating or the decelerating windows of one direction.
struct HalfPath {
  double impulse = 0.0, change = 0.0, count = 0.0;
};

}  // namespace

void add_curve(const FrictionCurveFit& fit, WindowImpulse& window) {
  const auto& motion = window.motion;
  window.by_curve = Eigen::VectorXd::Zero(fit.estimate.size());
  const double common = motion.pressure_impulse.mean() - fit.mean_common_pressure * motion.duration;
  window.curve_impulse = fit.offset * motion.duration + fit.torque_by_common_pressure * common;
  window.by_curve(6) = motion.duration;
  window.by_curve(9) = common;
  for (Eigen::Index i = 0; i < motion.rate.size(); ++i) {
    const double rate = motion.rate(i) - fit.tachometer_zero;
    window.curve_impulse += motion.rate_weight(i) * plant::friction_torque(fit.curve, rate);
    window.by_curve.head(6) += motion.rate_weight(i) * friction_gradient(fit.curve, rate);
    window.by_curve(7) -= motion.rate_weight(i) * plant::friction_slope(fit.curve, rate);
  }
}

double net_impulse(const WindowImpulse& window, const ImpulseFriction& friction,
                   double torque_per_pressure, double jerk_inertia,
                   const InstrumentErrors& errors) {
  const auto& motion = window.motion;
  const double impulse = torque_impulse(motion.pressure_impulse, window.inlets, motion.duration,
                                        torque_per_pressure, errors) +
                         jerk_inertia * motion.jerk;
  if (!friction.curve) return impulse - line_impulse(motion, friction);
  const double change =
      friction.curve_change.size() == 0 ? 0.0 : window.by_curve.dot(friction.curve_change);
  return impulse - window.curve_impulse - change;
}

double pooled_inertia(const std::vector<WindowImpulse>& windows, const ImpulseFriction& friction,
                      ImpulsePooling pooling, double torque_per_pressure, double jerk_inertia,
                      const InstrumentErrors& errors) {
  if (pooling == ImpulsePooling::closed_path) {
    double numerator = 0.0, denominator = 0.0;
    for (int direction : {1, -1}) {
      HalfPath up, down;
      for (const auto& window : windows) {
        if (window.source.direction != direction) continue;
        auto& half = window.source.accelerating ? up : down;
        half.impulse += net_impulse(window, friction, torque_per_pressure, jerk_inertia, errors);
        half.change += window.motion.rate_change;
        half.count += 1.0;
      }
      if (up.count == 0.0 || down.count == 0.0) continue;
      numerator += up.impulse / up.count + down.impulse / down.count;
      denominator += up.change / up.count + down.change / down.count;
    }
    return numerator / denominator;
  }
  double numerator = 0.0, denominator = 0.0;
  for (const auto& window : windows) {
    const double change = window.motion.rate_change;
    const double impulse = net_impulse(window, friction, torque_per_pressure, jerk_inertia, errors);
    if (pooling == ImpulsePooling::mean_of_quotients) {
      numerator += impulse / change;
      denominator += 1.0;
    } else {
      numerator += window.weight * change * impulse;
      denominator += window.weight * change * change;
    }
  }
  return numerator / denominator;
}

}  // namespace boresight::identification
