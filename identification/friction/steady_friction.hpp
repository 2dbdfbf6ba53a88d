#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <boresight/plant/antenna/friction.hpp>

namespace boresight::identification {

/// Friction torque (N m, at least 0) seen at a steady rate (rad/s, at least 0); at rate 0 what just
/// moved the antenna.
struct SteadyFriction {
  double rate = 0.0;
  double torque = 0.0;
  /// By how much the torque may be off (N m, at least 0).
  double leeway = 0.0;
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

/// Tests less the numbers that fit_steady_friction asks of them, whether or not these end at a
/// bound: with 0 the curve goes through whatever the tests say, and their residuals tell nothing.
/// @throws InvalidInput as fit_steady_friction.
int steady_friction_freedom(const std::vector<SteadyFriction>& tests);

/// Between what a number of the curve lies, in its own unit.
struct FrictionInterval {
  double least = 0.0;
  double largest = 0.0;
  /// A fit ran to that end of the search, so that the tests bear less, or more, as well.
  bool least_open = false;
  bool largest_open = false;
  /// Index of the test whose torque moves the number most, an open end counted as the search's;
  /// none where no test does.
  std::optional<std::size_t> moved_most_by;
};

/// How far the numbers of SteadyFrictionFit::curve hang on single torques.
struct SteadyFrictionIntervals {
  FrictionInterval coulomb_torque, breakaway_torque;  // N m
  FrictionInterval viscous_friction;                  // N m s/rad
  /// rad/s. None where it is not fitted: with fewer than four tests, or where no fit has Ts above
  /// Tc. A fit with Ts = Tc among others bears any rate and opens both ends.
  std::optional<FrictionInterval> stribeck_rate;
};

/// Least and largest over fit_steady_friction of the tests and of all sets in which one torque is
/// moved up or down by its leeway, though not below 0. One at a time, which is no confidence
/// interval: it shows whether a curve hangs on the last digit of one number.
/// @throws InvalidInput as fit_steady_friction, and for a leeway below 0 or not finite.
SteadyFrictionIntervals steady_friction_intervals(const std::vector<SteadyFriction>& tests);

}  // namespace boresight::identification
