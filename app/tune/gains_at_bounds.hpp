#pragma once

#include <string>
#include <vector>

#include <boresight/app/tune/tune_section.hpp>
#include <boresight/design/studies/gains_at_bounds.hpp>

namespace boresight::app {

using design::SearchedController;

/// One sentence per search bound at which gains of a study's tuned controllers lie, in the order of
/// the controllers; it names them. The result of corners_beyond_sampling for that bound follows.
/// Unstable controllers are left out.
std::vector<std::string> gains_at_bounds(const std::vector<SearchedController>& controllers);
/// Same, for rows of `tune`'s table; present controllers are left out too. `sample_time` in s, as
/// above.
std::vector<std::string> gains_at_bounds(const std::vector<const TunedController*>& controllers,
                                         double sample_time);

/// One sentence per corner of a lag, lead or notch that lies at the upper bound of its search,
/// above pi over the sample time. A sampled controller cannot realise such a corner; the sentence
/// names the structure without it. Empty if the sample time is not known.
std::vector<std::string> corners_beyond_sampling(const SearchedController& controller);

/// One sentence per controller whose position gain at its bound is ill-determined
/// (TunedController::trade).
std::vector<std::string> gain_trades(const std::vector<const TunedController*>& controllers,
                                     const io::GainUnits& units);

/// All remarks on gains at bounds for rows of a study: gains_at_bounds, then gain_trades.
std::vector<std::string> about_bounds(const design::TuningStudy& study, const io::GainUnits& units,
                                      const std::vector<const TunedController*>& controllers);

}  // namespace boresight::app
