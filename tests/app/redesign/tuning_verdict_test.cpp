#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/redesign/optimal_design.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tuning.hpp>

namespace boresight::app {
namespace {

using control::LoopStructure;
using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

Report tuned_report() {
  Report report;
  report.command = "redesign";
  TuningSection section;
  section.structure = LoopStructure::pi_with_lag();
  section.design = design_of(0.5);
  section.design_speed = 12.0;
  section.torque_limited_wind_speed = 25.7;
  section.static_error = 1.5 * millidegree;
  section.wind_alternatives = {{plant::WindModel::uniform, 1e-5}};
  report.tuning = std::move(section);
  return report;
}

BudgetResult budget(double rms_mdeg, double limit, std::optional<double> needed = std::nullopt) {
  BudgetResult result;
  result.budget.name = "need";
  result.budget.band = "Ka";
  result.budget.rms = rms_mdeg * millidegree;
  result.budget.wind_speed = needed;
  result.wind_speed_limit = limit;
  return result;
}

std::vector<std::string> tuning_conclusions(const Report& report) {
  std::vector<std::string> sentences;
  if (report.tuning) conclude_tuning(report, *report.tuning, sentences);
  return sentences;
}

TEST(TuningVerdict, EndsWhereTheSupplysTorqueEnds) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(4.0, 29.9), budget(2.0, 20.0),
                            budget(9.0, std::numeric_limits<double>::infinity())};
  const auto& budgets = report.tuning->budgets;
  EXPECT_EQ(met_text(*report.tuning, budgets[0]),
            "would be met up to the 25.7 m/s at which the mean wind takes all supply torque that "
            "friction and offset leave");
  EXPECT_EQ(met_text(*report.tuning, budgets[1]), "is met up to 20.0 m/s");
  EXPECT_EQ(reached_wind_speed(*report.tuning, budgets[2]), 25.7);
  report.tuning->torque_limited_wind_speed = std::numeric_limits<double>::infinity();
  EXPECT_EQ(met_text(*report.tuning, budgets[2]), "is met up to the 60 m/s studied");
  report.tuning->torque_limited_wind_speed = 0.0;  // friction takes it all
  EXPECT_EQ(met_text(*report.tuning, budgets[1]), "is met in no wind");
}

TEST(TuningVerdict, GivesTheFractionOfTheClimatesTime) {
  Report report = tuned_report();
  TuningSection& section = *report.tuning;
  section.wind_site.surface_drag = 0.005;
  section.climate = {{5.0, 3.0}, {10.0, 1.0}};
  section.budgets = {budget(1.0, 9.1), budget(2.0, 16.0), budget(9.0, 30.0)};
  EXPECT_EQ(met_text(section, section.budgets[0]), "is met up to 9.1 m/s (75 % of the time)");
  EXPECT_EQ(met_text(section, section.budgets[1]),
            "is met up to 16.0 m/s, beyond the climate's highest speed of 10 m/s");
  EXPECT_THAT(decision(report).front(), HasSubstr("9.1 m/s (75 % of the time)"));
  // The supply ends before the controller does.
  section.torque_limited_wind_speed = 7.0;
  EXPECT_THAT(met_text(section, section.budgets[2]),
              AllOf(HasSubstr("up to the 7.0 m/s"), HasSubstr("(75 % of the time)")));
  EXPECT_THAT(to_text(document_of(section)),
              HasSubstr("Of the time: fraction of the climate's time with winds up to that speed"));
  section.climate.clear();
  EXPECT_THAT(to_text(document_of(section)), Not(HasSubstr("of the time")));
}

TEST(TuningVerdict, SaysWhereTheWindModelDecides) {
  Report report = tuned_report();
  TuningSection& section = *report.tuning;
  section.wind_model = plant::WindModel::coherence;
  section.budgets = {budget(0.55, 12.8, 12.0)};
  const auto with = [&](double uniform_rms, double uniform_limit) {
    section.wind_alternatives = {
        {plant::WindModel::uniform, uniform_rms * millidegree, {uniform_limit}},
        {plant::WindModel::coherence, 0.5 * millidegree, {12.8}}};
    return reservations(report);
  };
  EXPECT_THAT(with(0.53, 12.3), Each(Not(HasSubstr("wind model"))));
  EXPECT_THAT(with(0.61, 12.1),
              Contains(HasSubstr("Sensitive to the wind model: the same gains have 0.500 mdeg with "
                                 "the case's, coherence, but 0.610 mdeg with uniform.")));
  EXPECT_THAT(with(0.57, 11.7),
              Contains(HasSubstr("need (Ka: 0.550 mdeg) is met up to its required wind speed with "
                                 "coherence, but not with uniform.")));
}

