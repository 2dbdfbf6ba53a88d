// What is said of tuned controllers against budgets, on the nonlinear antenna and at bounds of the
// search.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/study_decision.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A study in 12 m/s with a budget of 1.2 mdeg that is needed up to there.
TuneSection section_with_need() {
  TuneSection section;
  section.wind_speeds = {12.0};
  design::PointingBudget budget;
  budget.name = "need";
  budget.band = "Ka";
  budget.rms = 1.2 * millidegree;
  budget.wind_speed = 12.0;
  section.budgets = {budget};
  return section;
}

// One of its controllers, good in all by the linear plant.
TunedController controller_of(const std::string& structure, TunedFor purpose, double rms_mdeg) {
  TunedController controller;
  controller.structure = structure;
  controller.tuned_for = purpose;
  controller.wind_speed = 12.0;
  controller.constraints_met = true;
  controller.design.tuning.status = design::TuningStatus::optimal;
  controller.design.verification.passed = true;
  controller.boresight_rms = rms_mdeg * millidegree;
  controller.speed_limits = {12.0 * 1.2 / rms_mdeg};
  return controller;
}

// A robust one that ran on the nonlinear antenna, where it limit-cycles; in mdeg.
TunedController controller_in_time(const std::string& structure, double rms, double limit_cycles,
                                   double simulated) {
  TunedController controller = controller_of(structure, TunedFor::robust, rms);
  controller.in_time = {limit_cycles < 1.0, limit_cycles * millidegree, simulated * millidegree};
  return controller;
}

// Of 30 ensemble members, some within an rms of 2.1 mdeg and the others of 2.5.
design::EnsembleResult ensemble_with(int within) {
  design::EnsembleResult ensemble;
  for (int i = 0; i < 30; ++i) {
    design::MemberResult member;
    member.stable = true;
    member.boresight_rms = (i < within ? 2.1 : 2.5) * millidegree;
    ensemble.members.push_back(member);
  }
  return ensemble;
}

// On the nonlinear antenna the best controller of the linear plant limit-cycles; LL points a little
// better than PI, and limit-cycles a little more. The lead of LL does nothing in a controller of
// 0.02 s.
TuneSection section_of_two_alike() {
  TuneSection section = section_with_need();
  section.budgets.front().rms = 2.444 * millidegree;
  section.problem.delay = 0.03;
  section.controllers = {controller_in_time("PI", 2.1276, 0.4246, 2.1552),
                         controller_in_time("LL", 2.1303, 0.4375, 2.1461),
                         controller_in_time("DPF+C", 0.8822, 12.03, 3.1527)};
  section.controllers[0].ensemble = ensemble_with(27);
  section.controllers[1].ensemble = ensemble_with(28);
  section.controllers[2].ensemble = ensemble_with(30);
  auto& tuning = section.controllers[1].design.tuning;
  tuning.controller.structure = control::LoopStructure::named("LL");
  for (const auto& gain : tuning.controller.structure.gains())
    tuning.controller.gains.push_back(gain.upper);
  tuning.gains_at_bound = {"rate lead corner"};
  return section;
}

TEST(TuneVerdict, HoldsABudgetAgainstAControllerThatIsGoodForAllPlants) {
  TuneSection section = section_with_need();
  section.controllers = {controller_of("PI", TunedFor::nominal, 1.1),
                         controller_of("PI", TunedFor::robust, 1.3)};
  // The nominal controller may be unstable on another plant: it meets nothing.
  ASSERT_EQ(best_controller(section, 12.0), &section.controllers[1]);
  EXPECT_EQ(best_controller(section, 10.0), nullptr);
  const auto shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(shortfalls[0].closest, HasSubstr("PI (robust) comes nearest with 1.3000 mdeg"));
  EXPECT_THAT(shortfalls[0].closest, HasSubstr("met up to 11.1 m/s."));
  section.climate = {{5.0, 9.0}, {15.0, 1.0}};
  EXPECT_THAT(find_shortfalls(section)[0].closest, HasSubstr("11.1 m/s (90 % of the time)."));
  section.controllers[1].boresight_rms = 1.15 * millidegree;
  design::EnsembleResult ensemble;
  for (const double rms : {1.15, 1.19, 1.23}) {
    design::MemberResult member;
    member.stable = true;
    member.boresight_rms = rms * millidegree;
    ensemble.members.push_back(member);
  }
  section.controllers[1].ensemble = ensemble;
  EXPECT_TRUE(find_shortfalls(section).empty());
  EXPECT_THAT(conclude(section),
              Contains(AllOf(HasSubstr("The budget 'need' in band Ka (1.2000 mdeg) is met"),
                             HasSubstr("meets it on 2 of 3 plants"))));
}

