#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/redesign/optimal_design.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/redesign_card.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

design::Design tuned_design(double rms_mdeg) {
  design::Design design = design_of(rms_mdeg);
  design.tuning.controller = {control::LoopStructure::named("PI-0"), {0.15, 0.4, 8.0, 0.15}};
  return design;
}

// A robust controller that was simulated, on 30 plant models.
Report report_of_test() {
  Report report;
  report.command = "redesign";
  auto& section = report.tuning.emplace();
  section.name = "PI-0";
  section.tuned_for = design::TunedFor::robust;
  section.fitness = design::Fitness::fit;
  section.design = tuned_design(0.5);
  section.design_speed = 10.0;
  auto& ensemble = section.ensemble.emplace();
  ensemble.members.resize(30);
  ensemble.stable = ensemble.within_constraints = 30;
  auto& run = report.time_domain.emplace();
  run.wind_speed = 10.0;
  run.result.wind.boresight_rms = 0.52 * millidegree;
  run.options.settled_error = run.options.allowed_limit_cycle = millidegree;
  return report;
}

std::string line_of(const Report& report, const std::string& label) {
  for (const auto& line : redesign_card(report)) {
    if (line.label == label) return line.text;
  }
  return "";
}

TEST(RedesignCard, LoadsWhatIsRobustAndSimulated) {
  const Report report = report_of_test();
  EXPECT_THAT(line_of(report, "Load"),
              AllOf(StartsWith("PI-0 (robust): kr = 0.15"), HasSubstr("kp = 8")));
  EXPECT_THAT(line_of(report, "Error per axis"),
              StartsWith("0.520 mdeg rms at 10 m/s, simulated (one record)"));
  EXPECT_THAT(line_of(report, "Margins"), HasSubstr("; met on 30/30 models"));
}

// One record may be off by several per cent: what counts is the mean of several.
TEST(RedesignCard, GivesTheRmsOfSeveralRecordsWithItsInterval) {
  Report report = report_of_test();
  auto& expected = report.time_domain->rms.emplace();
  expected.records = 10;
  expected.rms = {0.51 * millidegree, 0.01 * millidegree, 0.49 * millidegree, 0.53 * millidegree};
  EXPECT_THAT(line_of(report, "Error per axis"),
              StartsWith("0.510 mdeg rms at 10 m/s, simulated (95 % 0.490 to 0.530 over 10 "
                         "winds)"));
  // A run that was lost leaves the one record that was not.
  expected.rms.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(line_of(report, "Error per axis"), StartsWith("0.520 mdeg rms"));
}

// What recommend() calls unfit is not loaded, and the card says why.
TEST(RedesignCard, DoesNotLoadWhatIsUnfit) {
  Report report = report_of_test();
  using design::Fitness;
  for (const auto& [fitness, why] : std::vector<std::pair<Fitness, std::string>>{
           {Fitness::misses_budget, "misses a required budget"},
           {Fitness::misses_member, "violates constraints on some models"},
           {Fitness::not_shown, "not shown to be free of limit cycles"},
           {Fitness::limit_cycle, "limit-cycles beyond the allowed amplitude"},
           {Fitness::lost_in_wind, "lost in simulated wind"}}) {
    report.tuning->fitness = fitness;
    EXPECT_THAT(line_of(report, "Do not load"), StartsWith("PI-0 (robust, " + why + "): kr = "));
  }
  report.tuning->fitness = Fitness::misses_member;
  EXPECT_THAT(line_of(report, "Confidence"),
              StartsWith("low: constraints violated on some models"));
  report.tuning->design.tuning.status = design::TuningStatus::infeasible;
  EXPECT_THAT(line_of(report, "Controller"), StartsWith("none"));
  EXPECT_EQ(line_of(report, "Error per axis"), "");
  EXPECT_THAT(redesign_card(Report{}), IsEmpty());
}

// Without [simulation] the other commands recommend it too: by linear loops.
TEST(RedesignCard, SaysThatAControllerWasNotSimulated) {
  Report report = report_of_test();
  report.time_domain.reset();
  EXPECT_THAT(line_of(report, "Recommended"), StartsWith("PI-0"));
  EXPECT_THAT(line_of(report, "Error per axis"), HasSubstr("not simulated"));
  EXPECT_THAT(line_of(report, "Confidence"), StartsWith("low: not shown on the nonlinear antenna"));
}

TEST(RedesignCard, ComparesWithTheGainsOfToday) {
  Report report = report_of_test();
  EXPECT_THAT(line_of(report, "Gains of today"), HasSubstr("[gains]"));
  report.tuning->present = {{"DPF", tuned_design(0.7)}};
  EXPECT_EQ(line_of(report, "Gains of today"), "DPF: 0.700 mdeg, recommended 0.500, linear plant");
  report.tuning->present[0].design.tuning.status = design::TuningStatus::unstable;
  EXPECT_THAT(line_of(report, "Gains of today"), HasSubstr("unstable on the plant of the case"));
}

