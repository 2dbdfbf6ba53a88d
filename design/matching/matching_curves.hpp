#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// One antenna with a range of motor inertias, each tuned in several loop structures.
struct MatchingTask {
  TrackingProblem problem;
  /// Uncertainty set of plants, with the problem's own motor inertia. Empty: every controller is
  /// tuned on the problem's plant alone.
  std::vector<EnsembleMember> members;
  /// Values of Drive::motor_inertia (kg m2), rising. That of each member changes in proportion.
  std::vector<double> motor_inertia;
  std::vector<control::LoopStructure> structures;
  Constraints goals;
  Objective objective;
};

struct MatchingOptions {
  /// Random starts per controller, half on the problem's plant alone, half with the active members.
  int starts = 4;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Relative rms improvement that a controller needs to replace another. Below it two searches
  /// count as having found the same.
  double tolerance = 1e-4;
  /// Called with the numbers of steps done and known so far, under a lock.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
  /// Polled from any thread; true ends the work with the best controllers found so far.
  std::function<bool()> stop = {};
};

/// The best controller found for one structure and motor inertia.
struct MatchedController {
  TuningStatus status = TuningStatus::unstable;
  control::Controller controller;      // without gains where status is unstable
  control::LoopEvaluation evaluation;  // on the problem's plant
  double soft_rms = 0.0;               // rad of motor
  double worst_constraint = 0.0;       // over all plants; infinity where unstable
  /// Constraints within 1e-4 of their limits, with their plants; without shadow prices.
  std::vector<ActiveConstraint> active_constraints;
  std::vector<std::string> gains_at_bound;
  std::vector<std::string> active_scenarios;
  int starts = 0;                    // random starts
  int starts_at_optimum = 0;         // of these, within 1 % of the best controller's rms
  int warm_starts = 0;               // from neighbours and structures that this one extends
  double gain_by_warm_starts = 0.0;  // of ln rms, over the best random start
  bool searched = false;             // false: an interrupt came before it
};

struct MatchingCurve {
  control::LoopStructure structure;
  std::vector<MatchedController> controllers;  // one per motor inertia
};

struct MatchingCurves {
  std::vector<MatchingCurve> curves;  // one per structure
  double tolerance = 0.0;             // as in the options
  int rounds = 0;
  /// In the last round no warm start improved a controller by more than the tolerance.
  bool settled = false;
  bool interrupted = false;
  long evaluations = 0;
};

/// Tunes every structure at every motor inertia. It begins with random starts. Rounds of warm
/// starts follow until none improves: from the controllers at both neighbouring inertias, and from
/// the structures that this one extends at the same inertia (transferred_gains).
/// The plants of an inertia are made once for all structures. A search uses the active members only
/// (EnsembleSearch); its result is evaluated on all. The winning controllers are checked by
/// eigenvalues on every plant. The result does not depend on the number of threads.
/// @throws InvalidInput without inertias or structures, for inertias that do not rise or are not
/// positive, a structure given twice, options below 1 (tolerance: not within (0, 0.1)), and as
/// validate(goals).
MatchingCurves match_motors(const MatchingTask& task, const MatchingOptions& options);

}  // namespace boresight::design