TEST(TuneConclusions, NameABoundOnceWithTheControllersThatEndThere) {
  TuneSection section;
  section.wind_speeds = {12.0};
  for (const char* structure : {"PI+C", "DPF+C"}) {
    for (const auto purpose : {TunedFor::nominal, TunedFor::robust}) {
      TunedController controller = controller_of(structure, purpose, 1.0);
      auto& tuning = controller.design.tuning;
      tuning.controller.structure = control::LoopStructure::named(structure);
      for (const auto& gain : tuning.controller.structure.gains())
        tuning.controller.gains.push_back(gain.upper);
      tuning.gains_at_bound = {"compliance"};
      section.controllers.push_back(std::move(controller));
    }
  }
  const auto count = [](const std::string& text, const std::string& part) {
    int found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  const auto sentences = conclude(section);
  EXPECT_THAT(sentences, Contains("The search ended at the upper bound of the compliance, cs = 0.1 "
                                  "rad/(N.m), with PI+C (nominal, 12 m/s), PI+C (robust, 12 m/s): "
                                  "widen it with [[tuning.bound]] or in the [[loop]]."));
  const std::string text = to_text(document_of(section));
  EXPECT_EQ(count(text, "The search ended at"), 1);
  // Without present gains there is no before.
  EXPECT_EQ(count(text, "before and after"), 0);
  section.controllers[0].tuned_for = TunedFor::present;
  EXPECT_EQ(count(to_text(document_of(section)), "Gains, before and after"), 1);
}

// Corners of the lags and leads at their upper bounds, 300 rad/s.
TEST(GainsAtBounds, LeaveOutALagThatNoSampledControllerNeeds) {
  const auto searched = [](const char* structure, const std::vector<std::string>& at_bound) {
    design::TuningResult tuning;
    tuning.status = design::TuningStatus::optimal;
    tuning.controller.structure = control::LoopStructure::named(structure);
    for (const auto& gain : tuning.controller.structure.gains())
      tuning.controller.gains.push_back(gain.upper);
    tuning.gains_at_bound = at_bound;
    return tuning;
  };
  const auto pi = searched("PI", {"rate lag corner"});
  const auto feedback = searched("DPF+C", {"rate lag corner"});
  const auto told = gains_at_bounds(std::vector<SearchedController>{
      {"PI (robust)", &pi, 0.02}, {"DPF+C (robust)", &feedback, 0.02}});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0],
            "The search ended at the upper bound of the rate lag corner, wp = 300 rad/s, with PI "
            "(robust), DPF+C (robust): widen it with [[tuning.bound]] or in the [[loop]]. Sampled "
            "every 0.02 s, a controller has no effect above 157 rad/s, and such a lag has none: "
            "omit it (structure PI-0 instead of PI; a [[loop]] without it instead of DPF+C).");
  // Two samples of 5 ms a turn are 628 rad/s: there it acts. Nothing is known without sampling.
  EXPECT_TRUE(corners_beyond_sampling({"PI", &pi, 0.005}).empty());
  EXPECT_TRUE(corners_beyond_sampling({"PI", &pi}).empty());
  // A lead may go, its lag not before it.
  const auto both = searched("FULL", {"rate lag corner", "rate lead corner"});
  EXPECT_THAT(
      corners_beyond_sampling({"FULL", &both, 0.02}),
      ElementsAre(EndsWith("such a lead has none: omit it (structure DPF instead of FULL)."),
                  EndsWith("such a lag has none.")));
  // At its lower bound a lag does much; an integral at its upper one acts below it.
  auto slow = searched("PI", {"rate lag corner", "rate integral corner"});
  slow.controller.gains[2] = slow.controller.structure.gains()[2].lower;
  EXPECT_TRUE(corners_beyond_sampling({"PI", &slow, 0.2}).empty());
}