TEST(TuningVerdict, DecidesNothingOnStaticBendingUnsaid) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(1.6, 20.0)};
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("Static deflection"))));
  report.tuning->budgets = {budget(1.4, 19.0)};
  EXPECT_THAT(reservations(report),
              Contains(HasSubstr("m/s, 1.500 mdeg, exceeds the whole budget of")));
}

TEST(TuningVerdict, SaysOnHowManyPlantsANeedIsMet) {
  Report report = tuned_report();
  design::EnsembleResult ensemble;
  ensemble.members.resize(30);
  ensemble.stable = ensemble.within_constraints = 30;
  report.tuning->ensemble = ensemble;
  report.tuning->budgets = {budget(1.0, 16.9, 12.0), budget(2.0, 30.0)};
  report.tuning->budgets[0].plants_met = 24;
  const auto sentence =
      HasSubstr("Of 30 perturbed plant models it meets need (Ka: 1.000 mdeg) in 12 m/s on 24.");
  EXPECT_THAT(tuning_conclusions(report), Contains(sentence));
  EXPECT_THAT(reservations(report), Contains(sentence));
  // Met on all of them it decides nothing.
  report.tuning->budgets[0].plants_met = 30;
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("perturbed plant models it meets"))));
}

TEST(TuningVerdict, SaysThatANeedIsNotMet) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(0.1, 5.4, 12.0)};
  EXPECT_THAT(
      tuning_conclusions(report),
      Contains(HasSubstr("NOT MET: need (Ka: 0.100 mdeg) is required up to 12 m/s; as "
                         "built, with PI with lag (nominal), it is met up to 5.4 m/s, by the "
                         "linear plant.")));
  design::Design unstable;
  unstable.tuning.status = design::TuningStatus::unstable;
  report.tuning->present = {{"PI without lag", unstable}};
  const auto decided = decision(report);
  EXPECT_THAT(decided.front(), StartsWith("NOT MET"));
  EXPECT_THAT(decided, Each(Not(HasSubstr("Run the drive"))));
  report.tuning->present.clear();
  report.tuning->torque_limited_wind_speed = 11.0;
  EXPECT_THAT(decision(report).front(), HasSubstr("No loop structure changes that"));
  report.tuning->torque_limited_wind_speed = 25.7;
  report.tuning->budgets = {budget(1.0, 16.9, 12.0)};
  EXPECT_THAT(unmet_needs(*report.tuning, report.time_domain), IsEmpty());
  EXPECT_THAT(decision(report).front(), HasSubstr("Run the drive as built on PI with lag"));
}

TEST(TuningVerdict, GivesSpeedsOfBudgetsAtTheMastToo) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(0.1, 4.03, 8.08537)};
  EXPECT_THAT(tuning_conclusions(report), Each(Not(HasSubstr("at the mast"))));
  report.tuning->wind_mast = plant::WindMast{10.0, 28.0, 0.14, 1.155053};
  EXPECT_THAT(tuning_conclusions(report),
              Contains(AllOf(HasSubstr("required up to 8.09 m/s at the dish, 7 at the mast;"),
                             HasSubstr("met up to 4.0 m/s at the dish, 3.49 at the mast, by the "
                                       "linear plant."))));
  EXPECT_THAT(conclude_mast(*report.tuning->wind_mast),
              HasSubstr("divide by 1.155 for the case's 10 m mast"));
  EXPECT_THAT(to_text(document_of(*report.tuning)),
              AllOf(HasSubstr("met up to m/s (at the mast)"), HasSubstr("4.03 (3.49)"),
                    HasSubstr("8.09 (7)")));
}

