#pragma once

#include <boresight/app/tune/tune_section.hpp>
#include <boresight/design/decisions/recommend.hpp>

namespace boresight::app {

/// A tuned controller as design::recommend compares it. A nominal design counts as one that was not
/// evaluated on the ensemble: the robust design of its structure was. Budgets are those required at
/// its wind speed, and the goal of the rms at the first wind speed. Without simulation: as if none
/// had run.
design::Assessment assessment_of(const TuneSection& section, const TunedLaw& row,
                                 bool with_simulation = true);

/// design::recommend over the tuned controllers of one wind speed. Null without a winner.
const TunedLaw* recommended_at(const TuneSection& section, double wind_speed, bool with_simulation,
                               const design::RecommendOptions& options);

}  // namespace boresight::app
