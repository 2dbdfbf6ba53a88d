#pragma once

#include <optional>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// Signals of the antenna's control computer, as the case states them. Defaults of those left out:
/// docs/case-file.md.
struct ComputerEntry {
  /// Command at the full stroke of the valve; at most one of the two.
  std::optional<Quantity> valve_voltage, valve_current;
  /// Full scale of the pressure transducers and their signal there; both or neither.
  std::optional<Quantity> transducer_pressure, transducer_voltage;
  std::optional<long> encoder_counts;      // in one turn of the axis
  std::optional<Quantity> encoder_zero;    // angle of the axis at count 0
  std::optional<Quantity> encoder_centre;  // middle of the axis's travel
};

}  // namespace boresight::io