TEST(TuningVerdict, SaysOnHowManyPlantsTheControllerHolds) {
  Report report = tuned_report();
  design::EnsembleResult ensemble;
  ensemble.members.resize(30);
  ensemble.stable = 29;
  ensemble.within_constraints = 6;
  report.tuning->ensemble = ensemble;
  EXPECT_THAT(tuning_conclusions(report),
              Contains(HasSubstr("With these gains only 6 of 30 perturbed plant models meet the "
                                 "constraints (1 unstable). Do not install.")));
  EXPECT_THAT(reservations(report), Contains(HasSubstr("only 6 of 30 perturbed plant models")));
  // One that recommend() calls fit, on the ensemble that it was tuned on, is not withdrawn.
  report.tuning->fitness = design::Fitness::fit;
  EXPECT_THAT(tuning_conclusions(report),
              AllOf(Contains(HasSubstr("only 6 of 30 perturbed plant models")),
                    Each(Not(HasSubstr("Do not install")))));
  report.tuning->fitness = design::Fitness::misses_member;
  EXPECT_THAT(decision(report), Each(Not(HasSubstr("Run the drive"))));
  report.tuning->ensemble->stable = report.tuning->ensemble->within_constraints = 30;
  EXPECT_THAT(tuning_conclusions(report),
              Contains(HasSubstr("all 30 perturbed plant models meet the constraints.")));
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("perturbed plant models"))));
  EXPECT_THAT(decision(report).front(), HasSubstr("Run the drive"));
}

TEST(TuningVerdict, SaysOnWhatAVerdictOnABudgetRests) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(0.5, 11.5, 12.0)};
  EXPECT_THAT(unmet_needs(*report.tuning, std::nullopt),
              ElementsAre(HasSubstr("it is met up to 11.5 m/s, by the linear plant.")));
  TimeDomainSection& section = report.time_domain.emplace();
  section.options.allowed_limit_cycle = 0.705 * millidegree;
  section.wind_speed = 12.0;
  section.result.wind.predicted_rms = 0.49 * millidegree;
  section.result.wind.boresight_rms = 0.51 * millidegree;
  EXPECT_THAT(unmet_needs(*report.tuning, report.time_domain),
              ElementsAre(HasSubstr("11.5 m/s, by simulation (0.510 mdeg in 12 m/s).")));
  // The rms of several records counts, and the limit cycle is named.
  section.rms.emplace().rms.value = 0.48 * millidegree;
  design::LimitCycleResult rest;
  rest.limit_cycle = true;
  rest.boresight_amplitude = 0.3 * millidegree;
  section.result.limit_cycles = {rest};
  EXPECT_THAT(unmet_needs(*report.tuning, report.time_domain),
              ElementsAre(HasSubstr("by simulation (0.480 mdeg in 12 m/s, limit cycle of +-0.30 "
                                    "mdeg).")));
  // One that is met as far as it is required is no such sentence.
  report.tuning->budgets = {budget(0.5, 12.5, 12.0)};
  EXPECT_THAT(unmet_needs(*report.tuning, report.time_domain), IsEmpty());
  EXPECT_THAT(decision(report).front(), HasSubstr("is met up to 12.5 m/s, by simulation (0.480"));
  // A run that was lost leaves none.
  section.rms.reset();
  section.result.wind.boresight_rms = std::numeric_limits<double>::quiet_NaN();
  report.tuning->budgets = {budget(0.5, 0.0, 12.0)};
  EXPECT_THAT(unmet_needs(*report.tuning, report.time_domain),
              ElementsAre(HasSubstr("it is met in no wind, as the controller does not complete the "
                                    "run on the nonlinear antenna in 12 m/s.")));
  report.tuning->budgets.clear();
  EXPECT_THAT(decision(report).front(),
              AllOf(HasSubstr("m/s of wind (the run on the nonlinear antenna did not complete)."),
                    Not(HasSubstr("Run the drive"))));
}

