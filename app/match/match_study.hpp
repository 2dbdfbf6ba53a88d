#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/app/match/match_section.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// At which numbers of disks laws are run on the nonlinear antenna: all; 0 disks, ratio 1 and as
/// built; none.
enum class MatchTimeRuns { none, few, all };

struct MatchOptions {
  std::vector<std::string> structures;  // empty: as the case has it, or the usual six and its own
  int points = 25;                      // evenly spaced in disks, beside ratio 1 and as built
  double most_disks = 0.0;              // 0: as the case has it
  int starts = 4;
  MatchTimeRuns time_runs = MatchTimeRuns::few;
  bool variants = true;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// What is being done, steps done and all steps of it; called from any thread, under a lock.
  std::function<void(std::string_view work, std::size_t done, std::size_t all)> progress;
  /// Asked now and then, from any thread; true ends the work with what is whole by then.
  std::function<bool()> interrupted;
};

/// Every structure tuned robustly at every motor inertia, looked at from every side, and judged.
/// The same for any number of threads.
/// @throws InvalidInput for structures that are none or asked for twice, fewer than 4 points, a
/// most_disks that is negative, and as design::match_motors.
MatchSection match_motors(const io::Case& antenna,
                          const std::vector<design::EnsembleMember>& members,
                          const MatchOptions& options);

/// The least of a curve over the axis, and the range around it within `share` of that least. NaN
/// values are gaps that end the range.
std::optional<std::size_t> least_of(const std::vector<double>& values);
FlatRange flat_range(const std::vector<double>& axis, const std::vector<double>& values,
                     double share);

/// What else the optimum depends on: coarser studies on single plants, the friction that makes the
/// inertia unimportant, for the best PI structure of the section and the best of all.
void vary(const io::Case& antenna, const MatchOptions& options, MatchSection& section);

/// The classic rules against the curves.
std::vector<RuleVerdict> judge_rules(const io::Case& antenna, const MatchSection& section);

/// The controller for the motors as built, in a sentence; empty where it was not asked for.
std::string recommended_as_built(const MatchSection& section);

/// A few sentences that say what the numbers mean, with their conditions.
std::vector<std::string> conclude(const MatchSection& section);

}  // namespace boresight::app
