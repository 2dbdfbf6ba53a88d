#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/tuning/law_search.hpp>
#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// What is kept in hand of every goal (of the logarithm of its ratio): the exact peak, between two
/// steps of whoever looks for it, meets the goal.
inline constexpr double goal_reserve = 1e-6;

FeasibleSearchOptions search_options(const TuningOptions& options);

/// A law judged on every plant.
struct HeldLaw {
  std::vector<double> point;  // logarithms of the gains
  double soft_rms = 0.0;      // rad of motor; infinity where a plant is unstable
  double worst_ratio = 0.0;   // over all plants; infinity where one is unstable
};

/// Tunes over several plants, carrying only those that matter. Plant 0 is the problem's own, the
/// others are the members.
class EnsembleSearch {
 public:
  /// `plants` must outlive the search, and are used by it.
  EnsembleSearch(std::vector<JudgedPlant>& plants, control::LoopStructure structure,
                 const HardGoals& goals, const TuningOptions& options);

  /// Searches from a point with some plants carried, judges the result on all, carries the worst of
  /// those that break a goal or the soft goal, and so on until none does: the best law seen on all.
  /// Where none holds every goal: the one with the least worst ratio. Nothing if the point is
  /// unstable on the carried plants and no stable one was found.
  std::optional<HeldLaw> hold(const std::vector<double>& point,
                              const std::vector<std::size_t>& carried);

  /// The problem's own plant and those that are near a goal at a point, or beyond it, nearest
  /// first, at most `most`: what a search has to carry to stay near a law that all of them hold.
  std::vector<std::size_t> near_goals(const std::vector<double>& point, std::size_t most);

  HeldLaw judge(const std::vector<double>& point);
  /// Feasible before infeasible, then by soft rms; infeasible ones by worst ratio.
  bool better(const HeldLaw& one, const HeldLaw& other) const;
  bool stable_by_eigenvalues(const std::vector<double>& point) const;
  /// Rows: gradients of ln rms of what makes the soft goal at a law.
  Eigen::MatrixXd soft_gradients(const control::ControlLaw& law) const;

  /// Of the last hold().
  const std::vector<std::size_t>& carried() const { return carried_; }
  std::vector<std::string> carried_names() const;
  /// The search's set for these; the soft goal is over those of them that count.
  CarriedPlants carried_plants(const std::vector<std::size_t>& carried) const;
  int evaluations() const { return evaluations_; }
  int failures() const { return failures_; }
  bool stopped() const { return stopped_; }

 private:
  // Of the last law judged.
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
  std::vector<std::size_t> ensemble_;  // what the soft goal is over
  std::vector<std::size_t> carried_;
  std::vector<std::size_t> left_out_;  // of the largest rms, for a quantile
  std::vector<Standing> standings_;
  int evaluations_ = 0, failures_ = 0;
  bool stopped_ = false;
};

}  // namespace boresight::design
