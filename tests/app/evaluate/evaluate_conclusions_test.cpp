// What the conclusions of an evaluation say of drives, of motions and of needed budgets.
#include <string>
#include <utility>
#include <vector>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/evaluate/evaluate_section.hpp>
#include <boresight/app/evaluate/proposal_effects.hpp>
#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

Candidate candidate_of(const std::string& name, double slew_margin) {
  Candidate candidate;
  candidate.name = name;
  if (name != "as it is") candidate.path = name + ".toml";
  candidate.figures.emplace();
  candidate.figures->slew_rate_margin = slew_margin;
  return candidate;
}

std::string concluded(const std::vector<Candidate>& candidates) {
  EvaluateSection section;
  section.candidates = candidates;
  return fmt::format("{}", fmt::join(conclude(section), " "));
}

TEST(EvaluateConclusions, BlameAProposalForTheSlewRateThatItTakes) {
  EXPECT_THAT(
      concluded({candidate_of("as it is", 1.2), candidate_of("large motors", 0.85)}),
      AllOf(HasSubstr("Unable to sustain the present slew rate against friction and offset: large "
                      "motors (0.85 of the slew rate). The cost of larger pumps and valves"),
            Not(HasSubstr("the stated slew rate"))));
  EXPECT_THAT(concluded({candidate_of("as it is", 1.2), candidate_of("no flywheels", 1.2)}),
              Not(HasSubstr("slew rate")));
}

TEST(EvaluateConclusions, DoNotBlameProposalsForASlewRateOutOfReach) {
  EXPECT_THAT(concluded({candidate_of("as it is", 0.66), candidate_of("no flywheels", 0.66),
                         candidate_of("more pressure", 0.75)}),
              AllOf(HasSubstr("The drive as it is cannot reach the stated slew rate: against "
                              "friction and offset it sustains 0.66 of it. Check drive.slew_rate"),
                    Not(HasSubstr("pumps and valves")), Not(HasSubstr("present"))));
  EXPECT_THAT(concluded({candidate_of("as it is", 0.66), candidate_of("no flywheels", 0.66),
                         candidate_of("large motors", 0.47)}),
              AllOf(HasSubstr("The drive as it is cannot reach the stated slew rate"),
                    HasSubstr("Still slower slewing: large motors (0.47 of the slew rate). The "
                              "cost of larger pumps and valves")));
}

Candidate moving(const std::string& name, double acceleration, double reversal) {
  Candidate candidate = candidate_of(name, 1.2);
  candidate.figures->slew.emplace().reachable_acceleration = acceleration * degree;
  CandidateController controller;
  controller.design.tuning.status = design::TuningStatus::optimal;
  controller.time_domain.emplace().reversal.emplace().boresight_error = reversal * millidegree;
  candidate.controllers = {controller};
  candidate.chosen = 0U;
  return candidate;
}

TEST(EvaluateConclusions, SayWhatAProposalDoesToReversalsAndAcceleration) {
  const auto base = moving("as it is", 0.1, 5.0);
  EXPECT_THAT(concluded({base, moving("no flywheels", 0.15, 5.2), moving("filter", 0.1, 3.0)}),
              AllOf(HasSubstr("5.00 mdeg as it is; filter 3.00 mdeg (-40 %)."),
                    HasSubstr("0.100 deg/s2 as it is; no flywheels 0.150 deg/s2 (+50 %).")));
  EXPECT_THAT(concluded({base, moving("half the flywheels", 0.109, 4.6)}),
              AllOf(Not(HasSubstr("velocity reversal")), Not(HasSubstr("Acceleration"))));
}

// kr, wi, wp, kp, wip.
Candidate with_gains(Candidate candidate, const std::vector<double>& gains) {
  CandidateController& controller = candidate.controllers.front();
  controller.structure = "PI";
  controller.design.tuning.controller = {control::LoopStructure::named("PI"), gains};
  return candidate;
}

TEST(EvaluateConclusions, TellControllersOfOneStructureThatAreOfAnotherFamily) {
  const auto controller = [](const std::vector<double>& gains) {
    return with_gains(moving("a", 0.1, 5.0), gains).controllers.front();
  };
  const CandidateController own = controller({0.133, 0.255, 3.28, 30.0, 0.262});
  const CandidateController bare = controller({0.126, 30.0, 12.4, 3.11, 0.324});
  EXPECT_THAT(other_family(bare, own), testing::ElementsAre(1U, 3U));
  EXPECT_THAT(other_family(own, bare), testing::ElementsAre(1U, 3U));
  EXPECT_THAT(other_family(own, controller({0.133, 0.255, 3.28, 6.1, 1.3})), testing::IsEmpty());
  CandidateController other = bare;
  other.structure = "DPF";
  EXPECT_THAT(other_family(other, own), testing::IsEmpty());
}

