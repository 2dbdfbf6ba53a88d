#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/app/match/match_section.hpp>

namespace boresight::app {

/// Largest rms of a structure over its least, less 1, over the inertias where a law was found; 0
/// where none was.
double span_of(const MatchSeries& series);

/// Whether the inertia is of no account: every structure has a law at every inertia, or at none,
/// and no span reaches negligible_change.
bool hardly_matters(const MatchSection& section);

/// What moves the rms by more than negligible_change instead, as Influences::sentence: other
/// structures at the inertia as built that do not hunt, and the variants.
std::string what_matters_more(const MatchSection& section);

/// What a structure does by itself on the nonlinear antenna, with its best motors where that was
/// run, else as built; empty without a run.
std::vector<design::HuntingResult> hunting_of(const MatchSection& section,
                                              const MatchSeries& series);

/// Whether by that it hunts beyond the tightest budget (design::holds_still): no structure to
/// choose, whatever its rms in wind.
bool hunts(const MatchSection& section, const MatchSeries& series);

/// Whether the linear plant has the friction slope of the curve at the tracking rate already.
bool one_friction(const MatchSection& section);

/// The point of the motors as built; the last where none is marked.
std::size_t as_built(const MatchSection& section);

}  // namespace boresight::app
