#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// Largest rms of a structure over its least, less 1, over the inertias where a controller was
/// found; 0 where none was.
double span_of(const MatchSeries& series);

/// Index of the point at which a structure's limit cycles are evaluated: its best motors if they
/// were run on the nonlinear antenna, else as built.
std::size_t limit_cycle_point(const MatchingStudy& study, const MatchSeries& series);

/// Limit-cycle runs of a structure at that point; empty without a run.
std::vector<LimitCycleResult> limit_cycle_of(const MatchingStudy& study, const MatchSeries& series);

/// True if such runs show a limit cycle beyond the allowed amplitude. False where only an
/// incomplete run leaves the question open.
bool limit_cycle_beyond(const MatchingStudy& study,
                        const std::vector<LimitCycleResult>& limit_cycles);

/// True if a structure was run at a point and not shown free of limit cycles beyond the allowed
/// amplitude (is_limit_cycle_free): by limit_cycle_beyond, or because a run did not complete.
bool has_limit_cycle_at(const MatchingStudy& study, const MatchSeries& series, std::size_t point);

/// has_limit_cycle_at its limit_cycle_point: such a structure is excluded whatever its rms in wind.
bool has_limit_cycle(const MatchingStudy& study, const MatchSeries& series);

/// True if a structure is eligible when inertias, structures and rules are compared. It has a
/// controller that meets its constraints, with no limit cycle beyond the allowed amplitude at its
/// limit_cycle_point or as built.
bool is_eligible(const MatchingStudy& study, const MatchSeries& series);

/// The same for a structure given by name; false for one that was not studied.
bool is_eligible(const MatchingStudy& study, std::string_view structure);

/// The structure that recommend chooses among those for which `counts` is true, each with its best
/// motors. A structure with limit cycles is chosen only where all have them. Null where none has a
/// controller that meets its constraints.
const MatchSeries* recommended_structure(const MatchingStudy& study,
                                         const std::function<bool(const MatchSeries&)>& counts);

/// Motors of the study with their own recommended controller, and the rms by which study_proposals
/// compares antennas.
struct RankedMotors {
  std::size_t point = 0;
  std::size_t series = 0;
  /// MatchTimeDomain::member_rms with the effect of its simulation (NonlinearEffect::rms).
  double compared_rms = 0.0;
  /// Tied with the first: within negligible_change or left_open of it.
  bool tied = false;
};

/// For each point where controllers ran in wind, the one that recommend() chooses, in order of
/// rising compared_rms. Empty where none ran.
std::vector<RankedMotors> ranked_motors(const MatchingStudy& study);

/// The eligible structure whose rms changes most over the inertias; null where none is eligible.
const MatchSeries* most_moved(const MatchingStudy& study);

/// The eligible structures that have a controller at the inertia as built.
struct StructuresAsBuilt {
  std::size_t count = 0;
  const MatchSeries* minimum = nullptr;  // by rms; null without any
  const MatchSeries* largest = nullptr;
  double change = 0.0;  // the largest rms over the least, less 1
};
StructuresAsBuilt structures_as_built(const MatchingStudy& study);

/// True if the inertia does not matter: every eligible structure has a controller at every inertia,
/// and no span reaches negligible_change. False where none is eligible.
bool hardly_matters(const MatchingStudy& study);

/// Change of the least rms of an eligible structure by one variant.
struct VariantChange {
  std::string variant, structure;  // by their names
  double change = 0.0;             // relative, its magnitude
};
/// Of all variants with a controller, in their order.
std::vector<VariantChange> variant_changes(const MatchingStudy& study);

/// Numbers of disks outside the 1 % range around the best (of a structure that has one) whose rms
/// is within 1 % of the least too. The nearest to the best comes first.
std::vector<double> as_good_elsewhere(const MatchingStudy& study, const MatchSeries& series);

/// True if an eligible structure's curve that is not flat has its minimum below the upper end of
/// the range searched. A minimum at zero disks counts as interior.
bool has_optimum(const MatchingStudy& study);

/// Cost of a rule for the eligible structures for which it is known.
struct RuleCosts {
  const MatchSeries* cheapest = nullptr;  // null without any
  const MatchSeries* dearest = nullptr;
  double minimum = 0.0, largest = 0.0;  // as RuleVerdict::cost
};
RuleCosts costs_of(const MatchingStudy& study, const RuleVerdict& rule);

/// The least friction slope that decides whether the inertia matters, over eligible structures.
/// Excluded: structures whose inertia already matters little with the linear plant's slope.
/// Excluded too: slopes beyond 1.5 times those of the linear plant and the friction curve, which
/// need no measurement. Null without one.
const FrictionThreshold* deciding_friction(const MatchingStudy& study);

/// True if the linear plant already has the friction curve's slope at the tracking rate.
bool one_friction(const MatchingStudy& study);

/// Index of the point of the motors as built; the last point where none is marked.
std::size_t as_built(const MatchingStudy& study);

}  // namespace boresight::design