TEST(EvaluateConclusions, SayWhatOfAReversalMayBeTheControllers) {
  const std::vector<double> slow{0.133, 0.255, 3.28, 30.0, 0.262};
  const std::vector<double> fast{0.126, 30.0, 12.4, 3.11, 0.324};
  const auto base = with_gains(moving("as it is", 0.1, 2.68), slow);
  EXPECT_THAT(
      concluded({base, with_gains(moving("no flywheels", 0.3, 1.89), fast),
                 with_gains(moving("larger valve", 0.1, 2.0), slow)}),
      AllOf(HasSubstr("no flywheels has a different kind of PI controller from the antenna as it "
                      "is: wi 30 against 0.255 rad/s, kp 3.11 against 30 1/s. Differences in "
                      "reversal error and limit cycle may come from the controller, not the "
                      "hardware. Narrow the search with [[tuning.bound]], or the bounds of a "
                      "[[loop]], to obtain one kind. Acceleration available"),
            Not(HasSubstr("larger valve has"))));
  // Only the rms is told of it.
  auto level = with_gains(moving("no flywheels", 0.1, 2.6), fast);
  EXPECT_THAT(concluded({base, level}), Not(HasSubstr("different kind")));
  auto& cycle = level.controllers.front().time_domain->limit_cycles.emplace_back();
  cycle.limit_cycle = true;
  cycle.boresight_amplitude = 0.2 * millidegree;
  EXPECT_THAT(concluded({base, level}), HasSubstr("no flywheels has a different kind"));
}

TEST(EvaluateConclusions, CompareNothingWhereNoProposalIsFit) {
  auto base = moving("as it is", 0.1, 5.0);
  base.controllers.front().time_domain.reset();
  EXPECT_THAT(concluded({base, candidate_of("no flywheels", 1.2)}),
              HasSubstr("mdeg): no eligible proposal to compare."));
}

TEST(EvaluateConclusions, SayWhatSpeedsAreOnTheMast) {
  EvaluateSection section;
  section.ensemble_size = 30;
  section.wind_mast = plant::WindMast{10.0, 28.0, 0.14, 1.155};
  section.budgets.resize(1);
  section.budgets[0].name = "tracking";
  section.budgets[0].wind_speed = 8.08537;
  section.candidates.push_back(moving("as it is", 0.1, 5.0));
  section.candidates.back().controllers[0].budgets_met = {12};
  EXPECT_THAT(conclude(section),
              AllOf(Contains(HasSubstr("divide by 1.155 for the case's 10 m mast.")),
                    Contains(HasSubstr("is met in 8.09 m/s at the dish, 7 at the mast by as it is "
                                       "on 12."))));
}

TEST(EvaluateConclusions, SayOnHowManyPlantsANeededBudgetIsMet) {
  EvaluateSection section;
  section.ensemble_size = 30;
  section.budgets.resize(2);
  section.budgets[0].name = "tracking";
  section.budgets[0].band = "Ka";
  section.budgets[0].rms = 0.5 * millidegree;
  section.budgets[0].wind_speed = 12.0;
  for (const auto& [name, met] : {std::pair("as it is", 12), std::pair("no flywheels", 25)}) {
    section.candidates.push_back(moving(name, 0.1, 5.0));
    section.candidates.back().controllers[0].budgets_met = {met, std::nullopt};
  }
  EXPECT_THAT(conclude(section), Contains("Ensemble of 30 plants: tracking (Ka: 0.500 mdeg) is met "
                                          "in 12 m/s by as it is on 12, no flywheels on 25."));
}

TEST(EvaluateConclusions, SayThatNoCandidateMeetsANeededBudget) {
  const auto told = [](double proposal_speed, bool limit_cycle_free, double as_it_is = 8.0) {
    EvaluateSection section;
    design::PointingBudget& budget = section.budgets.emplace_back();
    budget.name = "tracking";
    budget.band = "Ka";
    budget.rms = 0.5 * millidegree;
    budget.wind_speed = 12.0;
    section.candidates = {moving("as it is", 0.1, 5.0), moving("no flywheels", 0.1, 5.0)};
    for (auto& candidate : section.candidates) {
      CandidateController& controller = candidate.controllers[0];
      controller.constraints_met = controller.design.verification.passed = true;
      candidate.figures->speed_limits = {as_it_is};
    }
    section.candidates[1].controllers[0].limit_cycle_free = limit_cycle_free;
    section.candidates[1].figures->speed_limits = {proposal_speed};
    return unmet_needs(section);
  };
  EXPECT_THAT(told(12.0, true), testing::IsEmpty());
  EXPECT_THAT(told(11.0, true),
              testing::ElementsAre(AllOf(HasSubstr("NOT MET: tracking (Ka: 0.500 mdeg) is needed "
                                                   "up to 12 m/s"),
                                         HasSubstr("no flywheels comes nearest, with 11.0 m/s"))));
  // A tie is none that one wins.
  EXPECT_THAT(told(11.0, true, 10.85),
              testing::ElementsAre(EndsWith("comes nearest, with 11.0 m/s (and within 2 % of it as "
                                            "it is).")));
  EXPECT_THAT(told(11.0, true, 10.7), testing::ElementsAre(EndsWith("with 11.0 m/s.")));
  // What limit-cycles meets nothing.
  EXPECT_THAT(told(13.0, false),
              testing::ElementsAre(HasSubstr("as it is comes nearest, with 8.0 m/s")));
}

