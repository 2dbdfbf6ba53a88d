#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

struct StructureModeEntry {
  Quantity frequency, damping_ratio;
  /// With the bull gear held: as stated, or without a key by the effective fractions as read.
  Quantity inertia_fraction;
  Quantity wind_fraction, beam_weight;
  /// Of the mode with the motors held, where the case states that; then of every mode.
  std::optional<Quantity> effective_fraction = std::nullopt;
};

struct StructureEntry {
  /// As stated, or computed from gear_stiffness; then with the annotations of that number, its key
  /// included.
  Quantity locked_rotor_frequency;
  /// Of the gear train between motors, held, and bull gear, at the antenna's axis.
  std::optional<Quantity> gear_stiffness;
  /// Whether the modes' frequencies are with the motors held, as locked_rotor_frequency is; else
  /// with the bull gear held.
  bool motors_held = false;
  Quantity gear_damping_ratio;
  Quantity bull_gear_wind_fraction;
  Quantity bull_gear_beam_weight;
  std::vector<StructureModeEntry> modes;
  /// A bound from a structural model and the axis it was computed for.
  std::optional<Quantity> lowest_predicted;
  std::string lowest_predicted_axis;
};

}  // namespace boresight::io
