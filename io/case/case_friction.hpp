#pragma once

#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// Friction measured at a steady rate, all motors, at the motor shaft.
struct SteadyFrictionTest {
  double rate = 0.0;      // rad/s of the motors; 0 for what just moved the antenna
  double torque = 0.0;    // N m
  double residual = 0.0;  // N m, of the torque over the curve through all tests
  /// N m, at least 0: the torque's own standard uncertainty where it is stated, else half a unit of
  /// its last printed digit.
  double leeway = 0.0;
};

struct FrictionCurveEntry {
  Quantity coulomb, breakaway, stribeck_rate, saturating, saturating_rate, viscous;
  /// The tests at steady rates that the curve goes through; empty if its numbers are stated.
  std::vector<SteadyFrictionTest> tests;
};

}  // namespace boresight::io
