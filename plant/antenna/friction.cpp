#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
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

double equivalent_friction(const FrictionCurve& curve, double rate_amplitude) {
  if (!(rate_amplitude > 0.0) || !std::isfinite(rate_amplitude)) {
    throw InvalidInput(
        fmt::format("equivalent_friction: expected an amplitude above 0 and finite, found {:g}",
                    rate_amplitude));
  }
  const auto moment = [&](double angle) {
    return friction_torque(curve, rate_amplitude * std::sin(angle)) * std::sin(angle);
  };
  constexpr unsigned halvings = 15;
  constexpr double tolerance = 1e-10;
  const double half = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
      moment, 0.0, 0.5 * std::numbers::pi, halvings, tolerance);
  return 4.0 / (std::numbers::pi * rate_amplitude) * half;
}

double friction_slope(const FrictionCurve& curve, double rate) {
  return dry_friction(curve, rate).derivative + curve.viscous_friction;
}

}  // namespace boresight::plant
