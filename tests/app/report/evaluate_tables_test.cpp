// What the tables of an evaluation leave out: rows that hold nothing to the digits printed. What
// stands below them.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/document/on_one_line.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/figures/evaluate_figures.hpp>
#include <boresight/app/report/evaluate_report.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(EvaluateTables, NameTestsThatAreWorthNothingWithoutRowsOfZeros) {
  EvaluateSection section;
  section.candidates.resize(1);
  section.candidates[0].name = "as it is";
  DecisionSection decision;
  decision.candidates.resize(1);
  decision.statistics.options.resize(1);
  decision.front_fractions = {1.0};
  decision.inputs = {"leakage", "oil stiffness", "bearing"};
  design::SampleInformation tests;
  tests.inputs.resize(3);
  tests.inputs[0].fitted = {3e-4, 1e-5};
  // A held-out gain may be negative.
  tests.inputs[1].held_out_gain = -1e-9;
  decision.tests = tests;
  const std::string text = to_text(document_of(section, decision));
  EXPECT_THAT(text, AllOf(HasSubstr("leakage"), HasSubstr("0.00030"),
                          HasSubstr("Zero to the digits printed: oil stiffness, bearing.")));
  EXPECT_THAT(text, Not(HasSubstr("bearing ")));
}

TEST(EvaluateTables, LeaveOutWhatFollowsByLessThanTheDigitsPrinted) {
  EvaluateSection section;
  section.candidates.resize(1);
  Candidate& candidate = section.candidates[0];
  candidate.name = "filter";
  candidate.path = "filter.toml";
  candidate.derived_quantities = {{"dead time", "s", 0.03, 0.015, "samples", ""},
                                  {"gear ratio", "1", 28730.0, 28730.0001, "teeth", ""}};
  const std::string text = to_text(document_of(section));
  EXPECT_THAT(text, AllOf(HasSubstr("dead time"), Not(HasSubstr("gear ratio"))));
  // Without a [cost] the cell is empty, and nothing is said of a currency.
  EXPECT_THAT(text, AllOf(HasSubstr("cost: stated by no proposal"),
                          Not(HasSubstr("Pareto front of cost"))));
}

// Losses beyond the main beam are no numbers to compare.
TEST(EvaluateTables, GiveNoLossWhereTheParabolaEnds) {
  EvaluateSection section;
  section.bands.resize(2);
  section.candidates.resize(1);
  section.candidates[0].figures.emplace().losses = {0.7424, 2.99};
  EXPECT_THAT(to_text(document_of(section)),
              AllOf(HasSubstr("0.7424  2.9900"), Not(HasSubstr("parabola"))));
  section.candidates[0].figures->losses[1] = 10.7632;
  EXPECT_THAT(to_text(document_of(section)),
              AllOf(HasSubstr("0.7424  > 3"), Not(HasSubstr("10.76")),
                    HasSubstr("> 3: beyond 3 dB the parabolic beam model does not hold.")));
}

TEST(EvaluateTables, NameTheModeOfMostOilWhereTheHydraulicModeHasLittle) {
  EvaluateSection section;
  section.candidates.resize(2);
  const auto set = [&](std::size_t place, const char* name, double frequency) -> plant::PlantMode& {
    Candidate& candidate = section.candidates[place];
    candidate.name = name;
    candidate.oil_mode.frequency = frequency;
    candidate.oil_mode.damping_ratio = 0.03;
    candidate.oil_mode.oil_fraction = 0.8;
    candidate.controllers.resize(1);
    candidate.chosen = 0;
    plant::PlantMode& mode = candidate.controllers[0].design.hydraulic_mode;
    mode.oil_fraction = 0.06;
    return mode;
  };
  const auto told = [&] { return on_one_line(to_text(document_of(section))); };
  set(0, "as it is", 6.02);
  plant::PlantMode& bare = set(1, "no flywheels", 22.3);
  section.candidates[1].path = "no-flywheels.toml";
  EXPECT_THAT(told(),
              AllOf(HasSubstr("hydr., zeta: frequency and damping of the open-loop hydraulic mode"),
                    HasSubstr("Less than half of the hydraulic mode's elastic energy is in the "
                              "oil; the dominant hydraulic mode is at 6.02 Hz (zeta 0.030) as it "
                              "is, 22.3 Hz (zeta 0.030) with 'no flywheels'.")));
  bare.oil_fraction = 0.7;
  EXPECT_THAT(told(), HasSubstr("mode is at 6.02 Hz (zeta 0.030) as it is."));
  section.candidates[0].oil_mode.oil_fraction = 0.06;
  EXPECT_THAT(told(), Not(HasSubstr("dominant hydraulic mode")));
}

// A mast's speeds, raised to the dish, are no round numbers.
TEST(EvaluateTables, StandUnderTheHeadingThatFiguresName) {
  EvaluateSection section;
  section.wind_speed = 12.1419;
  section.candidates.resize(1);
  Candidate& candidate = section.candidates[0];
  candidate.controllers.resize(1);
  candidate.gains.resize(1);
  candidate.chosen = 0;
  candidate.controllers[0].ensemble.emplace().members.resize(1);
  const auto figures = evaluate_figures(section);
  ASSERT_EQ(figures.size(), 1U);
  const std::string text = to_text(document_of(section));
  EXPECT_THAT(text, AllOf(HasSubstr(figures[0].section), HasSubstr("12.1 m/s")));
}

}  // namespace
}  // namespace boresight::app
