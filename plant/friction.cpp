#include <cmath>

#include <boresight/plant/friction.hpp>

namespace boresight::plant {

double friction_torque(const FrictionCurve& curve, double rate) {
  if (rate == 0.0) return 0.0;
  const double w = std::abs(rate);
  const double bump = std::exp(-std::pow(w / curve.stribeck_rate, 2));
  const double torque =
      curve.coulomb_torque + (curve.breakaway_torque - curve.coulomb_torque) * bump -
      curve.saturating_torque * std::expm1(-w / curve.saturating_rate) + curve.viscous_friction * w;
  return std::copysign(torque, rate);
}

double friction_slope(const FrictionCurve& curve, double rate) {
  const double w = std::abs(rate);
  const double ws = curve.stribeck_rate;
  return -2.0 * w / (ws * ws) * (curve.breakaway_torque - curve.coulomb_torque) *
             std::exp(-std::pow(w / ws, 2)) +
         curve.saturating_torque / curve.saturating_rate * std::exp(-w / curve.saturating_rate) +
         curve.viscous_friction;
}

}  // namespace boresight::plant
