#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// The kind of the gain number `index` of a block.
Kind gain_kind(control::LoopPath path, control::BlockKind kind, std::size_t index);

/// A user-defined loop structure. `bounds` are as written for each gain, in the order of the gain
/// vector; reports give the gain in the lower bound's unit.
struct LoopEntry {
  control::LoopStructure structure;
  std::vector<Quantity> lower, upper;
  std::vector<Quantity> present;  // of all gains, or none
};

/// The gains in use at present, in the order of the structure's gain vector.
struct PresentGainsEntry {
  control::LoopStructure structure;
  std::vector<Quantity> gains;  // empty where the case states the structure alone
};

/// The objective of a tuning over the plant ensemble.
enum class SoftGoalKind { nominal, expected, worst_case, quantile };
std::string_view to_string(SoftGoalKind kind);

struct GoalsEntry {
  Quantity sensitivity_peak;
  /// At one break, in the order of control::loop_breaks, if it differs.
  std::array<std::optional<Quantity>, 3> peak_at_break;
  Quantity valve_effort;
  Quantity lowest_frequency;
  Quantity highest_frequency;
  std::optional<Quantity> gain_margin;   // dB, at every break
  std::optional<Quantity> phase_margin;  // rad, at every break
  std::optional<Quantity> bandwidth;     // rad/s, of the position loop
  std::optional<Quantity> crest_factor;  // of the torque in gusts, against the supply's
  std::optional<Quantity> beam_rms;      // rad
  SoftGoalKind soft_goal = SoftGoalKind::nominal;
  double quantile = 0.95;
  /// True if the minimised rms is the one over the site's wind climate instead of that at the
  /// design's speed.
  bool over_climate = false;
};

/// A range from which ensemble members are sampled, both ends SI.
struct RangeEntry {
  Quantity lower, upper;
};

/// The uncertainty set; omitted ranges are those of the reference ensemble.
struct EnsembleEntry {
  long draws = 0;  // beside nominal and corners; 0: as the reference ensemble
  std::optional<RangeEntry> structure_frequency;  // factors
  std::optional<RangeEntry> oil_stiffness;        // factors
  std::optional<RangeEntry> leakage_rate;
  std::optional<RangeEntry> viscous_friction;
};

/// Search bounds for one gain of the usual structures, SI, instead of those derived from the
/// antenna.
struct GainBoundEntry {
  std::string symbol;
  std::optional<Quantity> lower, upper;
};

/// Defaults of `boresight tune`.
struct TuningEntry {
  std::vector<std::string> structures;  // empty: the usual ones
  long starts = 0;                      // 0: as the tuner has it
  std::vector<GainBoundEntry> bounds;   // of every study that searches gains
};

}  // namespace boresight::io
