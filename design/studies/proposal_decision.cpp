#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include <boresight/design/decisions/negligible_change.hpp>
#include <boresight/design/decisions/pareto_front.hpp>
#include <boresight/design/studies/fixed_gain_candidate.hpp>
#include <boresight/design/studies/proposal_decision.hpp>
#include <boresight/design/studies/same_structure_pairs.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

// Pairs of candidates, each in one thread's hands at a time.
class Pool {
 public:
  struct Pair {
    FixedGainCandidate best, second;
  };

  Pool(const FixedGainCandidate& best, const FixedGainCandidate& second) : pattern_{best, second} {}

  std::unique_ptr<Pair> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto pair = std::move(idle_.back());
        idle_.pop_back();
        return pair;
      }
    }
    return std::make_unique<Pair>(pattern_);
  }

  void give(std::unique_ptr<Pair> pair) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(pair));
  }

 private:
  Pair pattern_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Pair>> idle_;
};

Probability fraction_of(const Eigen::ArrayXd& indicator) {
  return mean_score(indicator, DecisionOptions{}.confidence);
}

class Decision {
 public:
  Decision(const std::vector<ProposedDesign>& candidates, const plant::Antenna& as_is,
           const std::vector<const Mission*>& missions, const PlantDistribution& distribution,
           const ProposalOptions& options)
      : candidates_(candidates),
        as_is_(as_is),
        missions_(missions),
        distribution_(distribution),
        options_(options) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const CandidateController* controller = candidates[i].chosen_controller();
      if (controller == nullptr) {
        found_.left_out.push_back({i, NotDrawn::no_stable_controller});
        continue;
      }
      if (!std::isfinite(controller->simulated_to_linear_rms())) {
        found_.left_out.push_back({i, NotDrawn::run_not_completed});
        continue;
      }
      found_.candidates.push_back({i, {}, {}});
      held_.emplace_back(as_is, *missions[i], *controller);
    }
    found_.uncertain = distribution.inputs();
  }

  std::optional<ProposalDecision> run() {
    if (held_.size() < 2 || !draw_outcomes()) return std::nullopt;
    summarise();
    if (!stopped()) hold_structures_apart();
    if (!stopped()) find_what_decides();
    if (!stopped()) value_tests();
    if (stopped()) return std::nullopt;
    return std::move(found_);
  }

 private:
  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  // All candidates on the same samples. False if interrupted.
  bool draw_outcomes() {
    auto outcomes = evaluate_samples(held_, distribution_, options_);
    if (!outcomes) return false;
    rms_ = std::move(outcomes->rms);
    outside_ = std::move(outcomes->outside);
    return true;
  }

  void summarise() {
    found_.random_samples = options_.random_samples;
    for (std::size_t i = 0; i < found_.candidates.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      auto& one = found_.candidates[i];
      one.unstable = fraction_of(rms_.col(column).array().isInf().cast<double>());
      one.outside_goals = fraction_of(outside_.col(column));
    }
    found_.statistics = compare_options(rms_);
    find_front_fractions();
    rank_candidates(candidates_, found_);
  }

  void hold_structures_apart() {
    auto pairs =
        compare_by_structure(found_, rms_, candidates_, as_is_, missions_, distribution_, options_);
    if (pairs) found_.by_structure = std::move(*pairs);
  }

  const ProposedDesign& candidate(std::size_t place) const {
    return candidates_[found_.candidates[place].candidate];
  }

  // Of those with a cost that are fit to be chosen, as of the front by the plants.
  void find_front_fractions() {
    found_.front_fractions.assign(found_.candidates.size(),
                                  std::numeric_limits<double>::quiet_NaN());
    std::vector<double> costs;
    std::vector<Eigen::Index> columns;
    for (std::size_t i = 0; i < found_.candidates.size(); ++i) {
      const auto& cost = candidate(i).cost;
      if (!cost || !candidate(i).feasible()) continue;
      costs.push_back(*cost);
      columns.push_back(static_cast<Eigen::Index>(i));
    }
    if (costs.empty()) return;
    const Eigen::MatrixXd rms = rms_(Eigen::all, columns);
    const auto fractions = front_fractions(costs, rms);
    for (std::size_t k = 0; k < fractions.size(); ++k) {
      found_.front_fractions[static_cast<std::size_t>(columns[k])] = fractions[k];
    }
  }

  double difference(FixedGainCandidate& best, FixedGainCandidate& second,
                    const std::vector<double>& fractions) const {
    const auto draw = distribution_.at_fractions(fractions);
    return second.evaluate(draw).rms - best.evaluate(draw).rms;
  }

  void find_what_decides() {
    const std::size_t inputs = distribution_.inputs().size();
    if (inputs == 0) return;
    try {
      FixedGainCandidate best = held_[found_.best], second = held_[found_.second];
      found_.tornado = tornado(inputs, [&](const std::vector<double>& fractions) {
        return difference(best, second, fractions);
      });
      numerics::SobolOptions sobol;
      sobol.points = 64;
      sobol.seed = options_.seed;
      sobol.threads = options_.threads;
      Pool pool(held_[found_.best], held_[found_.second]);
      const auto function = [&](const std::vector<double>& fractions, Eigen::VectorXd& out) {
        if (stopped()) {
          out(0) = fractions[0];
          return;
        }
        auto pair = pool.take();
        out(0) = difference(pair->best, pair->second, fractions);
        pool.give(std::move(pair));
      };
      found_.sobol = numerics::sobol_indices(inputs, 1, function, sobol);
    } catch (const NumericalFailure& error) {
      found_.tornado.reset();
      found_.undecided = error.what();
    }
  }

  // Of the choice between those that are fit to be chosen; places and means are of all.
  void value_tests() {
    if (found_.uncertain.empty()) return;
    if (!candidate(found_.second).feasible()) {
      found_.tests_not_valued = TestsNotValued::fewer_than_two_fit;
      return;
    }
    std::vector<Eigen::Index> fit;
    for (std::size_t i = 0; i < found_.candidates.size(); ++i) {
      if (candidate(i).feasible()) fit.push_back(static_cast<Eigen::Index>(i));
    }
    const Eigen::MatrixXd rms = rms_(Eigen::all, fit);
    if (!rms.allFinite()) {
      found_.tests_not_valued = TestsNotValued::unstable_on_some_samples;
      return;
    }
    Eigen::MatrixXd inputs(rms_.rows(), static_cast<Eigen::Index>(found_.uncertain.size()));
    for (Eigen::Index d = 0; d < rms_.rows(); ++d) {
      const auto draw = distribution_.draw(options_.seed, static_cast<std::uint64_t>(d));
      for (Eigen::Index k = 0; k < inputs.cols(); ++k) {
        inputs(d, k) = draw[distribution_.inputs()[static_cast<std::size_t>(k)]];
      }
    }
    auto& tests = found_.tests.emplace(sample_information(inputs, rms));
    tests.choice = static_cast<std::size_t>(fit[tests.choice]);
    tests.mean_loss.clear();
    for (const auto& option : found_.statistics.options) tests.mean_loss.push_back(option.mean);
  }

  const std::vector<ProposedDesign>& candidates_;
  const plant::Antenna& as_is_;
  const std::vector<const Mission*>& missions_;
  const PlantDistribution& distribution_;
  const ProposalOptions& options_;
  std::vector<FixedGainCandidate> held_;
  Eigen::MatrixXd rms_;  // mdeg, samples x candidates
  Eigen::ArrayXXd outside_;
  ProposalDecision found_;
};

