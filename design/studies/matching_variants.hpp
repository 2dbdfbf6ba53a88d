#pragma once

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// What else the optimum depends on, for the best plain PI structure of a study that has its series
/// and the best of all (recommended_structure): MatchingStudy::variants, coarser studies on single
/// plants with other leakage, friction, structure frequencies, the mission's alternatives and the
/// other wind models; MatchingStudy::thresholds, the friction that makes the inertia unimportant.
/// An interrupt leaves what is whole of it. The same for any number of threads.
/// @throws InvalidInput as plant::changed and match_motors.
void vary(const Mission& mission, const MatchOptions& options, MatchingStudy& study);

}  // namespace boresight::design
