#pragma once

#include <vector>

#include <boresight/plant/friction.hpp>

namespace boresight::identification {

/// Friction torque (N m, at least 0) seen at a steady rate (rad/s, at least 0); at rate 0 what just
/// moved the antenna.
struct SteadyFriction {
  double rate = 0.0;
  double torque = 0.0;
};

struct SteadyFrictionFit {
  plant::FrictionCurve curve;
  /// N m: root of the sum of squared residuals over the degrees of freedom; 0 where none is left.
  double scatter = 0.0;
};

/// The Stribeck curve T = Tc + (Ts - Tc) exp(-(w/ws)^2) + Bv w through tests at steady rates, by
/// least squares with Tc, Ts - Tc and Bv at least 0 (every set of active bounds is tried) and ws
/// searched between a third of the lowest and the highest rate. What the tests cannot tell is left
/// out of the curve: with fewer than four of them ws is a third of the lowest rate, and without one
/// at rest Ts is Tc; of one moving test Bv is 0. No saturating part.
/// @throws InvalidInput without a test that moves, for numbers below 0 or not finite, and for two
/// tests at the same rate.
SteadyFrictionFit fit_steady_friction(const std::vector<SteadyFriction>& tests);

}  // namespace boresight::identification
