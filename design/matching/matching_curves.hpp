#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// One antenna with other and other motors, each tuned in several loop structures.
struct MatchingTask {
  TrackingProblem problem;
  /// Plants that may be the true one, with the problem's own motor inertia; none: every law is
  /// tuned on the problem's plant alone.
  std::vector<EnsembleMember> members;
  /// What takes the place of Drive::motor_inertia (kg m2), rising; that of each member changes in
  /// proportion.
  std::vector<double> motor_inertia;
  std::vector<control::LoopStructure> structures;
  HardGoals goals;
  SoftGoal soft_goal;
};

struct MatchingOptions {
  /// Random starts of every law, half on the problem's plant alone, half with the members that
  /// matter.
  int starts = 4;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// What a law must gain in rms, relative, to take the place of another: below it two searches
  /// count as having found the same.
  double tolerance = 1e-4;
  /// Called with steps done and all that are certain by now, under a lock.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
  /// Asked now and then, from any thread; true ends the work with the best laws found so far.
  std::function<bool()> stop = {};
};

/// The best law found for one structure and motor inertia.
struct MatchedLaw {
  TuningStatus status = TuningStatus::unstable;
  control::ControlLaw law;             // without gains where status is unstable
  control::LoopEvaluation evaluation;  // on the problem's plant
  double soft_rms = 0.0;               // rad of motor
  double worst_goal_ratio = 0.0;       // over all plants; infinity where unstable
  /// Goals met with less than 1e-4 to spare, and on which plant; without prices.
  std::vector<LimitingGoal> active_goals;
  std::vector<std::string> gains_at_bound;
  std::vector<std::string> carried_members;
  int starts = 0;                    // random ones
  int starts_at_optimum = 0;         // that ended within 1 % of the rms of the best law
  int warm_starts = 0;               // from neighbours and structures that this one extends
  double gain_by_warm_starts = 0.0;  // of ln rms, over the best random start
  bool searched = false;             // an interrupt came before it
};

struct MatchingCurve {
  control::LoopStructure structure;
  std::vector<MatchedLaw> laws;  // one a motor inertia
};

struct MatchingCurves {
  std::vector<MatchingCurve> curves;  // one a structure
  double tolerance = 0.0;             // as the options have it
  int rounds = 0;
  /// The last round found nothing better than the tolerance by any of its warm starts.
  bool settled = false;
  bool interrupted = false;
  long evaluations = 0;
};

/// Tunes every structure at every motor inertia: random starts, then round after round warm starts
/// from the laws at both neighbouring inertias and from the structures that this one extends at the
/// same inertia (transferred_gains), until none gains.
/// The plants of an inertia are made once and serve all structures; a search carries only members
/// that matter (EnsembleSearch), and judges its result on all. The winning laws are checked by
/// eigenvalues on every plant. The same for any number of threads.
/// @throws InvalidInput without inertias or structures, for inertias that do not rise or are not
/// positive, a structure given twice, options below 1 (tolerance: not within (0, 0.1)), and as
/// validate(goals).
MatchingCurves match_motors(const MatchingTask& task, const MatchingOptions& options);

}  // namespace boresight::design
