#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// A law with a name for its user, and the search that found it.
struct SearchedLaw {
  std::string name;
  const TuningResult* tuning = nullptr;
  double sample_time = 0.0;  // s, of the controller that runs it; 0: not known
};

/// What stands in the place of structures once a block that does nothing is left out of them.
struct SimplerStructure {
  std::string name;  // a usual structure's short name; empty: none has these blocks
  std::vector<std::string> in_place_of;  // as the user names them
};

/// A bound of the search that gains of laws end at.
struct ReachedBound {
  control::GainDescription gain;
  bool upper = false;
  double sample_time = 0.0;       // s, of these laws
  std::vector<std::string> laws;  // names
  /// The kind of block, a lag, lead or notch, that does nothing in a sampled controller, as this
  /// corner of it ends at its upper bound above highest_frequency(sample_time). None where the
  /// sample time is not known.
  std::optional<control::BlockKind> idle;
  std::vector<SimplerStructure> simpler;

  /// In the gain's unit.
  double value() const { return upper ? gain.upper : gain.lower; }
};

/// The highest frequency (rad/s) of a controller with that sample time (s): pi over it.
double highest_frequency(double sample_time);

/// Each bound once, in the order of the laws. Unstable laws are left out.
std::vector<ReachedBound> reached_bounds(const std::vector<SearchedLaw>& laws);

/// Whether a corner of a law ends where no controller with that sample time (s; 0: not known) acts:
/// whether one of its reached_bounds has a block that is idle.
bool ends_beyond_sampling(const TuningResult& tuning, double sample_time);

}  // namespace boresight::design
