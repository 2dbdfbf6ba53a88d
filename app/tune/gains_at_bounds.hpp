#pragma once

#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>
#include <boresight/design/studies/gains_at_bounds.hpp>

namespace boresight::app {

using design::SearchedLaw;

/// One sentence for each bound of the search that gains of tuned laws of a study end at, in the
/// order of the laws; it names the laws. Behind it what corners_beyond_sampling says of that bound.
/// Unstable laws are left out.
std::vector<std::string> gains_at_bounds(const std::vector<SearchedLaw>& laws);
/// Same, of rows of `tune`'s table; present laws are left out too. `sample_time` (s) as above.
std::vector<std::string> gains_at_bounds(const std::vector<const TunedLaw*>& laws,
                                         double sample_time);

/// One sentence for each corner of a lag, lead or notch that ends at the upper bound of its search
/// above pi over the sample time, which does nothing that a sampled controller can do: that it is
/// to be left out, and by which structure. None where the sample time is not known.
std::vector<std::string> corners_beyond_sampling(const SearchedLaw& law);

/// One sentence for each law whose position gain at its bound is no sharp number
/// (TunedLaw::trade).
std::vector<std::string> gain_trades(const std::vector<const TunedLaw*>& laws,
                                     const io::GainUnits& units);

/// All that is to be said of gains at bounds of rows of a study: gains_at_bounds, then gain_trades.
std::vector<std::string> about_bounds(const design::TuningStudy& study, const io::GainUnits& units,
                                      const std::vector<const TunedLaw*>& laws);

}  // namespace boresight::app
