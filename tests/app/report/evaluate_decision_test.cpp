#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/study_decision.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// As the study ranks them.
void rank(EvaluateSection& section) {
  design::rank_candidates({section.candidates.begin(), section.candidates.end()},
                          *section.decision);
}

// Two proposals beside the antenna as it is, by cost and mean rms over the samples.
EvaluateSection proposals_of(const std::vector<std::pair<double, double>>& costs_and_means) {
  EvaluateSection section;
  section.currency = "kEUR";
  section.wind_speed = 12.0;
  DecisionSection random_samples;
  random_samples.random_samples = 2000;
  for (std::size_t i = 0; i < costs_and_means.size(); ++i) {
    Candidate candidate;
    candidate.name = i == 0 ? "as it is" : "proposal " + std::to_string(i);
    if (i > 0) candidate.path = "proposal.toml";
    candidate.cost = costs_and_means[i].first;
    CandidateController controller;
    controller.constraints_met = true;
    controller.design.tuning.status = design::TuningStatus::optimal;
    controller.design.verification.passed = true;
    controller.member_rms = costs_and_means[i].second * millidegree;
    candidate.controllers = {controller};
    candidate.chosen = 0U;
    section.candidates.push_back(std::move(candidate));
    random_samples.candidates.push_back({.candidate = i, .unstable = {}, .outside_goals = {}});
    random_samples.statistics.options.emplace_back().mean = costs_and_means[i].second;
    if (costs_and_means[i].second < costs_and_means[random_samples.best].second)
      random_samples.best = i;
    section.front.push_back(i);
  }
  section.decision = std::move(random_samples);
  rank(section);
  return section;
}

TEST(EvaluateDecision, PaysForNothingNegligible) {
  const auto section = proposals_of({{0.0, 0.5133}, {20.0, 0.5131}});
  ASSERT_TRUE(section.decision);
  EXPECT_EQ(section.decision->worth, 0U);
  const auto decided = decision(section);
  EXPECT_THAT(decided.front(), AllOf(HasSubstr("No proposal is worth its cost"),
                                     HasSubstr("proposal 1 would be only 0.0 % better")));
  EXPECT_THAT(decided, Each(AllOf(Not(HasSubstr("Choose")), Not(HasSubstr("Pareto front")))));
  EXPECT_THAT(conclude(section), Contains(HasSubstr("no proposal is worth its cost")));
}

// The antenna as it is begins the front: what the others are compared with.
TEST(EvaluateDecision, GivesTheParetoFrontFromTheAntennaAsItIsOn) {
  const auto section = proposals_of({{0.0, 0.5}, {20.0, 0.495}, {50.0, 0.4}, {90.0, 0.3}});
  EXPECT_THAT(decision(section),
              Contains("Pareto front, each at least 2 % better than all cheaper ones: as it is (0 "
                       "kEUR, 0.500 mdeg), proposal 2 (50 kEUR, 0.400 mdeg), proposal 3 (90 kEUR, "
                       "0.300 mdeg)."));
}

// Of infinite means the cheapest is as good as any: what 95 % of the samples keep within tells
// more.
TEST(EvaluateDecision, RanksWhatIsUnstableOnSomeSamplesByWhatTheOthersKeep) {
  auto section = proposals_of({{0.0, HUGE_VAL}, {20.0, HUGE_VAL}});
  ASSERT_TRUE(section.decision);
  auto& options = section.decision->statistics.options;
  options[0].quantiles = {{0.5, 0.5, 0.5, 0.5}, {0.95, 0.9, 0.9, 0.9}};
  options[1].quantiles = {{0.5, 0.4, 0.4, 0.4}, {0.95, 0.6, 0.6, 0.6}};
  rank(section);
  EXPECT_EQ(section.decision->worth, 1U);
  EXPECT_THAT(decision(section).front(),
              AllOf(HasSubstr("Choose proposal 1: 0.600 mdeg rms at the 95 % quantile of"),
                    Not(HasSubstr("inf"))));
}

TEST(EvaluateDecision, StatesWhatTheAntennaDoesWithoutProposals) {
  auto section = proposals_of({{0.0, 0.5133}});
  section.decision.reset();
  section.ensemble_size = 30;
  section.wind_speed = 10.0;
  EXPECT_THAT(decision(section).front(),
              HasSubstr("has 0.513 mdeg rms over 30 plant models in 10 m/s"));
}

TEST(EvaluateDecision, ChoosesTheCheapestOfThoseAlike) {
  const auto section = proposals_of({{0.0, 0.64}, {60.0, 0.426}, {420.0, 0.42}});
  ASSERT_TRUE(section.decision);
  EXPECT_EQ(section.decision->worth, 1U);
  EXPECT_THAT(decision(section).front(), AllOf(HasSubstr("Choose proposal 1"),
                                               HasSubstr("proposal 2 would be only 1.4 % better")));
  EXPECT_THAT(decision(section).back(),
              AllOf(HasSubstr("proposal 1"), Not(HasSubstr("proposal 2"))));
}

TEST(EvaluateDecision, ChoosesWhatGainsEnough) {
  const auto section = proposals_of({{0.0, 0.64}, {60.0, 0.5}, {420.0, 0.42}});
  ASSERT_TRUE(section.decision);
  EXPECT_EQ(section.decision->worth, 2U);
  EXPECT_THAT(decision(section).front(), HasSubstr("Choose proposal 2"));
}