// Candidates fit to be chosen or limit-cycling, by mean rms over the samples and the probability to
// be best.
struct Drawn {
  double mean;
  double best;
  bool limit_cycle_free;
};

EvaluateSection drawn(const std::vector<Drawn>& all, std::size_t best, std::size_t second) {
  EvaluateSection section;
  DecisionSection random_samples;
  for (std::size_t i = 0; i < all.size(); ++i) {
    section.candidates.push_back(
        moving(i == 0 ? "as it is" : fmt::format("proposal {}", i), 0.1, 5.0));
    CandidateController& controller = section.candidates.back().controllers[0];
    controller.constraints_met = controller.design.verification.passed = true;
    controller.limit_cycle_free = all[i].limit_cycle_free;
    random_samples.candidates.push_back({.candidate = i, .unstable = {}, .outside_goals = {}});
    auto& option = random_samples.statistics.options.emplace_back();
    option.mean = all[i].mean;
    option.best.value = all[i].best;
    option.expected_regret = 0.25;
  }
  random_samples.front_fractions.resize(all.size());
  random_samples.best = best;
  random_samples.second = second;
  auto& pair = random_samples.statistics.pairs.emplace_back();
  pair.first = best;
  pair.second = second;
  section.decision = std::move(random_samples);
  design::rank_candidates({section.candidates.begin(), section.candidates.end()},
                          *section.decision);
  return section;
}

TEST(EvaluateConclusions, HoldNoChoiceAgainstWhatIsLeftOut) {
  const auto told = [](const EvaluateSection& section) {
    return fmt::format("{}", fmt::join(conclude(section), " "));
  };
  EXPECT_THAT(
      told(drawn({{1.03, 0.1, true}, {1.02, 0.9, true}}, 1, 0)),
      AllOf(HasSubstr("Lowest rms with fixed gains: proposal 1, 1.0200 mdeg on average. It is the "
                      "best of all with probability 0.900"),
            HasSubstr("and better than as it is with probability"),
            HasSubstr("Expected regret against perfect information: 0.2500 mdeg. Intervals")));
  const auto limit_cycles = drawn({{1.03, 0.0, true}, {1.02, 0.0, true}, {0.77, 1.0, false}}, 1, 0);
  EXPECT_THAT(told(limit_cycles),
              AllOf(HasSubstr("among eligible proposals: proposal 1, 1.0200 mdeg on average. It is "
                              "better than as it is with probability"),
                    HasSubstr("proposal 2 has the lowest rms of all, 0.7700 mdeg on average, but "
                              "has a limit cycle beyond the allowed amplitude and is excluded. The "
                              "probabilities to be best and the regrets above include it."),
                    Not(HasSubstr("Expected regret")), Not(HasSubstr("the best of all"))));
  EXPECT_THAT(told(drawn({{1.03, 0.0, true}, {0.7, 0.8, true}, {0.77, 0.2, false}}, 1, 0)),
              HasSubstr("Expected regret against perfect information: 0.2500 mdeg (ineligible "
                        "proposals included: proposal 2)."));
  EXPECT_THAT(told(drawn({{1.03, 0.0, true}, {0.77, 1.0, false}}, 0, 1)),
              AllOf(HasSubstr("as it is, 1.0300 mdeg on average. proposal 1 has"),
                    Not(HasSubstr("better than"))));
  EXPECT_THAT(to_text(document_of(limit_cycles, *limit_cycles.decision)),
              HasSubstr("include ineligible proposals: proposal"));
}

TEST(EvaluateConclusions, NameGainsThatOnlyTheBoundsOfTheSearchHold) {
  Candidate candidate = moving("as it is", 0.1, 5.0);
  CandidateController& controller = candidate.controllers[0];
  controller.structure = "PI+C";
  auto& tuning = controller.design.tuning;
  tuning.controller.structure = control::LoopStructure::named("PI+C");
  for (const auto& gain : tuning.controller.structure.gains())
    tuning.controller.gains.push_back(gain.upper);
  tuning.gains_at_bound = {"compliance"};
  EXPECT_THAT(concluded({candidate}),
              HasSubstr("The search ended at the upper bound of the compliance, cs = 0.1 "
                        "rad/(N.m), with as it is (PI+C): widen it with "));
  EXPECT_THAT(concluded({candidate}), testing::Not(HasSubstr("kp*kr")));
  candidate.controllers[0].design.tuning.gains_at_bound = {"position gain"};
  EXPECT_THAT(concluded({candidate}),
              HasSubstr("only kp*kr matters, not a sound cascade: check with `boresight tune`."));
}

}  // namespace
}  // namespace boresight::app
