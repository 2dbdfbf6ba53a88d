#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// The objective of a tuning over the plant ensemble.
enum class ObjectiveKind { nominal, expected, worst_case, quantile };
std::string_view to_string(ObjectiveKind kind);

struct GoalsEntry {
  Quantity sensitivity_peak;
  /// At one break, in the order of control::loop_breaks, if it differs.
  std::array<std::optional<Quantity>, 3> peak_at_break;
  Quantity control_effort;
  Quantity lowest_frequency;
  Quantity highest_frequency;
  std::optional<Quantity> gain_margin;   // dB, at every break
  std::optional<Quantity> phase_margin;  // rad, at every break
  std::optional<Quantity> bandwidth;     // rad/s, of the position loop
  std::optional<Quantity> standstill_peak;
  std::optional<Quantity> limit_cycle_amplitude;  // rad
  std::optional<Quantity> static_encoder_error;   // rad, at rest in the mean wind
  std::optional<Quantity> crest_factor;           // of the torque in gusts, against the supply's
  std::optional<Quantity> boresight_rms;          // rad
  ObjectiveKind objective = ObjectiveKind::nominal;
  double quantile = 0.95;
  /// True if the minimised rms is the one over the site's wind climate instead of that at the
  /// design's speed.
  bool over_climate = false;
};

/// The numbers of flywheel disks that matching compares.
struct MatchingEntry {
  std::vector<double> disks;
};

/// Replaces goals of the case: each change is KEY=VALUE, with a key and value of [goals],
/// "control_effort=0.4 rad/s".
/// @throws InvalidInput for keys and values that [goals] would not take
void change_goals(GoalsEntry& goals, const std::vector<std::string>& changes);

}  // namespace boresight::io
