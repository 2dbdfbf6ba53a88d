#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/studies/fixed_controller.hpp"
#include <boresight/design/studies/proposal_decision.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;

ProposedDesign candidate_of(const std::string& name, double first, double second,
                            std::size_t chosen) {
  ProposedDesign candidate;
  candidate.name = name;
  candidate.changed = name != "as it is";
  candidate.controllers = {reference::fixed_controller("PI", first),
                           reference::fixed_controller("DPF", second)};
  candidate.chosen = chosen;
  return candidate;
}

// One plant for all, so that means over the samples scale with the factors of the controllers.
std::optional<ProposalDecision> decided(const std::vector<ProposedDesign>& candidates,
                                        const Mission& mission = reference::uncertain_mission()) {
  ProposalOptions options;
  options.random_samples = 100;
  return decide(candidates, mission.antenna, {candidates.size(), &mission},
                PlantDistribution::of_ranges(mission), options);
}

TEST(Decide, ComparesWithOneStructureOnBothOverTheSameSamples) {
  const auto decision =
      decided({candidate_of("as it is", 1.0, 0.9, 0), candidate_of("no flywheels", 1.1, 0.95, 1)});
  ASSERT_TRUE(decision);
  ASSERT_EQ(decision->by_structure.size(), 1U);
  const auto& found = decision->by_structure[0].structures;
  ASSERT_EQ(found.size(), 2U);
  const double mean = decision->statistics.options[0].mean;
  EXPECT_EQ(found[0].structure, "PI");
  EXPECT_NEAR(found[0].mean_gain, 0.1 * mean, 1e-9 * mean);
  EXPECT_EQ(found[1].structure, "DPF");
  EXPECT_NEAR(found[1].mean_gain, 0.05 * mean, 1e-9 * mean);
  EXPECT_GT(found[1].better.value, 0.95);
}

TEST(Decide, LeavesOutPairsThatTheChosenControllersHoldApartAlready) {
  const auto decision =
      decided({candidate_of("as it is", 1.0, 0.9, 0), candidate_of("no flywheels", 1.1, 0.95, 0)});
  ASSERT_TRUE(decision);
  EXPECT_TRUE(decision->by_structure.empty());
}

TEST(Decide, SaysWhomItLeavesOutAndWhy) {
  auto lost = candidate_of("lost", 1.0, 1.0, 0);
  lost.controllers[0].time_domain->wind.boresight_rms = std::numeric_limits<double>::quiet_NaN();
  auto none = candidate_of("none", 1.0, 1.0, 0);
  none.chosen.reset();
  const auto decision = decided(
      {candidate_of("as it is", 1.0, 1.0, 0), lost, candidate_of("better", 0.9, 0.9, 0), none});
  ASSERT_TRUE(decision);
  ASSERT_EQ(decision->left_out.size(), 2U);
  EXPECT_EQ(decision->left_out[0].candidate, 1U);
  EXPECT_EQ(decision->left_out[0].reason, NotDrawn::run_not_completed);
  EXPECT_EQ(decision->left_out[1].reason, NotDrawn::no_stable_controller);
  EXPECT_EQ(decision->candidates[decision->best].candidate, 2U);
  EXPECT_THAT(decision->uncertain,
              ElementsAre(UncertainInput::oil_stiffness, UncertainInput::leakage_rate));
  EXPECT_FALSE(decided({lost, none, candidate_of("as it is", 1.0, 1.0, 0)}));
}

// Fitness comes before the rms, also where nothing is left to choose between.
TEST(Decide, PutsWhatIsFitFirst) {
  auto unfit = candidate_of("unfit", 0.5, 0.5, 0);
  unfit.controllers[0].constraints_met = false;
  const auto decision = decided({candidate_of("as it is", 1.0, 1.0, 0), unfit});
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->best, 0U);
  EXPECT_EQ(decision->worth, 0U);
  EXPECT_EQ(decision->tests_not_valued, TestsNotValued::fewer_than_two_fit);
  EXPECT_FALSE(decision->tests);
}