// Simulated figures are compared with simulated ones.
TEST(RedesignCard, ComparesWithTheRetunedStructureWithoutGainsOfToday) {
  Report report = report_of_test();
  report.tuning->present = {{"PI", tuned_design(0.7), true}};
  EXPECT_EQ(line_of(report, "Gains of today"),
            "not given; PI tuned for this plant 0.700 mdeg, recommended 0.500, linear plant");
  report.tuning->present[0].simulated_rms = 0.72 * millidegree;
  auto& expected = report.time_domain->rms.emplace();
  expected.rms = {0.51 * millidegree, 0.01 * millidegree, 0.49 * millidegree, 0.53 * millidegree};
  EXPECT_EQ(line_of(report, "Gains of today"),
            "not given; PI tuned for this plant 0.720 mdeg, recommended 0.510, simulated");
  report.tuning->present.clear();
  report.tuning->is_retuned_present = true;
  EXPECT_THAT(line_of(report, "Gains of today"),
              HasSubstr("PI-0 tuned for this plant is the recommended controller"));
}

TEST(RedesignCard, CountsUnstableModels) {
  Report report = report_of_test();
  EXPECT_THAT(line_of(report, "Margins"), Not(HasSubstr("UNSTABLE")));
  EXPECT_THAT(line_of(report, "Load"), StartsWith("PI-0"));
  report.tuning->ensemble->stable = report.tuning->ensemble->within_constraints = 29;
  EXPECT_THAT(line_of(report, "Margins"), EndsWith("29/30 models, 1 UNSTABLE"));
  EXPECT_THAT(line_of(report, "Confidence"),
              StartsWith("low: constraints violated on some models"));
  EXPECT_THAT(line_of(report, "Recommended"), StartsWith("PI-0"));
}

TEST(RedesignCard, GivesTheFractionOfSampledPlantsBesideTheModels) {
  Report report = report_of_test();
  report.tuning->constraints_met = {0.902, 0.888, 0.915};
  EXPECT_THAT(line_of(report, "Margins"), HasSubstr("; met on 30/30, 90 % of plants"));
  report.tuning->constraints_met = {0.9995, 0.997, 1.0};
  EXPECT_THAT(line_of(report, "Margins"), HasSubstr("; met on 30/30, 99.95 % of plants"));
  report.tuning->constraints_met = {1.0, 0.998, 1.0};
  EXPECT_THAT(line_of(report, "Margins"), HasSubstr("; met on 30/30, 100 % of plants"));
}

// A state space has one loop, no gains, and commands that must be shaped.
TEST(RedesignCard, NamesTheBestLoopsBesideAStateSpace) {
  Report report = report_of_test();
  EXPECT_THAT(line_of(report, "Load"), Not(HasSubstr("best loops")));
  EXPECT_THAT(line_of(report, "Margins"), Not(HasSubstr("at the valve")));
  report.tuning->loops = {"FULL", report.tuning->design};
  report.tuning->loops->design.boresight_rms = 0.75 * millidegree;
  report.tuning->curves.emplace();
  report.time_domain->result.slew.emplace().overshoot = 0.214 * millidegree;
  EXPECT_THAT(line_of(report, "Load"), EndsWith("; best loops FULL, 0.750 mdeg linear"));
  report.tuning->loops->simulated_rms = 0.8 * millidegree;
  EXPECT_THAT(line_of(report, "Load"), EndsWith("; best loops FULL, 0.800 mdeg"));
  EXPECT_THAT(line_of(report, "Margins"), AllOf(HasSubstr(" (at the valve); overshoot "),
                                                HasSubstr(" %, after a shaped slew 0.214 mdeg;")));
  report.time_domain->result.slew->status = design::RunStatus::lost;
  EXPECT_THAT(line_of(report, "Margins"), Not(HasSubstr("shaped slew")));
}

// Records leave less open than the case's ranges, but hold for the conditions of the tests only.
TEST(RedesignCard, StatesInstabilityBeyondWhatRecordsLeaveOpen) {
  Report report = report_of_test();
  report.tuning->instability = {0.0, 0.0, 0.0037};
  EXPECT_THAT(line_of(report, "Margins"),
              EndsWith("0 % unstable over the case's ranges (95 %: at most 0.37 %)"));
  EXPECT_THAT(line_of(report, "Load"), StartsWith("PI-0"));
  report.tuning->instability = {0.009, 0.0041, 0.017};
  EXPECT_THAT(line_of(report, "Margins"),
              EndsWith("0.9 % unstable over the case's ranges (95 %: at most 1.7 %)"));
  EXPECT_THAT(line_of(report, "Recommended"), StartsWith("PI-0"));
}