double left_open_between(const CandidateController& one, const CandidateController& other) {
  if (!one.expected || !other.expected) return 0.0;
  return left_open({*one.expected, one.effect().amplitude},
                   {*other.expected, other.effect().amplitude});
}

// Of candidates in their order, with the one of the places that is best.
std::vector<bool> tied_with(std::size_t best, const std::vector<ProposedDesign>& candidates,
                            const ProposalDecision& decision, const std::vector<bool>& fit) {
  const auto& losses = decision.ranking.losses;
  std::vector<bool> tied(fit.size());
  const CandidateController* minimum =
      candidates[decision.candidates[best].candidate].chosen_controller();
  for (std::size_t i = 0; i < fit.size(); ++i) {
    const CandidateController* controller =
        candidates[decision.candidates[i].candidate].chosen_controller();
    if (!fit[i] || !fit[best] || controller == nullptr || minimum == nullptr) continue;
    const double allowed = std::max(negligible_change, left_open_between(*minimum, *controller));
    tied[i] = losses[i] <= (1.0 + allowed) * losses[best];
  }
  return tied;
}

double cost_of(const PricedOption& option) {
  return option.cost.value_or(std::numeric_limits<double>::infinity());
}

}  // namespace

std::size_t worth_its_cost(const std::vector<PricedOption>& options, std::size_t best) {
  double minimum = std::numeric_limits<double>::infinity();
  for (const auto& option : options) {
    if (option.fit) minimum = std::min(minimum, option.loss);
  }
  std::size_t choice = best;
  bool chosen = false;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const bool alike = options[i].tied || options[i].loss <= (1.0 + negligible_change) * minimum;
    if (!options[i].fit || !alike) continue;
    const double cost = cost_of(options[i]), min_cost = cost_of(options[choice]);
    const bool cheaper = cost < min_cost;
    const bool better = cost == min_cost && options[i].loss < options[choice].loss;
    if (!chosen || cheaper || better) choice = i;
    chosen = true;
  }
  return choice;
}

void rank_candidates(const std::vector<ProposedDesign>& candidates, ProposalDecision& decision) {
  std::vector<bool> fit;
  for (const auto& one : decision.candidates) fit.push_back(candidates[one.candidate].feasible());
  decision.ranking = ranking_losses(decision.statistics.options, fit);
  const auto& losses = decision.ranking.losses;
  std::vector<std::size_t> order(losses.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(!fit[i], losses[i]); });
  decision.best = order.front();
  decision.second = order.size() > 1 ? order[1] : order.front();
  decision.tied = tied_with(decision.best, candidates, decision, fit);
  std::vector<PricedOption> priced;
  for (std::size_t i = 0; i < losses.size(); ++i) {
    priced.push_back(
        {fit[i], candidates[decision.candidates[i].candidate].cost, losses[i], decision.tied[i]});
  }
  decision.worth = worth_its_cost(priced, decision.best);
}

std::optional<ProposalDecision> decide(const std::vector<ProposedDesign>& candidates,
                                       const plant::Antenna& as_is,
                                       const std::vector<const Mission*>& missions,
                                       const PlantDistribution& distribution,
                                       const ProposalOptions& options) {
  return Decision(candidates, as_is, missions, distribution, options).run();
}

}  // namespace boresight::design
