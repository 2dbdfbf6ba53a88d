#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <boresight/design/matching/matching_curves.hpp>
#include <boresight/design/tuning/ensemble_search.hpp>

namespace boresight::design {

/// The best controller of one structure at one inertia, and the attempts to improve it.
struct MatchingCell {
  std::vector<FixedController> history;  // each better than the one before
  std::vector<std::size_t> active{0};
  unsigned version = 0;
  std::vector<unsigned> tried;      // versions of: left, right, the structures, left and right
  std::vector<double> start_costs;  // final ln rms of each random start
  double best_cold = std::numeric_limits<double>::infinity();  // ln rms
  int warm_starts = 0;
  bool searched = false;

  const FixedController* best() const { return history.empty() ? nullptr : &history.back(); }
};

/// State of a cell between two rounds, as its neighbours read it.
struct SeenCell {
  std::vector<double> point;  // empty: none
  unsigned version = 0;
};

/// One motor inertia of match_motors with its plants. It searches a controller for each structure
/// and improves it from those of its neighbours. It keeps references to its constructor arguments.
class MatchingColumn {
 public:
  /// `parts`: for each structure, those that it extends; `number`: index of the inertia.
  MatchingColumn(const MatchingTask& task, const MatchingOptions& options, const WindTable& wind,
                 const std::vector<std::vector<std::size_t>>& parts, std::size_t number);

  long evaluations() const { return evaluations_; }
  SeenCell seen(std::size_t structure) const;

  /// Random starts on the problem's plant, with the best two evaluated on all plants. Then random
  /// starts on the active plants, with the best of these evaluated on all.
  void start(std::size_t structure, int starts);

  /// Tries controllers of neighbours (null: none) and of the structures that this one extends,
  /// where they changed since the last try. Returns true if one of them improved the result.
  bool improve(std::size_t structure, const SeenCell* left, const SeenCell* right);

  /// The best controller found that is stable by eigenvalues on every plant.
  MatchedController finish(std::size_t structure);

 private:
  bool stopped() const { return search_.stop && search_.stop(); }
  control::Controller controller_of(std::size_t structure) const;
  bool stable_by_eigenvalues(const control::Controller& controller) const;
  FeasibleSearch search_on(std::size_t structure, const ActiveScenarios& active);
  void random_starts(std::size_t structure, const std::vector<std::size_t>& active, int count,
                     std::mt19937_64& generator);
  std::optional<double> attempt(std::size_t structure, const std::vector<double>& point);
  bool clearly_better(const EnsembleSearch& ensemble, const FixedController& one,
                      const FixedController& other) const;
  std::vector<std::size_t> worth_carrying(const std::vector<std::size_t>& active,
                                          const control::Controller& controller);

  const MatchingTask& task_;
  const std::vector<std::vector<std::size_t>>& parts_;
  std::size_t number_;
  std::uint64_t seed_;
  double tolerance_;
  TuningOptions search_;
  std::vector<PlantEvaluator> plants_;
  std::vector<MatchingCell> cells_;
  long evaluations_ = 0;
};

}  // namespace boresight::design
