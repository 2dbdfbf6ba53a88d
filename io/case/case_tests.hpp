#pragma once

#include <optional>
#include <string>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// The hydraulic mode as measured.
struct ResonanceEntry {
  std::optional<Quantity> frequency, damping;
  /// They are of the mode with most oil, not of the lowest one.
  bool of_oil = false;
};

struct TachometerEntry {
  Quantity voltage;
  Quantity shaft_speed;
  Quantity motor_teeth;       // motor turns per tachometer turn, numerator
  Quantity tachometer_teeth;  // and denominator
  Quantity recorder_limit;
};

struct FrictionTestsEntry {
  std::optional<Quantity> constant_speed_coulomb;
  std::optional<Quantity> constant_speed_slope;
  std::optional<Quantity> slow_ramp_up;
  std::optional<Quantity> slow_ramp_down;
};

/// A reflected inertia found by impulse and momentum.
struct ImpulseResult {
  std::string name;
  std::string friction;  // "constant_speed" or "slow_ramp": the friction that was subtracted
  Quantity reflected_inertia;
};

}  // namespace boresight::io