TEST(TuningVerdict, RunsNoDriveThatLimitCycles) {
  Report report = tuned_report();
  EXPECT_THAT(decision(report).front(), HasSubstr("Run the drive"));
  TimeDomainSection& section = report.time_domain.emplace();
  section.options.allowed_limit_cycle = 0.705 * millidegree;
  design::LimitCycleResult rest;
  rest.limit_cycle = true;
  rest.boresight_amplitude = 0.7 * millidegree;
  section.result.limit_cycles = {rest};
  EXPECT_THAT(decision(report).front(), HasSubstr("Run the drive"));
  section.result.limit_cycles[0].boresight_amplitude = 0.8 * millidegree;
  EXPECT_THAT(reservations(report),
              Contains(HasSubstr("it has a limit cycle of +-0.80 mdeg, beyond the allowed "
                                 "+-0.705 mdeg")));
  EXPECT_THAT(decision(report), Each(Not(HasSubstr("Run the drive"))));
  section.result.limit_cycles[0] = {};
  section.result.limit_cycles[0].status = design::RunStatus::lost;
  EXPECT_THAT(reservations(report), Contains(HasSubstr("was not shown free of limit cycles")));
  EXPECT_THAT(decision(report), Each(Not(HasSubstr("Run the drive"))));
}

TEST(TuningVerdict, SaysWhereNoLoopHelps) {
  Report report = tuned_report();
  report.tuning->flexure_rms = 0.44 * millidegree;
  EXPECT_THAT(tuning_conclusions(report),
              Each(Not(HasSubstr("structural flexure beyond the encoder"))));
  report.tuning->flexure_rms = 0.46 * millidegree;
  EXPECT_THAT(tuning_conclusions(report),
              Contains(HasSubstr("structural flexure beyond the encoder")));
  EXPECT_THAT(reservations(report), Contains(HasSubstr("structural flexure beyond the encoder")));
}

TEST(TuningVerdict, WarnsOfPresentGainsThatThePlantCallsUnstable) {
  Report report = tuned_report();
  EXPECT_THAT(tuning_conclusions(report), Each(Not(HasSubstr("present gains"))));
  design::Design unstable;
  unstable.tuning.status = design::TuningStatus::unstable;
  report.tuning->present = {{"PI without lag", unstable}};
  EXPECT_THAT(tuning_conclusions(report).front(),
              AllOf(HasSubstr("WARNING: the present gains of PI without lag are unstable"),
                    HasSubstr("check leakage")));
  EXPECT_THAT(decision(report).front(), HasSubstr("WARNING: the present gains"));
  TuningSection section = *report.tuning;
  section.design = unstable;
  EXPECT_THAT(to_text(document_of(section)), HasSubstr("UNSTABLE"));
  report.tuning->present = {{"PI without lag", design_of(0.8)}};
  EXPECT_THAT(tuning_conclusions(report).front(),
              HasSubstr("The present gains of PI without lag have 0.800 mdeg rms in 12 m/s; the "
                        "tuned PI with lag changes that by -37.5 %."));
}

TEST(TuningVerdict, SaysWhatItDoesNotKnow) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(1.0, 16.9)};
  report.tuning->design.tuning.gains_at_bound = {"rate integral corner"};
  const auto sentences = tuning_conclusions(report);
  EXPECT_THAT(sentences, Contains(HasSubstr("search limit: rate integral corner")));
  EXPECT_THAT(sentences,
              Contains(HasSubstr("Friction, limit cycles and slewing were not examined")));
  EXPECT_THAT(sentences, Contains(HasSubstr("the pointing model must remove it")));
  EXPECT_THAT(reservations(report), Contains(HasSubstr("were not examined")));
  EXPECT_THAT(decision(report),
              ElementsAre(EndsWith("is met up to 16.9 m/s, by the linear plant.")));
  report.time_domain.emplace();
  EXPECT_THAT(tuning_conclusions(report), Each(Not(HasSubstr("not examined"))));
  report.tuning->design.verification.passed = false;
  EXPECT_THAT(decision(report).front(), HasSubstr("fails verification"));
  // Of a controller on which nothing is decided there is nothing to reserve but what is assumed.
  EXPECT_THAT(reservations(report), ElementsAre(HasSubstr("is assumed")));
}