TEST(RedesignCard, SaysThatNoModelFitsTheRecords) {
  Report report = report_of_test();
  EXPECT_THAT(line_of(report, "Confidence"), HasSubstr("no records"));
  report.campaign.emplace();
  EXPECT_THAT(line_of(report, "Confidence"), StartsWith("low: no model fits the records"));
  EXPECT_THAT(line_of(report, "Confidence"), Not(HasSubstr("no records")));
}

TEST(RedesignCard, NamesTheErrorOfAnAzimuthAxisCrossElevation) {
  Report report = report_of_test();
  report.axis.name = "azimuth";
  EXPECT_EQ(line_of(report, "Error per axis"), "");
  EXPECT_THAT(line_of(report, "Cross-elevation"), StartsWith("0.520 mdeg rms"));
}

TEST(RedesignCard, StatesUpToWhichWindBudgetsAreMet) {
  Report report = report_of_test();
  design::BudgetResult required;
  required.budget.band = "Ka";
  required.budget.rms = 0.6 * millidegree;
  required.budget.wind_speed = 12.0;
  required.wind_speed_limit = 11.2;
  required.budget.name = "need";
  required.probability = {0.25, 0.114, 0.41};
  report.tuning->budgets = {required};
  EXPECT_EQ(
      line_of(report, "Budgets (mdeg)"),
      "Ka 0.600 (need) to 11.2 m/s (required 12), probability 0.250 (0.114 to 0.410) at 12 m/s");
  EXPECT_THAT(line_of(report, "Error per axis"), HasSubstr("; budget 0.600, met"));
  InputEffect effect;
  effect.low_rms = effect.high_rms = 0.61 * millidegree;
  report.tuning->input_effects = {effect};
  EXPECT_THAT(line_of(report, "Error per axis"), EndsWith("; budget 0.600, met nominally"));
  report.tuning->input_effects[0].low_rms = report.tuning->input_effects[0].high_rms =
      0.59 * millidegree;
  EXPECT_THAT(line_of(report, "Error per axis"), EndsWith("; budget 0.600, met"));
  // Not with what the nonlinear antenna adds.
  report.tuning->effect.factor = 1.1;
  EXPECT_THAT(line_of(report, "Error per axis"), EndsWith("; budget 0.600, met nominally"));
  report.tuning->budgets[0].wind_speed_limit = 9.0;
  EXPECT_THAT(line_of(report, "Error per axis"), HasSubstr("; budget 0.600, MISSED"));
}

// 0.5 mdeg linear, 4 % more as simulated, and a limit cycle of 0.2 sqrt(2).
TEST(RedesignCard, AddsTheLimitCycleAndNamesTies) {
  Report report = report_of_test();
  report.tuning->effect = {1.04, 0.2 * std::numbers::sqrt2 * millidegree};
  EXPECT_THAT(line_of(report, "Error per axis"), HasSubstr("; 0.557 with limit cycle"));
  EXPECT_THAT(line_of(report, "Error per axis"), Not(HasSubstr("a tie")));
  report.tuning->ties = {"LL, robust"};
  EXPECT_THAT(line_of(report, "Error per axis"), EndsWith("; a tie with LL, robust"));
  report.tuning->ties.emplace_back("PI, robust");
  EXPECT_THAT(line_of(report, "Error per axis"), EndsWith("; a tie with LL, robust and 1 more"));
}

MatchingSection flywheels(const std::vector<std::vector<double>>& rms) {
  MatchingSection section;
  section.rows = {{.disks = 0.0, .label = "0 disks"},
                  {.disks = 24.0, .label = "24 disks", .as_built = true}};
  for (std::size_t i = 0; i < rms.size(); ++i) {
    MatchingSeries series{i == 0 ? "linear plant" : "slope at tracking rate",
                          1.0 + static_cast<double>(i),
                          control::LoopStructure::pi(),
                          {}};
    for (const double one : rms[i]) series.designs.push_back(tuned_design(one));
    section.series.push_back(std::move(series));
  }
  return section;
}

