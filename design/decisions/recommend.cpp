#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include <boresight/design/decisions/recommend.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

struct Candidate {
  const Assessment* assessment;
  Fitness fitness;
  double figure;

  auto grade() const {
    return std::tuple(fitness, assessment->budgets_required -
                                   std::min(assessment->budgets_met, assessment->budgets_required));
  }
  // Among those of tied figures.
  auto order() const {
    return std::tuple(assessment->parts, assessment->purpose == DesignPurpose::nominal, figure,
                      std::string_view(assessment->structure));
  }
};

std::vector<Candidate> graded(std::span<const Assessment> assessments) {
  const bool simulated = std::ranges::any_of(
      assessments, [](const auto& one) { return one.simulated_rms.has_value(); });
  std::vector<Candidate> candidates;
  candidates.reserve(assessments.size());
  for (const auto& one : assessments) {
    Fitness grade = fitness(one);
    if (simulated && !one.simulated_rms) grade = std::max(grade, Fitness::not_shown);
    candidates.push_back({&one, grade, ranking_figure(one)});
  }
  return candidates;
}

bool tied(const Candidate& one, const Candidate& other, double tie) {
  return are_tied(*one.assessment, *other.assessment, tie);
}

const Candidate* best_of(const std::vector<Candidate>& candidates,
                         const RecommendOptions& options) {
  const auto accepted = [&](const Candidate& one) { return one.fitness <= options.accepted; };
  const Candidate* minimum = nullptr;
  for (const auto& one : candidates) {
    if (!accepted(one)) continue;
    if (minimum == nullptr ||
        std::tuple(one.grade(), one.figure) < std::tuple(minimum->grade(), minimum->figure)) {
      minimum = &one;
    }
  }
  const Candidate* best = minimum;
  for (const auto& one : candidates) {
    if (!accepted(one) || one.grade() != minimum->grade()) continue;
    if (!tied(one, *minimum, options.tie)) continue;
    if (one.order() < best->order()) best = &one;
  }
  return best;
}

RecommendationReason reason_against(const Candidate& rival, const Candidate& winner, double tie) {
  if (rival.fitness != winner.fitness) return RecommendationReason::fitness;
  if (rival.grade() != winner.grade()) return RecommendationReason::budgets;
  const bool alike = tied(rival, winner, tie);
  if (alike && rival.assessment->parts > winner.assessment->parts) {
    return RecommendationReason::fewer_parts;
  }
  if (alike && rival.assessment->purpose != winner.assessment->purpose) {
    return RecommendationReason::robustness;
  }
  return rival.figure > winner.figure ? RecommendationReason::figure : RecommendationReason::name;
}

}  // namespace

Recommendation recommend(std::span<const Assessment> candidates, const RecommendOptions& options) {
  if (!(options.tie >= 0.0) || !std::isfinite(options.tie)) {
    throw InvalidInput(
        fmt::format("recommend: expected a tie of at least 0, found {:g}", options.tie));
  }
  const auto all = graded(candidates);
  const Candidate* best = best_of(all, options);
  Recommendation result;
  if (best != nullptr) result.winner = static_cast<std::size_t>(best - all.data());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (result.winner == i) continue;
    RejectedController rejected{i, all[i].fitness, RecommendationReason::fitness,
                                std::numeric_limits<double>::quiet_NaN(), false};
    if (best != nullptr) {
      rejected.tied = all[i].grade() == best->grade() && tied(all[i], *best, options.tie);
      rejected.reason = reason_against(all[i], *best, options.tie);
      rejected.figure_ratio = all[i].figure / best->figure;
      result.reasons.push_back(rejected.reason);
    }
    result.rejected.push_back(rejected);
  }
  std::ranges::sort(result.reasons);
  const auto repeated = std::ranges::unique(result.reasons);
  result.reasons.erase(repeated.begin(), repeated.end());
  return result;
}

}  // namespace boresight::design
