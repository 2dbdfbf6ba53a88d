#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <boresight/plant/antenna/friction.hpp>

namespace boresight::identification {

/// Friction torque (N m, at least 0) at a steady rate (rad/s, at least 0). At rate 0: the torque
/// that just moved the antenna.
struct SteadyFriction {
  double rate = 0.0;
  double torque = 0.0;
  /// Possible error of the torque (N m, at least 0).
  double leeway = 0.0;
};

struct SteadyFrictionFit {
  plant::FrictionCurve curve;
  /// N m: root of the sum of squared residuals over the degrees of freedom; 0 where none is left.
  double scatter = 0.0;
};

/// The Stribeck curve T = Tc + (Ts - Tc) exp(-(w/ws)^2) + Bv w through tests at steady rates. Least
/// squares with Tc, Ts - Tc and Bv at least 0 (every set of active bounds is tried); ws is searched
/// from a third of the lowest to the highest rate. Undetermined parameters are left out. With fewer
/// than four tests ws is a third of the lowest rate. Without a test at rest Ts is Tc; with one
/// moving test Bv is 0. No saturating part.
/// @throws InvalidInput without a moving test, for numbers below 0 or not finite, and for two tests
/// at the same rate.
SteadyFrictionFit fit_steady_friction(const std::vector<SteadyFriction>& tests);

/// Number of tests less number of parameters that fit_steady_friction determines, also if these end
/// at a bound. With 0 the curve fits any tests exactly and the residuals carry no information.
/// @throws InvalidInput as fit_steady_friction.
int steady_friction_freedom(const std::vector<SteadyFriction>& tests);

/// The range of a parameter of the curve, in its own unit.
struct FrictionInterval {
  double minimum = 0.0;
  double largest = 0.0;
  /// A fit reached that end of the search: the tests are also consistent with lower, or higher,
  /// values.
  bool min_open = false;
  bool largest_open = false;
  /// Index of the test whose torque moves the parameter most, an open end counting as the search's;
  /// none if no test moves it.
  std::optional<std::size_t> moved_most_by;
};

/// Sensitivity of the parameters of SteadyFrictionFit::curve to single torques.
struct SteadyFrictionIntervals {
  FrictionInterval coulomb_torque, breakaway_torque;  // N m
  FrictionInterval viscous_friction;                  // N m s/rad
  /// rad/s. None if it is not fitted: with fewer than four tests, or if no fit has Ts above Tc. A
  /// fit with Ts = Tc among others is consistent with any rate and opens both ends.
  std::optional<FrictionInterval> stribeck_rate;
};

/// Minimum and maximum of each parameter over fit_steady_friction of the tests and of all sets with
/// one torque moved up or down by its leeway (not below 0). Only one torque moves at a time, so
/// this is no confidence interval. It shows whether a curve depends on the last digit of one
/// number.
/// @throws InvalidInput as fit_steady_friction, and for a leeway below 0 or not finite.
SteadyFrictionIntervals steady_friction_intervals(const std::vector<SteadyFriction>& tests);

}  // namespace boresight::identification
