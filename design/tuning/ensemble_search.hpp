#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/tuning/law_search.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// Reserve kept on the logarithm of every normalised constraint. With it the exact peak, which lies
/// between two grid frequencies of a check, still meets the limit.
inline constexpr double goal_reserve = 1e-6;

FeasibleSearchOptions search_options(const TuningOptions& options);

/// One controller evaluated on every plant with fixed gains.
struct HeldLaw {
  std::vector<double> point;  // logarithms of the gains
  double soft_rms = 0.0;      // rad of motor; infinity where a plant is unstable
  double worst_ratio = 0.0;   // over all plants; infinity where one is unstable
};

/// Tunes over several plants; each search uses the active plants only. Plant 0 is the problem's
/// own, the others are the ensemble members.
class EnsembleSearch {
 public:
  /// `plants` must outlive the search, which modifies them.
  EnsembleSearch(std::vector<JudgedPlant>& plants, control::LoopStructure structure,
                 const HardGoals& goals, const TuningOptions& options);

  /// Searches from a point with the plants `carried`, then evaluates the result on all plants. The
  /// worst plants that violate a constraint or exceed the objective become active, and the search
  /// repeats until there are none. Returns the best controller over all plants. If none meets every
  /// constraint, returns the one with the smallest worst ratio. Returns nothing if the point is
  /// unstable on the active plants and no stable one was found.
  std::optional<HeldLaw> hold(const std::vector<double>& point,
                              const std::vector<std::size_t>& carried);

  /// The problem's own plant and the plants whose constraints are nearly active or violated at a
  /// point, nearest first, at most `most`. A search needs these to stay near a controller that
  /// meets the constraints on all plants.
  std::vector<std::size_t> near_goals(const std::vector<double>& point, std::size_t most);

  HeldLaw judge(const std::vector<double>& point);
  /// True if `one` is better: feasible before infeasible, then lower objective rms; among
  /// infeasible ones, lower worst ratio.
  bool better(const HeldLaw& one, const HeldLaw& other) const;
  bool stable_by_eigenvalues(const std::vector<double>& point) const;
  /// Gradients of ln rms of the plants that determine the objective, one row each, for one
  /// controller.
  Eigen::MatrixXd soft_gradients(const control::ControlLaw& law) const;

  /// Plants that were active in the last hold().
  const std::vector<std::size_t>& carried() const { return carried_; }
  std::vector<std::string> carried_names() const;
  /// The search's plant set for these plants. The objective covers those of them that count for it.
  CarriedPlants carried_plants(const std::vector<std::size_t>& carried) const;
  int evaluations() const { return evaluations_; }
  int failures() const { return failures_; }
  bool stopped() const { return stopped_; }

 private:
  // Result of the last controller evaluated.
  struct Standing {
    bool stable = false;
    double rms = 0.0;
    double worst_ratio = 0.0;
    std::vector<GoalRatio> ratios;
  };
  bool carry_more(bool feasible);
  std::vector<std::size_t> by_rising_rms() const;
  std::size_t quantile_place() const;
  CarriedPlants search_set() const;

  std::vector<JudgedPlant>& plants_;
  control::LoopStructure structure_;
  HardGoals goals_;
  const TuningOptions& options_;
  std::vector<std::size_t> ensemble_;  // plants that the objective covers
  std::vector<std::size_t> carried_;
  std::vector<std::size_t> left_out_;  // plants of the largest rms, for a quantile
  std::vector<Standing> standings_;
  int evaluations_ = 0, failures_ = 0;
  bool stopped_ = false;
};

}  // namespace boresight::design
