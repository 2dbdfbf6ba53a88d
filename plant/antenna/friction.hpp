#pragma once

#include <boresight/numerics/value_and_derivative.hpp>

namespace boresight::plant {

/// Steady friction torque against motor rate, the sum of a Stribeck bump, a part that rises
/// quickly with rate and then saturates, and a viscous part (for rate >= 0; odd in rate):
///   T(w) = Tc + (Ts - Tc) exp(-(w/ws)^2) + Th (1 - exp(-w/wh)) + Bv w     (N m, rad/s)
/// The saturating part is what lets a slow-ramp and a constant-speed test see different Coulomb
/// levels; a pure Stribeck curve (Th = 0) cannot.
struct FrictionCurve {
  double coulomb_torque = 0.0;     // Tc
  double breakaway_torque = 0.0;   // Ts
  double stribeck_rate = 1.0;      // ws
  double saturating_torque = 0.0;  // Th
  double saturating_rate = 1.0;    // wh
  double viscous_friction = 0.0;   // Bv, N m s/rad
};

/// T(w), odd in the rate; 0 at rest, where friction takes any value up to the breakaway torque.
double friction_torque(const FrictionCurve& curve, double rate);

/// dT/dw at |rate| (N m s/rad): the viscous friction a linear model of motion about that rate has.
double friction_slope(const FrictionCurve& curve, double rate);

/// T(w) - Bv w at |rate|, and its derivative by |rate|: the dry part, which at rest is what breaks
/// away.
numerics::ValueAndDerivative dry_friction(const FrictionCurve& curve, double rate);

/// Describing function of friction_torque for a sinusoidal motion with this amplitude of the rate
/// (rad/s, above 0): the viscous friction (N m s/rad) that dissipates as much,
///   b(V) = 2/(pi V) int_0^pi T(V sin a) sin a da,
/// 4 Tc/(pi V) for Coulomb friction. A sinusoidal friction torque stays in phase with the rate, so
/// that b is real. Motion within the bristles, before breakaway, is not included.
/// Source: Gelb and Vander Velde, Multiple-Input Describing Functions and Nonlinear System Design
/// (1968), chapter 2.
/// @throws InvalidInput for an amplitude that is not positive and finite.
double equivalent_friction(const FrictionCurve& curve, double rate_amplitude);

}  // namespace boresight::plant