TEST(TuneConclusions, SayThatABoundOnlyStopsAFlatDirection) {
  TunedController controller;
  controller.structure = "PI";
  controller.tuned_for = TunedFor::robust;
  controller.wind_speed = 12.7056;
  controller.boresight_rms = 9.4551 * millidegree;
  EXPECT_TRUE(gain_trades({&controller}, {}).empty());
  controller.trade = design::PositionGainTrade{
      {control::LoopStructure::pi(), {0.254, 1.0, 6.0, 0.25}}, 2, 0, 9.5 * millidegree, 20};
  controller.ensemble.emplace().members.resize(30);
  const auto sentences = gain_trades({&controller}, {});
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_THAT(sentences[0], AllOf(HasSubstr("PI (robust, 12.7 m/s) has kp at its bound:"),
                                  HasSubstr("kp = 6 1/s and kr = 0.254 gives 9.5000 mdeg, +0.5 %, "
                                            "with all constraints met on 20 of 30 plants")));
}

TEST(Shortfalls, TrustNoBudgetToAControllerThatLimitCycles) {
  TuneSection section = section_with_need();
  section.wind_mast = plant::WindMast{10.0, 28.0, 0.14, 1.2};
  section.controllers = {controller_in_time("DPF+C", 1.0, 7.4, 1.05),
                         controller_in_time("LL", 1.1, 0.2, 1.5),
                         controller_in_time("PI", 1.5, 0.2, 1.6)};
  // The linear plant's best meets the budget, and limit-cycles; the second misses it on the
  // nonlinear one.
  EXPECT_EQ(best_controller(section, 12.0), &section.controllers[0]);
  EXPECT_EQ(nearest_to_budget(section, 12.0), &section.controllers[1]);
  auto shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_EQ(shortfalls[0].infeasible,
            "The budget 'need' in band Ka (1.2000 mdeg) is met up to 12 m/s at the dish, 10 at the "
            "mast by no tuned controller (DPF+C, LL, PI): the controllers that meet it in wind "
            "limit-cycle beyond it.");
  EXPECT_THAT(shortfalls[0].closest,
              AllOf(HasSubstr("LL (robust) comes nearest with 1.5000 mdeg on the nonlinear antenna "
                              "(1.1000 linear)"),
                    HasSubstr("(1.1000 linear), 1.5067 with the limit cycle"),
                    HasSubstr("met up to 13.1 m/s at the dish, 10.9 at the mast by simulation"),
                    HasSubstr("Excluded by the nonlinear antenna: DPF+C (robust), 1.0000 mdeg on "
                              "the linear plant, limit-cycles by +-7.40 mdeg.")));
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("but it limit-cycles by +-7.40 mdeg on the nonlinear antenna")));
  // A controller that loses on the nonlinear antenna but meets the budget there all the same is
  // good.
  section.controllers[1] = controller_in_time("LL", 0.9, 0.2, 1.15);
  EXPECT_TRUE(find_shortfalls(section).empty());
  // Where none is left, the least simulated rms with its limit cycle comes nearest, not the linear
  // plant's best.
  section.controllers = {
      controller_in_time("DPF+C", 1.19, 6.8, 2.17), controller_in_time("FULL", 1.43, 5.8, 1.78),
      controller_in_time("PI", 1.77, 7.0, 2.07), controller_of("DPF+C", TunedFor::nominal, 1.07)};
  EXPECT_EQ(best_controller(section, 12.0), &section.controllers[0]);
  EXPECT_EQ(nearest_to_budget(section, 12.0), &section.controllers[1]);
  shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(shortfalls[0].infeasible,
              AllOf(HasSubstr("(1.2000 mdeg) cannot be met up to 12 m/s at the dish, 10 at the "
                              "mast by the tuned controllers (DPF+C, FULL, PI)."),
                    Not(HasSubstr("limit-cycle"))));
  EXPECT_THAT(
      shortfalls[0].closest,
      AllOf(HasSubstr("FULL (robust) comes nearest with 1.7800 mdeg on the nonlinear antenna "
                      "(1.4300 linear)"),
            Not(HasSubstr("met up to")),
            HasSubstr("it limit-cycles by +-5.80 mdeg, and no other robust controller is fit")));
  // A run in wind that did not complete has no simulated rms to be ranked by.
  section.controllers[1].in_time->boresight_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(nearest_to_budget(section, 12.0), &section.controllers[0]);
  section.controllers = {section.controllers[1]};
  EXPECT_THAT(find_shortfalls(section)[0].closest,
              HasSubstr("FULL (robust) comes nearest with 1.4300 mdeg on the linear plant, "));
  // Where none is left, the linear best is named for what it is.
  section.controllers = {controller_in_time("DPF+C", 1.3, 7.4, 1.35)};
  shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(shortfalls[0].closest,
              AllOf(HasSubstr("DPF+C (robust) comes nearest with 1.3500 mdeg on the nonlinear"),
                    HasSubstr("On the nonlinear antenna it limit-cycles by +-7.40 mdeg, and no "
                              "other robust controller is fit")));
  // Its limit cycle breaks a budget that its rms in wind meets, of +-1.7 mdeg; not one of +-7.5.
  section.controllers = {controller_in_time("DPF+C", 1.0, 7.4, 1.05)};
  ASSERT_EQ(find_shortfalls(section).size(), 1U);
  EXPECT_THAT(conclude(section), Each(Not(HasSubstr("is met up to the required"))));
  section.budgets.front().rms = 5.3 * millidegree;
  EXPECT_FALSE(find_shortfalls(section).empty());  // sqrt(1.05^2 + 7.4^2 / 2) = 5.337
  section.budgets.front().rms = 5.4 * millidegree;
  EXPECT_TRUE(find_shortfalls(section).empty());
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr(
                  "1.0500 mdeg on the nonlinear antenna, where it limit-cycles by +-7.40 mdeg")));
  section.controllers[0].in_time->limit_cycle_runs_complete = false;
  shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(shortfalls[0].infeasible,
              HasSubstr("limit-cycle beyond it, or are not shown free of limit cycles."));
  section.budgets.clear();
  section.boresight_rms_goal = 1.2 * millidegree;
  section.controllers[0].in_time->limit_cycle_runs_complete = true;
  EXPECT_EQ(find_shortfalls(section).at(0).infeasible,
            "A boresight error of 1.2000 mdeg rms is met at 12 m/s by no tuned controller: the "
            "controllers that meet it in wind limit-cycle beyond it.");
}

