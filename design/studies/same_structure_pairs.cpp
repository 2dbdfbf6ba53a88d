#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <boresight/design/studies/fixed_gain_candidate.hpp>
#include <boresight/design/studies/same_structure_pairs.hpp>

namespace boresight::design {
namespace {

// A controller of that structure that can be evaluated on samples; none where none was tuned.
std::optional<std::size_t> controller_of(const ProposedDesign& candidate,
                                         const std::string& structure) {
  const auto found =
      std::ranges::find(candidate.controllers, structure, &CandidateController::structure);
  if (found == candidate.controllers.end() || !found->stable() ||
      !std::isfinite(found->simulated_to_linear_rms())) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - candidate.controllers.begin());
}

// Columns of rms by candidate and controller; those that the choice has not evaluated yet are held
// here.
class Columns {
 public:
  Columns(const ProposalDecision& decision, Eigen::MatrixXd rms,
          const std::vector<ProposedDesign>& candidates)
      : candidates_(candidates), rms_(std::move(rms)) {
    for (const auto& one : decision.candidates) {
      keys_.emplace_back(one.candidate, candidates[one.candidate].chosen.value_or(0));
    }
  }

  Eigen::Index column(std::size_t candidate, std::size_t controller, const plant::Antenna& as_is,
                      const Mission& mission) {
    const std::pair key(candidate, controller);
    const auto found = std::ranges::find(keys_, key);
    const auto place = static_cast<Eigen::Index>(found - keys_.begin());
    if (found == keys_.end()) {
      keys_.push_back(key);
      held_.emplace_back(as_is, mission, candidates_[candidate].controllers[controller]);
    }
    return place;
  }

  bool evaluate(const PlantDistribution& distribution, const ProposalOptions& options) {
    if (held_.empty()) return true;
    const auto outcomes = evaluate_samples(held_, distribution, options);
    if (!outcomes) return false;
    Eigen::MatrixXd all(rms_.rows(), rms_.cols() + outcomes->rms.cols());
    all << rms_, outcomes->rms;
    rms_ = std::move(all);
    return true;
  }

  PairComparison compare(Eigen::Index first, Eigen::Index second) const {
    const Eigen::MatrixXd two = rms_(Eigen::all, std::array{first, second});
    return compare_options(two).pairs.front();
  }

 private:
  const std::vector<ProposedDesign>& candidates_;
  Eigen::MatrixXd rms_;  // mdeg
  std::vector<std::pair<std::size_t, std::size_t>> keys_;
  std::vector<FixedGainCandidate> held_;
};

struct Comparison {
  std::size_t pair = 0;
  std::size_t first_controller = 0, second_controller = 0;
  Eigen::Index first = 0, second = 0;  // columns
};

}  // namespace

std::optional<std::vector<PairByStructure>> compare_by_structure(
    const ProposalDecision& decision, const Eigen::MatrixXd& rms,
    const std::vector<ProposedDesign>& candidates, const plant::Antenna& as_is,
    const std::vector<const Mission*>& missions, const PlantDistribution& distribution,
    const ProposalOptions& options) {
  std::vector<PairByStructure> pairs;
  std::vector<Comparison> comparisons;
  Columns columns(decision, rms, candidates);
  for (const auto& pair : decision.statistics.pairs) {
    const std::size_t i = decision.candidates[pair.first].candidate;
    const std::size_t k = decision.candidates[pair.second].candidate;
    const ProposedDesign& first = candidates[i];
    const ProposedDesign& second = candidates[k];
    const CandidateController* first_controller = first.chosen_controller();
    const CandidateController* second_controller = second.chosen_controller();
    if (first_controller == nullptr || second_controller == nullptr) continue;
    const bool one_antenna = !first.changed && !second.changed;
    if (first_controller->structure == second_controller->structure || one_antenna) continue;
    for (const auto& structure : {first_controller->structure, second_controller->structure}) {
      const auto one = controller_of(first, structure), other = controller_of(second, structure);
      if (!one || !other) continue;
      const Eigen::Index of_first = columns.column(i, *one, as_is, *missions[i]);
      comparisons.push_back(
          {pairs.size(), *one, *other, of_first, columns.column(k, *other, as_is, *missions[k])});
    }
    pairs.push_back({pair.first, pair.second, {}});
  }
  if (!columns.evaluate(distribution, options)) return std::nullopt;
  for (const auto& one : comparisons) {
    PairByStructure& pair = pairs[one.pair];
    const auto& first =
        candidates[decision.candidates[pair.first].candidate].controllers[one.first_controller];
    const auto& second =
        candidates[decision.candidates[pair.second].candidate].controllers[one.second_controller];
    const auto compared = columns.compare(one.first, one.second);
    pair.structures.push_back({first.structure, compared.better, compared.mean_gain,
                               compared.gain_error, first.usable(), second.usable()});
  }
  return pairs;
}

}  // namespace boresight::design
