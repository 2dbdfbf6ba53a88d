#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/decisions/recommend.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Assessment fit_controller(std::string name, double rms, std::size_t parts) {
  Assessment one;
  one.structure = std::move(name);
  one.purpose = DesignPurpose::robust;
  one.parts = parts;
  one.stable = one.verified = true;
  one.nominal_constraints_met = one.member_constraints_met = true;
  one.linear_rms = rms;
  return one;
}

Assessment simulated(Assessment one, double rms, double amplitude) {
  one.simulated_rms = rms;
  one.limit_cycle_amplitude = amplitude;
  one.limit_cycles = LimitCycleVerdict::allowed;
  return one;
}

// One controller for each fitness, in its order, all of the same rms.
std::vector<Assessment> one_of_each_fitness() {
  std::vector<Assessment> all(9, simulated(fit_controller("PI", 1.0, 3), 1.0, 0.0));
  all[1].budgets_required = 1;
  all[2].member_constraints_met = false;
  all[3].limit_cycles = LimitCycleVerdict::not_shown;
  all[4].limit_cycles = LimitCycleVerdict::not_allowed;
  all[5].simulated_rms = std::numeric_limits<double>::quiet_NaN();
  all[6].nominal_constraints_met = false;
  all[7].verified = false;
  all[8].stable = false;
  return all;
}

TEST(Fitness, FollowsItsDocumentedOrder) {
  const auto all = one_of_each_fitness();
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(fitness(all[i]), static_cast<Fitness>(i));
}

TEST(Fitness, IsDecidedByTheWorstDeficiency) {
  Assessment one = fit_controller("PI", 1.0, 3);
  one.budgets_required = 1;
  one.member_constraints_met = false;
  EXPECT_EQ(fitness(one), Fitness::misses_member);
  one.limit_cycles = LimitCycleVerdict::not_allowed;
  EXPECT_EQ(fitness(one), Fitness::limit_cycle);
  one.stable = false;
  EXPECT_EQ(fitness(one), Fitness::unstable);
}

TEST(RankingFigure, AddsTheLimitCycleAsTheRmsOfASinusoid) {
  const auto one = fit_controller("PI", 1.0, 3);
  EXPECT_DOUBLE_EQ(ranking_figure(one), 1.0);
  EXPECT_DOUBLE_EQ(ranking_figure(simulated(one, 3.0, 0.0)), 3.0);
  EXPECT_DOUBLE_EQ(ranking_figure(simulated(one, 3.0, 4.0 * std::sqrt(2.0))), 5.0);
}

TEST(CountBudget, HoldsTheLargerRmsWithTheLimitCycleAgainstIt) {
  const auto met = [](double linear, double rms, double amplitude) {
    auto one = simulated(fit_controller("PI", linear, 3), rms, amplitude);
    count_budget(0.527, one);
    EXPECT_EQ(one.budgets_required, 1U);
    return one.budgets_met == 1;
  };
  // Of 0.527 an rms of 0.4 leaves a limit cycle of sqrt(2 (0.527^2 - 0.4^2)) = 0.4853.
  EXPECT_TRUE(met(0.39, 0.4, 0.485));
  EXPECT_FALSE(met(0.39, 0.4, 0.486));
  EXPECT_FALSE(met(0.41, 0.4, 0.485));
  EXPECT_FALSE(met(0.39, std::numeric_limits<double>::quiet_NaN(), 0.0));
  auto hidden = simulated(fit_controller("PI", 0.4, 3), 0.4, 0.0);
  hidden.limit_cycles = LimitCycleVerdict::not_shown;
  count_budget(0.527, hidden);
  EXPECT_EQ(hidden.budgets_met, 0U);
}

// Ten records about a mean square of 1, of which each differs from the linear loop's by `scatter`
// in turns, and 100 winds; the rms of all is `scale`.
Assessment in_records(std::string name, std::size_t parts, double scale, double scatter) {
  SimulatedRms expected;
  expected.records = 10;
  expected.winds = 100;
  expected.linear_mean_squares =
      scale * scale * Eigen::VectorXd::LinSpaced(100, 0.8, 1.2).reverse();
  expected.mean_squares = expected.linear_mean_squares.head(10);
  for (Eigen::Index i = 0; i < 10; ++i) expected.mean_squares[i] += i % 2 == 0 ? scatter : -scatter;
  expected.rms.value = scale;
  auto one = simulated(fit_controller(std::move(name), scale, parts), scale, 0.0);
  one.expected = expected;
  return one;
}

TEST(Recommend, TakesWhatTheSameWindsLeaveOpenForATie) {
  // 5 % apart: more than the tie, less than records that scatter by a fifth tell.
  const std::vector open{in_records("LL", 5, 1.0, 0.0), in_records("PI", 3, 1.05, 0.2)};
  ASSERT_TRUE(figure_change(open[0], open[1]));
  const auto result = recommend(open);
  EXPECT_EQ(result.winner, 1U);
  EXPECT_TRUE(result.rejected.front().tied);
  EXPECT_EQ(result.rejected.front().reason, RecommendationReason::fewer_parts);
  // Those that scatter little tell them apart, and ten winds without records of the same decide
  // nothing more than the tie does.
  const std::vector apart{in_records("LL", 5, 1.0, 0.0), in_records("PI", 3, 1.05, 0.001)};
  EXPECT_EQ(recommend(apart).winner, 0U);
  EXPECT_FALSE(recommend(apart).rejected.front().tied);
  auto other_winds = open;
  other_winds[1].expected->seed = 2;
  EXPECT_EQ(recommend(other_winds).winner, 0U);
}

