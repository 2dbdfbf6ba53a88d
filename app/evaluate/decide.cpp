#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/evaluate/held_candidate.hpp>
#include <boresight/app/evaluate/pairs_by_structure.hpp>
#include <boresight/app/uncertainty/distribution_source.hpp>
#include <boresight/design/decisions/pareto_front.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// Pairs of candidates, each in one thread's hands at a time.
class Pool {
 public:
  struct Pair {
    HeldCandidate best, second;
  };

  Pool(const HeldCandidate& best, const HeldCandidate& second) : pattern_{best, second} {}

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

design::Probability share_of(const Eigen::ArrayXd& indicator) {
  return design::mean_score(indicator, design::DecisionOptions{}.confidence);
}

class Decision {
 public:
  Decision(const std::vector<Candidate>& candidates, const std::vector<io::Case>& cases,
           const design::PlantDistribution& distribution, const EvaluateOptions& options)
      : candidates_(candidates), cases_(cases), distribution_(distribution), options_(options) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const CandidateLaw* law = candidates[i].chosen_law();
      if (law == nullptr) {
        section_.notes.push_back(
            fmt::format("{} has no stable law and is left out.", candidates[i].name));
        continue;
      }
      if (!std::isfinite(law->nonlinear_factor())) {
        section_.notes.push_back(
            fmt::format("{} did not complete its run on the nonlinear antenna and is left out.",
                        candidates[i].name));
        continue;
      }
      section_.candidates.push_back({i, {}, {}});
      held_.emplace_back(cases.front(), cases[i], *law);
    }
    for (const auto input : distribution.inputs()) section_.inputs.emplace_back(to_string(input));
  }

  DecisionSection run() {
    if (held_.size() < 2 || !draw_outcomes()) return {};
    summarise();
    if (!stopped()) hold_structures_apart();
    if (!stopped()) find_what_decides();
    if (!stopped()) value_tests();
    if (stopped()) return {};
    return std::move(section_);
  }

 private:
  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  // All candidates on the same draws. False if interrupted.
  bool draw_outcomes() {
    auto outcomes = judge_draws(held_, distribution_, options_);
    if (!outcomes) return false;
    rms_ = std::move(outcomes->rms);
    outside_ = std::move(outcomes->outside);
    return true;
  }

  void summarise() {
    section_.draws = options_.draws;
    section_.source = source_text(distribution_);
    for (std::size_t i = 0; i < section_.candidates.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      auto& one = section_.candidates[i];
      one.unstable = share_of(rms_.col(column).array().isInf().cast<double>());
      one.outside_goals = share_of(outside_.col(column));
    }
    section_.statistics = design::compare_options(rms_);
    find_front_shares();
    const auto& options = section_.statistics.options;
    std::vector<std::size_t> order(options.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
      return std::pair(!candidate(i).feasible(), options[i].mean);
    });
    section_.best = order[0];
    section_.second = order[1];
  }

  void hold_structures_apart() {
    auto pairs = compare_by_structure(section_, rms_, candidates_, cases_, distribution_, options_);
    if (pairs) section_.by_structure = std::move(*pairs);
  }

  const Candidate& candidate(std::size_t place) const {
    return candidates_[section_.candidates[place].candidate];
  }

  // Of those with a cost that are fit to be chosen, as of the front by the plants.
  void find_front_shares() {
    section_.front_shares.assign(section_.candidates.size(),
                                 std::numeric_limits<double>::quiet_NaN());
    std::vector<double> costs;
    std::vector<Eigen::Index> columns;
    for (std::size_t i = 0; i < section_.candidates.size(); ++i) {
      const auto& cost = candidate(i).cost;
      if (!cost || !candidate(i).feasible()) continue;
      costs.push_back(*cost);
      columns.push_back(static_cast<Eigen::Index>(i));
    }
    if (costs.empty()) return;
    const Eigen::MatrixXd rms = rms_(Eigen::all, columns);
    const auto shares = design::front_shares(costs, rms);
    for (std::size_t k = 0; k < shares.size(); ++k) {
      section_.front_shares[static_cast<std::size_t>(columns[k])] = shares[k];
    }
  }

  double difference(HeldCandidate& best, HeldCandidate& second,
                    const std::vector<double>& shares) const {
    const auto draw = distribution_.at_shares(shares);
    return second.judge(draw).rms - best.judge(draw).rms;
  }

  void find_what_decides() {
    const std::size_t inputs = distribution_.inputs().size();
    if (inputs == 0) {
      section_.notes.emplace_back("Nothing of the plant is uncertain: no input decides anything.");
      return;
    }
    try {
      HeldCandidate best = held_[section_.best], second = held_[section_.second];
      section_.tornado = design::tornado(inputs, [&](const std::vector<double>& shares) {
        return difference(best, second, shares);
      });
      numerics::SobolOptions sobol;
      sobol.points = 64;
      sobol.seed = options_.seed;
      sobol.threads = options_.threads;
      Pool pool(held_[section_.best], held_[section_.second]);
      const auto function = [&](const std::vector<double>& shares, Eigen::VectorXd& out) {
        if (stopped()) {
          out(0) = shares[0];
          return;
        }
        auto pair = pool.take();
        out(0) = difference(pair->best, pair->second, shares);
        pool.give(std::move(pair));
      };
      section_.sobol = numerics::sobol_indices(inputs, 1, function, sobol);
    } catch (const NumericalFailure& error) {
      section_.tornado.reset();
      section_.notes.push_back(
          fmt::format("What decides between the two best is not known: {}", error.what()));
    }
  }

  // Of the choice between those that are fit to be chosen; places and means are of all.
  void value_tests() {
    if (section_.inputs.empty()) return;
    if (!candidate(section_.second).feasible()) {
      section_.notes.emplace_back(
          "Tests are not valued: fewer than two candidates are fit to be chosen, and there is no "
          "choice for a test to change.");
      return;
    }
    std::vector<Eigen::Index> fit;
    for (std::size_t i = 0; i < section_.candidates.size(); ++i) {
      if (candidate(i).feasible()) fit.push_back(static_cast<Eigen::Index>(i));
    }
    const Eigen::MatrixXd rms = rms_(Eigen::all, fit);
    if (!rms.allFinite()) {
      section_.notes.emplace_back(
          "Tests are not valued: a candidate is unstable on some draws, and no finite loss can "
          "stand for that.");
      return;
    }
    Eigen::MatrixXd inputs(rms_.rows(), static_cast<Eigen::Index>(section_.inputs.size()));
    for (Eigen::Index d = 0; d < rms_.rows(); ++d) {
      const auto draw = distribution_.draw(options_.seed, static_cast<std::uint64_t>(d));
      for (Eigen::Index k = 0; k < inputs.cols(); ++k) {
        inputs(d, k) = draw[distribution_.inputs()[static_cast<std::size_t>(k)]];
      }
    }
    auto& tests = section_.tests.emplace(design::test_value(inputs, rms));
    tests.choice = static_cast<std::size_t>(fit[tests.choice]);
    tests.mean_loss.clear();
    for (const auto& option : section_.statistics.options) tests.mean_loss.push_back(option.mean);
  }

  const std::vector<Candidate>& candidates_;
  const std::vector<io::Case>& cases_;
  const design::PlantDistribution& distribution_;
  const EvaluateOptions& options_;
  std::vector<HeldCandidate> held_;
  Eigen::MatrixXd rms_;  // mdeg, draws x candidates
  Eigen::ArrayXXd outside_;
  DecisionSection section_;
};

}  // namespace

DecisionSection decide(const std::vector<Candidate>& candidates, const std::vector<io::Case>& cases,
                       const design::PlantDistribution& distribution,
                       const EvaluateOptions& options) {
  return Decision(candidates, cases, distribution, options).run();
}

}  // namespace boresight::app
