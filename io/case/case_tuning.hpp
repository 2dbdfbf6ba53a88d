#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/io/case/case_declaration.hpp>
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

/// A range from which ensemble members are sampled, both ends SI.
struct RangeEntry {
  Quantity lower, upper;
};

/// The uncertainty set; omitted ranges are those of the reference ensemble.
struct EnsembleEntry {
  long random_samples = 0;  // beside nominal and corners; 0: as the reference ensemble
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

/// A loop structure by the name of one of the case's own, else as control::LoopStructure::named.
/// Its bounds are for the case's antenna (LoopStructure::with_bounds_for, driven_load; a dead zone
/// or freeze about one step of the encoder), except those in the case's [[tuning.bound]].
/// @throws InvalidInput listing them
control::LoopStructure loop_structure(const Case& antenna, const std::string& name);
/// Accepts a name that a study may be asked for: a loop structure's or design::state_space_name.
/// @throws InvalidInput for others, as loop_structure.
void check_structure(const Case& antenna, const std::string& name);
/// The usual structures with lag and without a conditional integral, with the same bounds.
std::vector<control::LoopStructure> usual_structures_with_lag(const Case& antenna);

}  // namespace boresight::io
