#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/tuning/controller_search.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// Reserve kept on the logarithm of every normalised constraint. With it the exact peak, which lies
/// between two grid frequencies of a check, still meets the limit.
inline constexpr double goal_reserve = 1e-6;

FeasibleSearchOptions search_options(const TuningOptions& options);

/// One controller evaluated on every plant with fixed gains.
struct FixedController {
  std::vector<double> point;  // logarithms of the gains
  double soft_rms = 0.0;      // rad of motor; infinity where a plant is unstable
  double worst_ratio = 0.0;   // over all plants; infinity where one is unstable
};

/// Tunes over several plants; each search uses the active plants only. Plant 0 is the problem's
/// own, the others are the ensemble members.
class EnsembleSearch {
 public:
  /// `plants` must outlive the search, which modifies them.
  EnsembleSearch(std::vector<PlantEvaluator>& plants, control::LoopStructure structure,
                 Constraints goals, const TuningOptions& options);

  /// Searches from a point with the plants `active`, then evaluates the result on all plants. The
  /// worst plants that violate a constraint or exceed the objective become active, and the search
  /// repeats until there are none. Returns the best controller over all plants. If none meets every
  /// constraint, returns the one with the smallest worst ratio. Returns nothing if the point is
  /// unstable on the active plants and no stable one was found.
  std::optional<FixedController> hold(const std::vector<double>& point,
                                      const std::vector<std::size_t>& active);

  /// The problem's own plant and the plants whose constraints are nearly active or violated at a
  /// point, nearest first, at most `maximum`. A search needs these to stay near a controller that
  /// meets the constraints on all plants.
  std::vector<std::size_t> near_goals(const std::vector<double>& point, std::size_t maximum);

  FixedController evaluate(const std::vector<double>& point);
  /// True if `one` is better: feasible before infeasible, then lower objective rms; among
  /// infeasible ones, lower worst ratio.
  bool better(const FixedController& one, const FixedController& other) const;
  bool stable_by_eigenvalues(const std::vector<double>& point) const;
  /// Gradients of ln rms of the plants that determine the objective, one row each, for one
  /// controller.
  Eigen::MatrixXd soft_gradients(const control::Controller& controller) const;

  /// Plants that were active in the last hold().
  const std::vector<std::size_t>& active() const { return active_; }
  std::vector<std::string> active_names() const;
  /// The search's plant set for these plants. The objective covers those of them that count for it.
  ActiveScenarios active_scenarios(const std::vector<std::size_t>& active) const;
  int evaluations() const { return evaluations_; }
  int failures() const { return failures_; }
  bool stopped() const { return stopped_; }

 private:
  // Result of the last controller evaluated.
  struct MemberState {
    bool stable = false;
    double rms = 0.0;
    double worst_ratio = 0.0;
    std::vector<NormalisedConstraint> ratios;
  };
  bool carry_more(bool feasible);
  std::vector<std::size_t> by_rising_rms() const;
  std::size_t quantile_place() const;
  ActiveScenarios search_set() const;

  std::vector<PlantEvaluator>& plants_;
  control::LoopStructure structure_;
  Constraints goals_;
  const TuningOptions& options_;
  std::vector<std::size_t> ensemble_;  // plants that the objective covers
  std::vector<std::size_t> active_;
  std::vector<std::size_t> left_out_;  // plants of the largest rms, for a quantile
  std::vector<MemberState> member_states_;
  int evaluations_ = 0, failures_ = 0;
  bool stopped_ = false;
};

}  // namespace boresight::design
