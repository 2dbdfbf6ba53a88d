#pragma once

#include <string>
#include <vector>

#include <boresight/app/match/match_section.hpp>

namespace boresight::app {

/// What moves the rms by more than negligible_change instead of the inertia, as
/// Influences::sentence: the choice of structure as built, and the variants, of structures weighed.
std::string what_matters_more(const MatchSection& section);

/// A few sentences that say what the numbers mean, with their conditions.
std::vector<std::string> conclude(const MatchSection& section);

}  // namespace boresight::app