TEST(RecommendedController, IsTheOneThatTheTimeDomainChooses) {
  TuneSection section = section_of_two_alike();
  // Held against a budget LL would be first, by less than decides anything.
  ASSERT_EQ(nearest_to_budget(section, 12.0), &section.controllers[1]);
  EXPECT_EQ(recommended_tuned_controller(section, 12.0), &section.controllers[0]);
  EXPECT_EQ(recommended_tuned_controller(section), &section.controllers[0]);
  EXPECT_EQ(recommended_tuned_controller(section, 10.0), nullptr);
  std::swap(section.controllers[0], section.controllers[1]);
  EXPECT_EQ(recommended_tuned_controller(section, 12.0), &section.controllers[1]);
  // An rms that is better by more than a little outweighs the limit cycle.
  section.controllers[0].in_time->boresight_rms = 2.0 * millidegree;
  EXPECT_EQ(recommended_tuned_controller(section, 12.0), &section.controllers[0]);
  EXPECT_EQ(why_not_recommended(section, section.controllers[1], section.controllers[0]),
            "has 2.1552 mdeg rms instead of 2.0000");
  // Of amplitudes that are one as printed neither is a reason.
  section.controllers[1].in_time->limit_cycles =
      (1.0 + 1e-4) * section.controllers[0].in_time->limit_cycles;
  section.controllers[1].in_time->boresight_rms =
      1.015 * section.controllers[0].in_time->boresight_rms;
  EXPECT_EQ(why_not_recommended(section, section.controllers[1], section.controllers[0]),
            "has 2.0300 mdeg rms instead of 2.0000");
  section.controllers[1].in_time = controller_in_time("PI", 2.1276, 0.4246, 2.1552).in_time;
  // A run in wind that did not complete is no merit.
  section.controllers[0].in_time->boresight_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(recommended_tuned_controller(section, 12.0), &section.controllers[1]);
  // Where all limit-cycle, none is.
  section.controllers[1].in_time->limit_cycle_free = false;
  EXPECT_EQ(recommended_tuned_controller(section, 12.0), nullptr);
  EXPECT_THAT(conclude(section), Each(Not(HasSubstr("recommended"))));
  EXPECT_THAT(decision(section, {}, {}), Each(Not(HasSubstr("meets need"))));
  // Where none ran, the linear plant's best is.
  for (auto& controller : section.controllers) controller.in_time.reset();
  EXPECT_EQ(recommended_tuned_controller(section, 12.0), &section.controllers[2]);
  EXPECT_THAT(conclude(section), Each(Not(HasSubstr("the recommended controller"))));
}