TEST(Recommend, PutsEveryFitnessBeforeAnyAdvantageInRms) {
  RecommendOptions any;
  any.accepted = Fitness::unstable;
  auto all = one_of_each_fitness();
  double rms = 1.0;
  for (auto& one : all) {
    one.linear_rms = rms;
    if (std::isfinite(*one.simulated_rms)) one.simulated_rms = rms;
    rms /= 10.0;
  }
  for (std::size_t first = 0; first < all.size(); ++first) {
    EXPECT_EQ(recommend(std::span(all).subspan(first), any).winner, 0U) << first;
  }
}

TEST(Recommend, HasNoWinnerWhenNothingIsStableOrAccepted) {
  EXPECT_EQ(recommend({}).winner, std::nullopt);
  const auto all = one_of_each_fitness();
  const auto result = recommend(std::span(all).subspan(3));
  EXPECT_EQ(result.winner, std::nullopt);
  EXPECT_THAT(result.reasons, IsEmpty());
  ASSERT_EQ(result.rejected.size(), 6U);
  EXPECT_EQ(result.rejected.back().fitness, Fitness::unstable);
  EXPECT_TRUE(std::isnan(result.rejected.back().figure_ratio));
}

TEST(Recommend, GivesTiesToFewerParts) {
  const std::vector all{fit_controller("LL", 1.0, 5), fit_controller("PI", 1.0199, 3),
                        fit_controller("PI-0", 1.0201, 2)};
  const auto result = recommend(all);
  EXPECT_EQ(result.winner, 1U);
  EXPECT_THAT(result.reasons,
              ElementsAre(RecommendationReason::figure, RecommendationReason::fewer_parts));
  EXPECT_EQ(result.rejected[0].reason, RecommendationReason::fewer_parts);
  EXPECT_DOUBLE_EQ(result.rejected[0].figure_ratio, 1.0 / 1.0199);
  EXPECT_EQ(result.rejected[1].reason, RecommendationReason::figure);
}

TEST(Recommend, TakesTheLeastFigureAmongTiesOfEqualParts) {
  EXPECT_EQ(
      recommend(std::vector{fit_controller("A", 1.01, 3), fit_controller("B", 1.0, 3)}).winner, 1U);
}

TEST(Recommend, PrefersARobustDesignAmongTies) {
  std::vector all{fit_controller("PI", 1.0, 3), fit_controller("PI", 1.01, 3)};
  all[0].purpose = DesignPurpose::nominal;
  const auto result = recommend(all);
  EXPECT_EQ(result.winner, 1U);
  EXPECT_THAT(result.reasons, ElementsAre(RecommendationReason::robustness));
}

TEST(Recommend, TakesTheLeastFigureWithoutATie) {
  const std::vector all{fit_controller("PI", 1.0001, 3), fit_controller("LL", 1.0, 5)};
  EXPECT_EQ(recommend(all, {.tie = 0.0}).winner, 1U);
}

TEST(Recommend, DoesNotDependOnTheOrderOfCandidates) {
  std::vector all{fit_controller("A", 1.0, 5), fit_controller("B", 1.019, 3),
                  fit_controller("C", 1.019, 3), fit_controller("D", 1.03, 2),
                  fit_controller("E", 0.5, 1)};
  all.back().stable = false;
  const auto name = [](const Assessment& x, const Assessment& y) {
    return x.structure < y.structure;
  };
  do {
    const auto winner = recommend(all).winner;
    ASSERT_TRUE(winner);
    EXPECT_EQ(all[*winner].structure, "B");
  } while (std::ranges::next_permutation(all, name).found);
}

TEST(Recommend, KeepsAWinnerThatImproves) {
  for (const double rms : {1.019, 1.0, 0.98, 0.5}) {
    EXPECT_EQ(
        recommend(std::vector{fit_controller("LL", 1.0, 5), fit_controller("PI", rms, 3)}).winner,
        1U);
  }
}

TEST(Recommend, DoesNotChangeWithTheUnitOfAngle) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const std::vector all{simulated(fit_controller("LL", unit, 5), unit, 0.5 * unit),
                          simulated(fit_controller("PI", unit, 3), 1.05 * unit, 0.1 * unit)};
    EXPECT_EQ(recommend(all).winner, 1U);  // hypot(1, 0.354) = 1.0607, hypot(1.05, 0.071) = 1.0524
  }
}

TEST(Recommend, PutsMoreBudgetsMetBeforeATie) {
  std::vector all{fit_controller("LL", 1.19, 5), fit_controller("PI", 1.2, 3)};
  all[0].budgets_required = all[1].budgets_required = 2;
  all[0].budgets_met = 1;
  const auto result = recommend(all);
  EXPECT_EQ(result.winner, 0U);
  EXPECT_THAT(result.reasons, ElementsAre(RecommendationReason::budgets));
}

TEST(Recommend, DoesNotTrustAnUnsimulatedControllerBesideSimulatedOnes) {
  std::vector all{fit_controller("LL", 0.5, 5), simulated(fit_controller("PI", 1.0, 3), 1.1, 0.0)};
  const auto result = recommend(all);
  EXPECT_EQ(result.winner, 1U);
  EXPECT_EQ(result.rejected[0].fitness, Fitness::not_shown);
  all[1].limit_cycles = LimitCycleVerdict::not_allowed;
  EXPECT_EQ(recommend(all).winner, std::nullopt);
}

TEST(Recommend, RejectsAnInvalidTie) {
  EXPECT_THROW(recommend({}, {.tie = -0.01}), InvalidInput);
  EXPECT_THROW(recommend({}, {.tie = std::numeric_limits<double>::infinity()}), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
