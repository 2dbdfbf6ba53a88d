#pragma once

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// Computes how the optimum depends on other properties, for the best plain PI structure and the
/// best of all (recommended_structure) of a study that has its series. Sets
/// MatchingStudy::variants: coarser studies on single plants with other leakage, friction and
/// structure frequencies, the mission's alternatives and the other wind models. Sets
/// MatchingStudy::thresholds: the friction above which the inertia does not matter. An interrupt
/// keeps the completed parts. The result does not depend on the number of threads.
/// @throws InvalidInput as plant::changed and match_motors.
void vary(const Mission& mission, const MatchOptions& options, MatchingStudy& study);

}  // namespace boresight::design