TEST(EvaluateDecision, ChoosesWithoutACostOnlyWhatNothingPricedComesNear) {
  auto section = proposals_of({{0.0, 0.64}, {60.0, 0.423}, {0.0, 0.42}});
  ASSERT_TRUE(section.decision);
  section.candidates[2].cost.reset();
  section.front = {0, 1};
  rank(section);
  EXPECT_EQ(section.decision->worth, 1U);
  EXPECT_THAT(decision(section).front(), HasSubstr("proposal 2 would be only 0.7 % better"));
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("Not on the Pareto front (no [cost] stated): proposal 2.")));
  section.decision->statistics.options[2].mean = 0.3;
  rank(section);
  EXPECT_EQ(section.decision->worth, 2U);
  EXPECT_THAT(
      decision(section).front(),
      AllOf(HasSubstr("Choose proposal 2"), HasSubstr("at a cost that its file does not state")));
}

TEST(EvaluateDecision, HasNoFrontWithoutCosts) {
  auto section = proposals_of({{0.0, 0.64}, {60.0, 0.5}});
  section.currency.clear();
  section.front.clear();
  section.candidates[1].cost.reset();
  EXPECT_THAT(conclude(section), Contains(HasSubstr("No proposal states a cost")));
  EXPECT_THAT(conclude(section), Each(Not(HasSubstr("Pareto front of cost"))));
}

TEST(EvaluateDecision, ChoosesNothingThatLimitCycles) {
  auto section = proposals_of({{0.0, 0.64}, {60.0, 0.5}, {420.0, 0.42}});
  ASSERT_TRUE(section.decision);
  const auto make_limit_cycle = [&](std::size_t i) {
    CandidateController& controller = section.candidates[i].controllers[0];
    controller.limit_cycle_free = false;
    design::LimitCycleResult rest;
    rest.limit_cycle = true;
    rest.boresight_amplitude = 3.03 * millidegree;
    controller.time_domain.emplace().limit_cycles = {rest};
    controller.time_domain->wind.boresight_rms = controller.time_domain->wind.predicted_rms =
        controller.member_rms;
  };
  make_limit_cycle(2);
  rank(section);
  EXPECT_EQ(section.decision->worth, 1U);
  EXPECT_THAT(decision(section).front(),
              AllOf(HasSubstr("Choose proposal 1"), Not(HasSubstr("proposal 2"))));
  EXPECT_THAT(decision(section),
              Contains("Excluded, as they limit-cycle beyond the allowed amplitude: proposal 2."));
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("lowered 21.9 % by proposal 1. Excluded, limit cycle beyond the "
                                 "allowed amplitude: proposal 2.")));
  EXPECT_THAT(
      conclude(section),
      Contains(HasSubstr(
          "Excluded, limit cycle beyond the allowed amplitude: proposal 2 with  (+-3.03 mdeg)")));
  make_limit_cycle(1);
  rank(section);
  EXPECT_THAT(
      decision(section).front(),
      HasSubstr("All proposals have a limit cycle beyond the allowed amplitude, unlike the antenna "
                "as it is: none is chosen. The antenna as it is has 0.640 mdeg rms"));
  make_limit_cycle(0);
  rank(section);
  const std::string none =
      "All proposals have a limit cycle beyond the allowed amplitude, as does the antenna as it "
      "is: "
      "none is chosen.";
  const auto decided = decision(section);
  EXPECT_THAT(decided.front(),
              AllOf(StartsWith(none + " proposal 2 comes nearest"),
                    HasSubstr("but has a limit cycle beyond the allowed amplitude")));
  EXPECT_THAT(decided, Each(Not(HasSubstr("probability"))));
  const auto sentences = conclude(section);
  EXPECT_EQ(sentences.front(), none);
  EXPECT_THAT(sentences,
              Each(AllOf(Not(HasSubstr("no proposal lowers it")), Not(HasSubstr("Lowest rms")))));
}

TEST(EvaluateDecision, NamesTheTestThatIsWorthItsTime) {
  auto section = proposals_of({{0.0, 0.64}, {60.0, 0.5}});
  section.decision->inputs = {"leakage rate", "oil stiffness"};
  design::SampleInformation tests{
      .choice = 1, .mean_loss = {0.64, 0.5}, .perfect = {.gain = 0.02}, .inputs = {}};
  tests.inputs = {{.fitted = {.gain = 0.001}, .held_out_gain = 0.0, .held_out_error = 0.001},
                  {.fitted = {.gain = 0.012}, .held_out_gain = 0.01, .held_out_error = 0.001}};
  section.decision->tests = tests;
  EXPECT_THAT(conclude(section),
              Contains("Test first: oil stiffness. Known before the choice, it lowers the expected "
                       "rms by 0.0100 to 0.0120 mdeg (held out and fitted); perfect information "
                       "lowers it by 0.0200 mdeg."));
  // All that could be known is worth less than what decides nothing.
  section.decision->tests->perfect.gain = 0.004;
  section.decision->tests->inputs[1].held_out_gain = 0.003;
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("perfect information lowers it by 0.0040 mdeg, 0.80 % of the rms: "
                                 "no test is worth its time for this choice.")));
  section.decision->tests->inputs[1].held_out_error = 0.002;
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("No test of a single input significantly improves")));
}

TEST(EvaluateDecision, NamesProposalsThatDifferNegligibly) {
  const auto alike = proposals_of({{0.0, 0.5133}, {20.0, 0.5131}});
  EXPECT_THAT(decision(alike), Contains(HasSubstr("choose by their other effects")));
  // One alone is like no other: nothing is said of all.
  auto single = alike;
  single.candidates[1].controllers[0].constraints_met = false;
  EXPECT_THAT(decision(single), Each(Not(HasSubstr("choose by their other effects"))));
  const auto apart = proposals_of({{0.0, 0.64}, {60.0, 0.5}});
  EXPECT_THAT(decision(apart), Contains(HasSubstr("violates a constraint on a fraction of")));
}

}  // namespace
}  // namespace boresight::app
