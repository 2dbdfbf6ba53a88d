// Tables of the report's text, and what stands below them.
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/document/on_one_line.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<InterpretationResult> tuned_choices(std::size_t count) {
  std::vector<InterpretationResult> interpretations(count);
  for (auto& choice : interpretations) choice.design.emplace().boresight_rms = 1e-5;
  return interpretations;
}

TEST(Choices, SayWhichMissTheFrequencyThatTheyAreMadeFor) {
  auto interpretations = tuned_choices(3);
  const std::array<double, 3> frequencies{1.73, 1.034, 0.348};
  for (std::size_t i = 0; i < interpretations.size(); ++i) {
    interpretations[i].name = fmt::format("choice {}", i);
    interpretations[i].resonance = frequencies.at(i);
    if (i > 0) interpretations[i].wanted_frequency = 1.05;
  }
  EXPECT_THAT(to_text(document_of(interpretations)),
              HasSubstr("misses the measured 1.05 Hz: 'choice\n  2' (0.348 Hz)."));
  interpretations.pop_back();
  EXPECT_THAT(to_text(document_of(interpretations)), Not(HasSubstr("do not resolve")));
}

TEST(Choices, SayWhatAHydraulicModeOfTwoRealPolesIs) {
  auto interpretations = tuned_choices(1);
  EXPECT_THAT(to_text(document_of(interpretations)), Not(HasSubstr("two real poles")));
  interpretations[0].design->hydraulic_mode.damping_ratio = 1.05;
  EXPECT_THAT(to_text(document_of(interpretations)), HasSubstr("two real poles"));
}

TEST(Choices, AreContradictionsOnlyWhereSourcesOrTestsDiffer) {
  std::vector<InterpretationResult> interpretations(2);
  EXPECT_THAT(interpretations_heading(interpretations), HasSubstr("Open inputs"));
  interpretations.emplace_back().contradicts = true;
  EXPECT_THAT(interpretations_heading(interpretations), HasSubstr("Contradictory inputs"));
}

TEST(IdentificationText, ReconcilesNoMethodsThatContradictOneAnother) {
  IdentificationSection section;
  section.inertia.methods.resize(2);
  section.printed.resize(2);
  section.combined = identification::combine({{0.8, 0.02}, {7.9, 3.0}}, 0.4);
  EXPECT_THAT(to_text(document_of(section)), HasSubstr("Combined estimate: J = "));
  section.combined = identification::combine({{0.8, 0.02}, {7.9, 0.8}}, 0.4);
  const std::string text = on_one_line(to_text(document_of(section)));
  EXPECT_THAT(text, HasSubstr("No combined estimate: the methods contradict one another "
                              "(Cochran's Q 78."));
  EXPECT_THAT(text, HasSubstr("of 2 methods would be 4.305 kg.m2 (0.76 .. 9.47;"));
  EXPECT_THAT(text, Not(HasSubstr("Combined estimate: J")));
  EXPECT_THAT(text, Not(HasSubstr("impulse")));
  for (auto& method : section.inertia.methods) method.kind = identification::MethodKind::impulse;
  EXPECT_THAT(on_one_line(to_text(document_of(section))),
              HasSubstr("(the impulse results count as one)"));
}

TEST(IdentificationText, GivesFractionsOfTheSamplesInFigures) {
  IdentificationSection section;
  section.inertia.methods.resize(1);
  section.printed.resize(1);
  const auto with = [&](double fraction) {
    section.inertia.methods.front().motor_to_load_ratio.beyond_pole = fraction;
    return to_text(document_of(section));
  };
  EXPECT_THAT(with(0.998), HasSubstr("In 100 % of samples J < Jm"));
  EXPECT_THAT(with(0.12), HasSubstr("In 12 % of samples"));
  EXPECT_THAT(with(0.0034), HasSubstr("In 0.34 % of samples"));
}

TEST(PlantText, GivesNoSignToAFractionThatIsZero) {
  PlantSection section;
  plant::PlantMode mode;
  mode.frequency = 2.0;
  mode.pole = {-0.1, 12.0};
  mode.oil_fraction = mode.oil_participation = 0.6;
  mode.gear_fraction = -0.001;
  section.modes = {mode};
  EXPECT_THAT(to_text(document_of(section)), Not(HasSubstr("-0.00")));
  section.modes[0].gear_fraction = -0.02;
  EXPECT_THAT(to_text(document_of(section)), HasSubstr("-0.02"));
}

TEST(IdentificationText, LeavesOutColumnsThatNoRowFills) {
  IdentificationSection section;
  section.inertia.methods.resize(1);
  section.inertia.methods.front().name = "hydraulic resonance";
  section.printed.resize(1);
  EXPECT_THAT(to_text(document_of(section)),
              AllOf(Not(HasSubstr("printed")), Not(HasSubstr("lbf")), Not(HasSubstr("(eq."))));
  section.printed.front() = {"1.45 kg.m2", ""};
  section.pounds_force = true;
  EXPECT_THAT(to_text(document_of(section)),
              AllOf(HasSubstr("printed J"), HasSubstr("lbf.ft.s2"), Not(HasSubstr("printed R"))));
}

}  // namespace
}  // namespace boresight::app