// Unstable on some samples, both have infinite means: that of less rms is chosen, not the first.
TEST(Decide, TellsApartWhatIsUnstableOnSomeSamples) {
  Mission mission = reference::uncertain_mission();
  mission.uncertainty.ranges.structure_frequency.lower = 0.3;
  mission.uncertainty.ranges.oil_stiffness.lower = 0.05;
  auto cheap = candidate_of("as it is", 1.0, 1.0, 0), dear = candidate_of("better", 0.9, 0.9, 0);
  cheap.cost = 0.0;
  dear.cost = 1.0;
  const auto decision = decided({cheap, dear}, mission);
  ASSERT_TRUE(decision);
  for (const auto& one : decision->candidates) EXPECT_GT(one.unstable.value, 0.0);
  EXPECT_EQ(decision->statistics.options[1].mean, std::numeric_limits<double>::infinity());
  EXPECT_NE(decision->ranking.measure, LossMeasure::mean);
  EXPECT_EQ(decision->best, 1U);
  EXPECT_EQ(decision->worth, 1U);
}

TEST(WorthItsCost, IsTheCheapestWithinWhatDecidesNothing) {
  const std::vector<PricedOption> options{
      {true, 0.0, 1.03}, {true, 5.0, 1.015}, {true, 9.0, 1.0}, {false, 1.0, 0.5}};
  EXPECT_EQ(worth_its_cost(options, 2), 1U);
  // Without a cost it is dearer than any.
  EXPECT_EQ(worth_its_cost({{true, std::nullopt, 1.0}, {true, 1e9, 1.01}}, 0), 1U);
  // At one price the better one.
  EXPECT_EQ(worth_its_cost({{true, 1.0, 1.01}, {true, 1.0, 1.0}}, 1), 1U);
  EXPECT_EQ(worth_its_cost({{false, 0.0, 1.0}, {false, 0.0, 2.0}}, 0), 0U);
}

TEST(WorthItsCost, IsTheCheapestOfThoseTiedWithTheBest) {
  const std::vector<PricedOption> options{
      {true, 0.0, 1.05, true}, {true, 5.0, 1.03, false}, {true, 9.0, 1.0, true}};
  EXPECT_EQ(worth_its_cost(options, 2), 0U);
  EXPECT_EQ(worth_its_cost({{false, 0.0, 1.05, true}, {true, 9.0, 1.0, true}}, 1), 1U);
}

TEST(CandidateController, IsComparedWithItsLimitCycleInQuadrature) {
  CandidateController controller = reference::fixed_controller("PI", 1.2);
  controller.member_rms = 0.4;
  EXPECT_NEAR(controller.compared_rms(), 0.48, 1e-12);
  LimitCycleResult rest;
  rest.limit_cycle = true;
  rest.boresight_amplitude = 0.34;
  controller.time_domain->limit_cycles = {rest};
  EXPECT_NEAR(controller.compared_rms(), std::hypot(0.48, 0.34 / std::sqrt(2.0)), 1e-12);
  // Several records count before the one.
  controller.time_domain->wind.predicted_rms = 1.0;
  controller.expected.emplace().rms.value = 1.1;
  EXPECT_NEAR(controller.compared_rms(), std::hypot(0.44, 0.34 / std::sqrt(2.0)), 1e-12);
  controller.expected->rms.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(controller.compared_rms(), std::numeric_limits<double>::infinity());
}

// The controller of ten records of wind whose mean squares differ from the linear loop's in turns.
void in_records(CandidateController& controller, double rms, double scatter) {
  controller.time_domain->wind.predicted_rms = 1.0;
  SimulatedRms& expected = controller.expected.emplace();
  expected.records = 10;
  expected.winds = 10;
  expected.linear_mean_squares = Eigen::VectorXd::LinSpaced(10, 0.8, 1.2);
  expected.mean_squares = rms * rms * expected.linear_mean_squares;
  for (Eigen::Index i = 0; i < 10; ++i) expected.mean_squares[i] += i % 2 == 0 ? scatter : -scatter;
  expected.rms.value = rms;
}

TEST(Decide, TakesWhatTheSameWindsLeaveOpenForATie) {
  for (const double scatter : {1e-4, 0.3}) {
    std::vector candidates{candidate_of("as it is", 1.0, 1.0, 0),
                           candidate_of("no flywheels", 1.0, 1.0, 0)};
    candidates[0].cost = 0.0;
    candidates[1].cost = 10.0;
    in_records(candidates[0].controllers[0], 1.04, 0.0);
    in_records(candidates[1].controllers[0], 1.0, scatter);
    const auto decision = decided(candidates);
    ASSERT_TRUE(decision);
    EXPECT_EQ(decision->best, 1U);
    EXPECT_EQ(decision->tied[0], scatter > 0.1);
    EXPECT_EQ(decision->worth, scatter > 0.1 ? 0U : 1U);
  }
}

}  // namespace
}  // namespace boresight::design
