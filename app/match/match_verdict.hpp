#pragma once

#include <cstddef>
#include <string>

#include <boresight/app/match/match_section.hpp>

namespace boresight::app {

/// Largest rms of a structure over its least, less 1, over the inertias where a law was found; 0
/// where none was.
double span_of(const MatchSeries& series);

/// Whether the inertia is of no account: every structure has a law at every inertia, or at none,
/// and no span reaches negligible_change.
bool hardly_matters(const MatchSection& section);

/// What moves the rms by more than negligible_change instead, as a sentence with a blank before it:
/// other structures at the inertia as built, and the variants. Empty if nothing does.
std::string what_matters_more(const MatchSection& section);

/// The point of the motors as built; the last where none is marked.
std::size_t as_built(const MatchSection& section);

}  // namespace boresight::app
