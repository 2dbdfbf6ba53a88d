#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/app/match/match_section.hpp>

namespace boresight::app {

/// Largest rms of a structure over its least, less 1, over the inertias where a law was found; 0
/// where none was.
double span_of(const MatchSeries& series);

/// The point where a structure's hunting is judged: its best motors where those were run on the
/// nonlinear antenna, else as built.
std::size_t hunting_point(const MatchSection& section, const MatchSeries& series);

/// What a structure does there by itself; empty without a run.
std::vector<design::HuntingResult> hunting_of(const MatchSection& section,
                                              const MatchSeries& series);

/// Whether such runs show hunting beyond the tightest budget: not where that much was not seen
/// because one of them did not complete.
bool hunting_beyond(const MatchSection& section, const std::vector<design::HuntingResult>& hunting);

/// Whether a structure was run at a point and not seen to hold still there within the tightest
/// budget (design::holds_still): by hunting_beyond, or because a run did not complete.
bool hunts_at(const MatchSection& section, const MatchSeries& series, std::size_t point);

/// Whether it does so at its hunting_point: no structure to choose, whatever its rms in wind.
bool hunts(const MatchSection& section, const MatchSeries& series);

/// Whether a structure counts where inertia, structures and rules are weighed: it has a law that
/// holds its goals, and hunts beyond the tightest budget neither at its hunting_point nor as built.
bool weighed(const MatchSection& section, const MatchSeries& series);

/// The same of a structure by its name; false for one that was not studied.
bool weighed(const MatchSection& section, std::string_view structure);

/// The structure that design::recommend chooses of those that `counts` is true of, each with its
/// best motors; one that limit-cycles only where all do. Null where none has a controller that
/// meets its constraints.
const MatchSeries* recommended_structure(const MatchSection& section,
                                         const std::function<bool(const MatchSeries&)>& counts);

/// The structure weighed whose rms changes most over the inertias; null where none is weighed.
const MatchSeries* most_moved(const MatchSection& section);

/// The structures weighed that have a law at the inertia as built.
struct StructuresAsBuilt {
  std::size_t count = 0;
  const MatchSeries* least = nullptr;  // by rms; null without any
  const MatchSeries* largest = nullptr;
  double change = 0.0;  // the largest rms over the least, less 1
};
StructuresAsBuilt structures_as_built(const MatchSection& section);

/// Whether the inertia is of no account: every structure weighed has a law at every inertia, and no
/// span reaches negligible_change. False where none is weighed.
bool hardly_matters(const MatchSection& section);

/// What moves the rms by more than negligible_change instead, as Influences::sentence: the choice
/// of structure as built, and the variants, of structures weighed.
std::string what_matters_more(const MatchSection& section);

/// Whether the linear plant has the friction slope of the curve at the tracking rate already.
bool one_friction(const MatchSection& section);

/// The point of the motors as built; the last where none is marked.
std::size_t as_built(const MatchSection& section);

}  // namespace boresight::app