TEST(RedesignCard, ChangesFlywheelsOnlyForWhatDecides) {
  Report report = report_of_test();
  report.matching = flywheels({{0.499, 0.5}});
  EXPECT_THAT(line_of(report, "Flywheels"),
              StartsWith("keep; PI-0, linear: 0.500 mdeg at 24 disks as built, 0.499 at "
                         "0 disks"));
  report.matching = flywheels({{0.6, 0.5}});
  EXPECT_THAT(line_of(report, "Flywheels"), StartsWith("keep; "));
  report.matching = flywheels({{0.4, 0.5}});
  EXPECT_THAT(
      line_of(report, "Flywheels"),
      AllOf(StartsWith("change; PI-0, linear: 0.500 mdeg at 24"), HasSubstr("boresight evaluate")));
  report.matching = flywheels({{0.4, 0.5}, {0.47, 0.471}});
  EXPECT_THAT(line_of(report, "Flywheels"),
              AllOf(StartsWith("keep until friction is known"),
                    HasSubstr("; 0.471 and 0.470 with slope at tracking rate")));
}

TEST(RedesignCard, NamesTheTestThatMeasuresWhatTheRmsDependsOn) {
  Report report = report_of_test();
  EXPECT_THAT(line_of(report, "Next test"), StartsWith("none"));
  InputEffect effect;
  effect.quantity.key = "drive.viscous_friction";
  effect.low_rms = 0.6 * millidegree;
  effect.high_rms = 0.4 * millidegree;
  report.tuning->input_effects = {effect};
  EXPECT_EQ(line_of(report, "Next test"),
            "constant-speed runs at six rates, both ways (6 min of antenna time): rms 0.400 to "
            "0.600 mdeg over friction");
  EXPECT_THAT(line_of(report, "Error per axis"), HasSubstr("; inputs 0.400 to 0.600, 1 sigma)"));
  report.tuning->input_effects[0].low_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(line_of(report, "Next test"), EndsWith("rms 0.400 to unstable mdeg over friction"));
  report.tuning->input_effects[0].quantity.key = "structure.mode[0].wind_fraction";
  EXPECT_THAT(line_of(report, "Next test"), StartsWith("mode shapes"));
}

TEST(RedesignCard, SaysWhatContradictsBeforeAnythingIsBuilt) {
  Report report = report_of_test();
  EXPECT_EQ(line_of(report, "Settle first"), "nothing");
  auto& resonance = report.resonance.emplace();
  resonance.measured = 0.97;
  resonance.expected = 0.75;
  resonance.standard_uncertainty = 0.02;
  EXPECT_THAT(line_of(report, "Settle first"),
              HasSubstr("resonance 0.97 Hz measured, 0.75 Hz expected"));
  EXPECT_THAT(line_of(report, "Confidence"), HasSubstr("resonance contradicts the plant"));
  // Where the verdict itself may be wrong nothing is to be loaded yet.
  EXPECT_EQ(line_of(report, "Load"), "");
  EXPECT_THAT(line_of(report, "Recommended"), StartsWith("PI-0"));
}

// On one screen whatever the controller: budgets give way to gains.
TEST(RedesignCard, HasSixteenLinesAtMost) {
  Report report = report_of_test();
  auto& section = *report.tuning;
  const auto lines = [&] {
    return std::ranges::count(to_text(document_of(redesign_card(report))), '\n') - 1;
  };
  design::BudgetResult budget;
  budget.budget.band = "Ka";
  budget.budget.name = "0.1 dB at the mean radial error";
  budget.probability = {1.0, 0.92, 1.0};
  budget.wind_speed_limit = 11.0;
  section.budgets = {budget, budget, budget};
  const auto named = [&] {
    const std::string text = line_of(report, "Budgets (mdeg)");
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("Ka ", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(named(), 3U);
  EXPECT_LE(lines(), 16);
  section.design.tuning.controller = {control::LoopStructure::named("FULL+N+C"),
                                      std::vector<double>(12, 0.12345)};
  section.ties = {"LL, robust", "DPF+N, robust", "PI, robust"};
  InputEffect effect;
  effect.quantity.key = "structure.mode[0].wind_fraction";
  effect.low_rms = 0.6 * millidegree;
  effect.high_rms = 0.4 * millidegree;
  section.input_effects = {effect};
  report.matching = flywheels({{0.4, 0.5}, {0.47, 0.471}});
  auto& resonance = report.resonance.emplace();
  resonance.measured = 0.97;
  resonance.expected = 0.75;
  resonance.standard_uncertainty = 0.02;
  EXPECT_LT(named(), 3U);
  EXPECT_LE(lines(), 16) << to_text(document_of(redesign_card(report)));
}

TEST(RedesignCard, AlignsItsLinesBehindTheLabels) {
  const std::string text =
      to_text(document_of(std::vector<CardLine>{{"Load", "PI (robust)", "Tuned loops"}}));
  EXPECT_EQ(text, "\n  Load            PI (robust) [Tuned loops]\n");
}

}  // namespace
}  // namespace boresight::app
