#pragma once

#include <string>
#include <vector>

#include <boresight/app/match/match_section.hpp>

namespace boresight::app {

/// Inputs other than the inertia that change the rms by more than negligible_change, worded by
/// Influences::sentence. Considered are the choice of structure as built, and the variants of the
/// structures compared.
std::string what_matters_more(const MatchSection& section);

/// A few sentences that say what the numbers mean, with their conditions.
std::vector<std::string> conclude(const MatchSection& section);

}  // namespace boresight::app
