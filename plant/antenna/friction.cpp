#include <cmath>

#include <boresight/plant/antenna/friction.hpp>

namespace boresight::plant {

numerics::ValueAndDerivative dry_friction(const FrictionCurve& curve, double rate) {
  const double w = std::abs(rate);
  const double ws = curve.stribeck_rate;
  const double bump =
      (curve.breakaway_torque - curve.coulomb_torque) * std::exp(-(w / ws) * (w / ws));
  const double rise = std::exp(-w / curve.saturating_rate);
  return {curve.coulomb_torque + bump + curve.saturating_torque * (1.0 - rise),
          -2.0 * w / (ws * ws) * bump + curve.saturating_torque / curve.saturating_rate * rise};
}

double friction_torque(const FrictionCurve& curve, double rate) {
  if (rate == 0.0) return 0.0;
  return std::copysign(dry_friction(curve, rate).value, rate) + curve.viscous_friction * rate;
}

double friction_slope(const FrictionCurve& curve, double rate) {
  return dry_friction(curve, rate).derivative + curve.viscous_friction;
}

}  // namespace boresight::plant
