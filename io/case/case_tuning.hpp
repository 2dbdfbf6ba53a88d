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

/// A loop structure of the engineer's own. `bounds` are those written for each gain in the order of
/// the gain vector: reports give the gain in the lower one's unit.
struct LoopEntry {
  control::LoopStructure structure;
  std::vector<Quantity> lower, upper;
  std::vector<Quantity> present;  // of all gains, or none
};

/// The gains that the antenna runs on now, in the order of the structure's gain vector.
struct PresentGainsEntry {
  control::LoopStructure structure;
  std::vector<Quantity> gains;
};

/// What a tuning minimises over the ensemble of plants that may be the true one.
enum class SoftGoalKind { nominal, expected, worst_case, quantile };
std::string_view to_string(SoftGoalKind kind);

struct GoalsEntry {
  Quantity sensitivity_peak;
  /// At one break, in the order of control::loop_breaks, where it differs.
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
  /// The rms made least is that over the site's wind climate in the place of the design's speed.
  bool over_climate = false;
};

/// A range that members of the ensemble are drawn from, both ends SI.
struct RangeEntry {
  Quantity lower, upper;
};

/// Plants that may be the true one; what is left out has the ranges of the reference ensemble.
struct EnsembleEntry {
  long draws = 0;  // beside nominal and corners; 0: as the reference ensemble
  std::optional<RangeEntry> structure_frequency;  // factors
  std::optional<RangeEntry> oil_stiffness;        // factors
  std::optional<RangeEntry> leakage_rate;
  std::optional<RangeEntry> viscous_friction;
};

/// Bounds of the search for one gain of the usual structures, SI, in the place of those that follow
/// the antenna.
struct GainBoundEntry {
  std::string symbol;
  std::optional<Quantity> lower, upper;
};

/// What `boresight tune` works on, unless told otherwise.
struct TuningEntry {
  std::vector<std::string> structures;  // empty: the usual ones
  long starts = 0;                      // 0: as the tuner has it
  std::vector<GainBoundEntry> bounds;   // of every study that searches gains
};

}  // namespace boresight::io
