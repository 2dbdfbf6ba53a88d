#pragma once

#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::app {

/// A law with a name for sentences, and the search that found it.
struct SearchedLaw {
  std::string name;
  const design::TuningResult* tuning = nullptr;
};

/// One sentence for each bound of the search that gains of tuned laws of a study end at, in the
/// order of the laws; it names the laws. Unstable laws are left out.
std::vector<std::string> gains_at_bounds(const std::vector<SearchedLaw>& laws);
/// Same, of rows of `tune`'s table; present laws are left out too.
std::vector<std::string> gains_at_bounds(const std::vector<const TunedLaw*>& laws);

/// One sentence for each law whose position gain at its bound is no sharp number
/// (TunedLaw::trade).
std::vector<std::string> gain_trades(const std::vector<const TunedLaw*>& laws);

}  // namespace boresight::app