TEST(RecommendedController, IsWhatFiguresAndExportedModelsAreOf) {
  TuneSection section = section_of_two_alike();
  TimeDomainSection in_time;
  in_time.controller = "LL, robust";
  ASSERT_EQ(best_controller(section), &section.controllers[2]);
  EXPECT_EQ(shown_controller(section, &in_time), &section.controllers[0]);
  // Where all limit-cycle, that of the time domain's figures, and the linear plant's best without
  // one.
  for (auto& controller : section.controllers) controller.in_time->limit_cycle_free = false;
  ASSERT_EQ(recommended_tuned_controller(section), nullptr);
  EXPECT_EQ(shown_controller(section, &in_time), &section.controllers[1]);
  EXPECT_EQ(shown_controller(section, nullptr), &section.controllers[2]);
  section.controllers.clear();
  EXPECT_EQ(shown_controller(section, &in_time), nullptr);
}

TEST(RecommendedController, IsTheOneOfEveryConclusion) {
  TuneSection section = section_of_two_alike();
  EXPECT_THAT(
      conclude(section),
      Contains("At 12 m/s the recommended controller is PI (robust) with 2.1276 mdeg rms on the "
               "linear plant, 2.1552 mdeg on the nonlinear antenna. Active constraints: none."));
  EXPECT_THAT(conclude(section),
              Contains("The budget 'need' in band Ka (2.4440 mdeg) is met up to the required 12 "
                       "m/s: PI (robust) has 2.1276 mdeg on the case's plant, 2.1552 mdeg on the "
                       "nonlinear antenna, and meets it on 27 of 30 plants; LL (robust) meets it "
                       "on 28, but limit-cycles by +-0.4375 mdeg instead of +-0.4246, and has a "
                       "corner beyond half the sampling rate, where it has no effect."));
  EXPECT_THAT(decision(section, {}, {}).at(1),
              AllOf(StartsWith("On the linear plant DPF+C is best"),
                    HasSubstr("; PI (robust), the recommended controller, meets need (Ka) up to")));
  EXPECT_EQ(decision(section, {}, {}).front(),
            "Recommended: PI (robust), 2.155 mdeg rms per axis in 12 m/s wind, simulated (2.128 "
            "linear).");
  // Another controller is worth a word only where it meets the budget on more plants.
  section.controllers[1].ensemble = ensemble_with(27);
  EXPECT_THAT(conclude(section), Contains(EndsWith("and meets it on 27 of 30 plants.")));
  // The linear plant's best is not the one recommended though it does not limit-cycle.
  section.controllers[1].boresight_rms = 2.12 * millidegree;
  section.controllers.pop_back();
  EXPECT_THAT(decision(section, {}, {}).at(1),
              AllOf(StartsWith("On the linear plant LL is best"),
                    HasSubstr("; PI (robust), the recommended controller, meets need")));
  section.controllers[1].boresight_rms = 2.13 * millidegree;
  EXPECT_THAT(decision(section, {}, {}).at(1),
              AllOf(StartsWith("On the linear plant PI is best"), HasSubstr("; it meets need")));
}

