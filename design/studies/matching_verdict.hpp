#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// Largest rms of a structure over its least, less 1, over the inertias where a law was found; 0
/// where none was.
double span_of(const MatchSeries& series);

/// The point where a structure's hunting is judged: its best motors where those were run on the
/// nonlinear antenna, else as built.
std::size_t hunting_point(const MatchingStudy& study, const MatchSeries& series);

/// What a structure does there by itself; empty without a run.
std::vector<HuntingResult> hunting_of(const MatchingStudy& study, const MatchSeries& series);

/// Whether such runs show hunting beyond the tightest budget: not where that much was not seen
/// because one of them did not complete.
bool hunting_beyond(const MatchingStudy& study, const std::vector<HuntingResult>& hunting);

/// Whether a structure was run at a point and not seen to hold still there within the tightest
/// budget (holds_still): by hunting_beyond, or because a run did not complete.
bool hunts_at(const MatchingStudy& study, const MatchSeries& series, std::size_t point);

/// Whether it does so at its hunting_point: no structure to choose, whatever its rms in wind.
bool hunts(const MatchingStudy& study, const MatchSeries& series);

/// Whether a structure counts where inertia, structures and rules are weighed: it has a law that
/// holds its goals, and hunts beyond the tightest budget neither at its hunting_point nor as built.
bool weighed(const MatchingStudy& study, const MatchSeries& series);

/// The same of a structure by its name; false for one that was not studied.
bool weighed(const MatchingStudy& study, std::string_view structure);

/// The structure that recommend chooses of those that `counts` is true of, each with its
/// best motors; one that limit-cycles only where all do. Null where none has a controller that
/// meets its constraints.
const MatchSeries* recommended_structure(const MatchingStudy& study,
                                         const std::function<bool(const MatchSeries&)>& counts);

/// Motors of the study with their own recommended controller, by what study_proposals compares
/// antennas by.
struct RankedMotors {
  std::size_t point = 0;
  std::size_t series = 0;
  /// MatchTimeDomain::member_rms with the effect of its simulation (NonlinearEffect::rms).
  double compared_rms = 0.0;
  /// With the first: within negligible_change or left_open of it.
  bool tied = false;
};

/// Of each point where controllers ran in wind the one that recommend() chooses, least compared_rms
/// first. Empty where none ran.
std::vector<RankedMotors> ranked_motors(const MatchingStudy& study);

/// The structure weighed whose rms changes most over the inertias; null where none is weighed.
const MatchSeries* most_moved(const MatchingStudy& study);

/// The structures weighed that have a law at the inertia as built.
struct StructuresAsBuilt {
  std::size_t count = 0;
  const MatchSeries* least = nullptr;  // by rms; null without any
  const MatchSeries* largest = nullptr;
  double change = 0.0;  // the largest rms over the least, less 1
};
StructuresAsBuilt structures_as_built(const MatchingStudy& study);

/// Whether the inertia is of no account: every structure weighed has a law at every inertia, and no
/// span reaches negligible_change. False where none is weighed.
bool hardly_matters(const MatchingStudy& study);

/// What one variant does to the least rms of its structure, which is weighed.
struct VariantChange {
  std::string variant, structure;  // by their names
  double change = 0.0;             // relative, its magnitude
};
/// Of all variants with a law, in their order.
std::vector<VariantChange> variant_changes(const MatchingStudy& study);

/// Numbers of disks beyond the range within 1 % of the least rms of a structure that has one where
/// its rms is within 1 % too, the nearest to its best first.
std::vector<double> as_good_elsewhere(const MatchingStudy& study, const MatchSeries& series);

/// Whether the curve of a structure weighed that is not flat has its least below the upper end of
/// the range looked at. Fewer disks than none there are not.
bool has_optimum(const MatchingStudy& study);

/// What a rule costs the structures weighed for which that is known.
struct RuleCosts {
  const MatchSeries* cheapest = nullptr;  // null without any
  const MatchSeries* dearest = nullptr;
  double least = 0.0, largest = 0.0;  // as RuleVerdict::cost
};
RuleCosts costs_of(const MatchingStudy& study, const RuleVerdict& rule);

/// The least friction slope that decides whether the inertia matters, of structures weighed: not
/// where it matters little with the slope of the linear plant already, nor a slope beyond 1.5 times
/// those of the linear plant and the friction curve, which is no question to be measured. Null
/// without one.
const FrictionThreshold* deciding_friction(const MatchingStudy& study);

/// Whether the linear plant has the friction slope of the curve at the tracking rate already.
bool one_friction(const MatchingStudy& study);

/// The point of the motors as built; the last where none is marked.
std::size_t as_built(const MatchingStudy& study);

}  // namespace boresight::design
