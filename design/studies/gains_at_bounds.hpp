#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// A controller with the name that its user gave it, and the search that found it.
struct SearchedController {
  std::string name;
  const TuningResult* tuning = nullptr;
  double sample_time = 0.0;  // s, of the computer that runs it; 0: unknown
};

/// A simpler structure, left when an idle block is removed from the named structures.
struct SimplerStructure {
  std::string name;  // a standard structure's short name; empty: none has these blocks
  std::vector<std::string> in_place_of;  // as the user names them
};

/// A bound of the search at which gains of controllers end.
struct ReachedBound {
  control::GainDescription gain;
  bool upper = false;
  double sample_time = 0.0;              // s, of these controllers
  std::vector<std::string> controllers;  // names
  /// The kind of block (lag, lead or notch) that has no effect in a sampled controller: this corner
  /// of it ends at its upper bound above highest_frequency(sample_time). None where the sample time
  /// is unknown.
  std::optional<control::BlockKind> idle;
  std::vector<SimplerStructure> simpler;

  /// In the gain's unit.
  double value() const { return upper ? gain.upper : gain.lower; }
};

/// The highest frequency (rad/s) of a controller with sample time T (s): pi / T.
double highest_frequency(double sample_time);

/// Each bound once, in the order of the controllers. Unstable controllers are skipped.
std::vector<ReachedBound> reached_bounds(const std::vector<SearchedController>& controllers);

/// True if one of the controller's reached_bounds has an idle block: a corner above
/// highest_frequency(sample_time). `sample_time` in s; 0: unknown.
bool ends_beyond_sampling(const TuningResult& tuning, double sample_time);

}  // namespace boresight::design