TEST(TuningVerdict, SaysWhatHangsOnGuessesOfWindAndBeam) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(0.55, 12.0, 12.0)};
  report.interpretations.resize(3);
  const std::array<double, 3> rms{0.5, 0.55, 0.45}, speeds{12.0, 10.9, 99.0};
  for (std::size_t i = 0; i < rms.size(); ++i) {
    report.interpretations[i].name = fmt::format("choice {}", i);
    report.interpretations[i].design = design_of(rms.at(i));
    report.interpretations[i].speed_limits = {speeds.at(i)};
    report.interpretations[i].other_fractions = i > 0;
  }
  EXPECT_THAT(reservations(report),
              Contains(AllOf(
                  HasSubstr("has 0.500 mdeg with the case's own and 0.550 with 'choice 1', 0.450 "
                            "with 'choice 2'; need (Ka: 0.550 mdeg) is met up to its required wind "
                            "speed with the case's own, 'choice 2', but not with 'choice 1'."))));
  // Neither another verdict nor far apart.
  report.tuning->budgets = {budget(0.55, 12.0, 10.0)};
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("participation of wind torque"))));
  report.interpretations[2].design = design_of(0.39);
  EXPECT_THAT(
      reservations(report),
      Contains(AllOf(HasSubstr("The modal participation of wind torque and boresight is assumed"),
                     HasSubstr("0.390 with 'choice 2'. A structural model"))));
  // Beyond the supply's torque none is met.
  report.tuning->budgets = {budget(0.55, 99.0, 26.0)};
  report.interpretations[2].design = design_of(0.45);
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("participation of wind torque"))));
}

TEST(TuningVerdict, SaysWhichOtherChoiceTurnsAVerdictRound) {
  Report report = tuned_report();
  report.tuning->budgets = {budget(0.55, 12.0, 12.0)};
  report.interpretations.resize(2);
  report.interpretations[0].design = design_of(0.5);
  // The case's own plant, tuned as the others are.
  report.interpretations[0].name = "reference";
  report.interpretations[0].speed_limits = {12.0};
  report.interpretations[1].name = "antenna of the drawings";
  report.interpretations[1].design = design_of(0.6);
  report.interpretations[1].speed_limits = {11.0};
  const auto turned =
      Contains(HasSubstr("Re-tuned for alternative interpretations of the case, need (Ka: 0.550 "
                         "mdeg) is not met up to its required wind speed with 'antenna of the "
                         "drawings' (0.600 mdeg in 12 m/s); the case's own"));
  EXPECT_THAT(reservations(report), turned);
  EXPECT_THAT(tuning_conclusions(report), turned);
  // What is there too is no other reading.
  report.interpretations[1].other_attitude = true;
  const auto attitude = Contains(
      HasSubstr("Re-tuned for the antenna's other attitudes, need (Ka: 0.550 mdeg) is not met"));
  EXPECT_THAT(reservations(report), AllOf(attitude, Not(turned)));
  EXPECT_THAT(tuning_conclusions(report), AllOf(attitude, Not(turned)));
  report.interpretations[1].other_attitude = false;
  report.interpretations[1].speed_limits = {12.1};
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("the opposite verdict"))));
  // No way out of a contradiction says nothing of budgets.
  report.interpretations[1].speed_limits = {11.0};
  report.interpretations[1].wanted_frequency = 1.0;
  report.interpretations[1].resonance = 0.5;
  EXPECT_THAT(reservations(report), Each(Not(HasSubstr("the opposite verdict"))));
}

TEST(TuningText, SaysWhereTheLoopsHaveAGainOfOne) {
  Report report = tuned_report();
  auto& margins = report.tuning->design.margins;
  margins[0].gain_crossovers = {{.frequency = 2.0 * std::numbers::pi * 0.4}};
  margins[2].gain_crossovers = {{.frequency = 2.0 * std::numbers::pi * 0.1},
                                {.frequency = 2.0 * std::numbers::pi * 0.35}};
  EXPECT_THAT(to_text(document_of(*report.tuning)),
              AllOf(HasSubstr("crossover Hz"), ContainsRegex("rate loop alone .* 0\\.4 "),
                    ContainsRegex("valve command .* none "),
                    ContainsRegex("position loop .* 0\\.1, 0\\.35 ")));
}

}  // namespace
}  // namespace boresight::app
