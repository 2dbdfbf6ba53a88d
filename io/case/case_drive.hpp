#pragma once

#include <optional>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

struct DriveEntry {
  Quantity leakage_rate;  // as stated, or by a flow at a pressure
  /// True if stated as a flow: the rate then scales with the oil's bulk modulus. A stated rate does
  /// not.
  bool leakage_by_flow = false;
  Quantity viscous_friction;
  Quantity valve_frequency;
  Quantity valve_damping;
  /// Flow at a total pressure drop over both edges, the valve fully open.
  std::optional<Quantity> valve_rated_flow, valve_rated_pressure_drop;
  Quantity supply_pressure;
  Quantity slew_rate;
  Quantity tracking_rate;
};

}  // namespace boresight::io