TEST(RecommendedController, IsNamedWhereAnotherComesNearerToABudget) {
  TuneSection section = section_of_two_alike();
  auto& budget = section.budgets.front();
  budget.rms = 2.17 * millidegree;  // with the limit cycles LL has 2.168, PI 2.176
  // One controller meets it: nothing is out of reach, and that one is recommended, though another
  // of nearly the same rms has a smaller limit cycle.
  EXPECT_TRUE(find_shortfalls(section).empty());
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("LL (robust) has 2.1303 mdeg on the case's plant, 2.1461 mdeg on "
                                 "the nonlinear antenna")));
  budget.rms = 2.14 * millidegree;
  const auto shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(
      shortfalls[0].closest,
      AllOf(StartsWith("PI (robust), the recommended controller, has 2.1552 mdeg on the nonlinear "
                       "antenna (2.1276 linear), "),
            HasSubstr(". LL (robust) comes nearest with 2.1461 mdeg on the nonlinear antenna "
                      "(2.1303 linear), 2.1683 with the limit cycle, but limit-cycles by +-0.4375 "
                      "mdeg instead of"),
            HasSubstr("Excluded by the nonlinear antenna: DPF+C (robust)")));
}

// Without a study in the time domain the rms of the linear plant decides.
TEST(RecommendedController, PointsBetterThanOneThatIsGoodOnMorePlants) {
  TuneSection section = section_with_need();
  section.budgets.front().rms = 2.444 * millidegree;
  section.controllers = {controller_of("PI", TunedFor::robust, 2.0),
                         controller_of("DPF", TunedFor::robust, 2.2),
                         controller_of("LL", TunedFor::nominal, 1.9)};
  section.controllers[0].ensemble = ensemble_with(20);
  section.controllers[1].ensemble = ensemble_with(25);
  // What holds its goals on the nominal plant only is no alternative.
  section.controllers[2].ensemble = ensemble_with(30);
  EXPECT_THAT(
      conclude(section),
      Contains(HasSubstr(
          "PI (robust) has 2.0000 mdeg on the case's plant, and meets it on 20 of 30 plants; DPF "
          "(robust) meets it on 25, but has 2.2000 mdeg rms instead of 2.0000.")));
}

TEST(TuneTable, SaysWhichControllersAreVerifiedOnTheLinearPlantOnly) {
  TuneSection section = section_with_need();
  section.controllers = {controller_of("PI", TunedFor::nominal, 1.1),
                         controller_of("PI", TunedFor::robust, 1.3),
                         controller_of("LL", TunedFor::nominal, 1.1)};
  const auto told = [&] {
    std::string text = to_text(document_of(section));
    for (auto at = text.find("\n  "); at != std::string::npos; at = text.find("\n  ", at)) {
      text.replace(at, 3, " ");
    }
    return text;
  };
  // Without a study in the time domain there is nothing to tell apart.
  EXPECT_THAT(told(), Not(HasSubstr("Not run on the nonlinear antenna")));
  EXPECT_THAT(conclude(section), Each(Not(HasSubstr("on the linear plant"))));
  section.controllers[1].in_time = {false, 7.4 * millidegree, 1.35 * millidegree};
  EXPECT_THAT(told(),
              HasSubstr("Not run on the nonlinear antenna: nominal controllers. They are verified "
                        "on the linear plant only, and may limit-cycle. Speeds up to which"));
  EXPECT_THAT(
      conclude(section),
      Contains(HasSubstr(
          "best nominal controller is PI with 1.1000 mdeg rms on the linear plant; not run")));
  section.controllers[0].constraints_met = section.controllers[2].constraints_met = false;
  EXPECT_THAT(told(), Not(HasSubstr("Not run on the nonlinear antenna")));
  // At another wind speed the same purpose may not have run.
  section.controllers.push_back(controller_of("PI", TunedFor::robust, 2.0));
  section.controllers.back().wind_speed = 15.0;
  EXPECT_THAT(told(), HasSubstr("Not run on the nonlinear antenna: robust controllers at 15 m/s."));
}

}  // namespace
}  // namespace boresight::app
