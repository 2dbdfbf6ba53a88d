#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/redesign/optimal_design.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using control::LoopStructure;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

MatchingSeries series_of(const LoopStructure& structure, const std::string& friction, double slope,
                         const std::vector<double>& rms) {
  MatchingSeries series{friction, slope, structure, {}};
  for (const double one : rms) series.designs.push_back(design_of(one));
  return series;
}

// 0, 1 (as built) and 3 disks, ratio 1 between the last two.
MatchingSection matching_of(std::vector<MatchingSeries> series) {
  MatchingSection section;
  section.rows = {{.disks = 0.0, .label = "0 disks", .motor_to_load_ratio = 0.02},
                  {.disks = 1.0, .label = "1 disk", .as_built = true, .motor_to_load_ratio = 0.4},
                  {.disks = 2.6, .label = "ratio 1", .motor_to_load_ratio = 1.0},
                  {.disks = 3.0, .label = "3 disks", .motor_to_load_ratio = 1.1}};
  section.series = std::move(series);
  return section;
}

Report report_with(MatchingSection section) {
  Report report;
  report.command = "redesign";
  report.matching = std::move(section);
  return report;
}

std::vector<std::string> concluded(const Report& report) {
  std::vector<std::string> sentences;
  if (report.matching) conclude_matching(report, *report.matching, sentences);
  return sentences;
}

TEST(MatchingVerdict, OfAFlatStudyAdvisesNoInertiaAndNoRule) {
  const auto report = report_with(matching_of(
      {series_of(LoopStructure::pi_with_lag(), "linear plant", 0.16,
                 {0.5038, 0.5037, 0.503, 0.5028}),
       series_of(LoopStructure::pi(), "linear plant", 0.16, {0.5208, 0.521, 0.521, 0.5211})}));
  const auto sentences = concluded(report);
  EXPECT_THAT(sentences, Contains(HasSubstr("nor a matching rule matters here")));
  EXPECT_THAT(sentences, Contains(HasSubstr("PI without lag instead of PI with lag (by 3 %)")));
  EXPECT_THAT(sentences, Each(Not(HasSubstr("ratio of 1"))));
  const std::string decided = decide_matching(report, *report.matching);
  EXPECT_THAT(decided, HasSubstr("Leave the motors' inertia as it is"));
  EXPECT_THAT(decided, Not(HasSubstr("measure")));
}

TEST(MatchingVerdict, SaysWhereOnlyTheBoundsOfTheSearchHold) {
  auto report = report_with(matching_of(
      {series_of(LoopStructure::pi_with_lag(), "linear plant", 0.16, {0.45, 0.5, 0.58, 0.6})}));
  EXPECT_THAT(concluded(report), Each(Not(HasSubstr("search limit"))));
  auto& designs = report.matching->series.front().designs;
  designs[0].tuning.gains_at_bound = designs[2].tuning.gains_at_bound = {"position gain"};
  EXPECT_THAT(concluded(report),
              Contains(HasSubstr("At 2 of the 4 points of the matching study a gain is at its "
                                 "search limit (position gain)")));
}

TEST(MatchingVerdict, GoesFromTheMotorsAsBuiltToBothEnds) {
  const auto report = report_with(matching_of(
      {series_of(LoopStructure::pi_with_lag(), "linear plant", 0.16, {0.45, 0.5, 0.58, 0.6})}));
  const auto sentences = concluded(report);
  EXPECT_THAT(sentences, Contains(AllOf(HasSubstr("Going from 1 disk to 0 disks"),
                                        HasSubstr("-10.0 % (PI with lag, linear plant)"))));
  EXPECT_THAT(sentences, Contains(AllOf(HasSubstr("Going from 1 disk to 3 disks"),
                                        HasSubstr("+20.0 % (PI with lag, linear plant)"))));
  EXPECT_THAT(sentences, Contains(HasSubstr("There is no optimum at an inertia ratio of 1.")));
  EXPECT_EQ(decide_matching(report, *report.matching),
            "Going from 1 disk as built to 0 disks, re-tuned for the case's plant alone, changes "
            "the rms of linear loops by -10.0 % with PI with lag (linear plant).");
}

TEST(MatchingVerdict, TakesAnOptimumAtTheEndForNone) {
  const auto at_end = report_with(matching_of(
      {series_of(LoopStructure::pi_with_lag(), "linear plant", 0.16, {0.6, 0.55, 0.51, 0.5})}));
  EXPECT_THAT(concluded(at_end), Contains(HasSubstr("an optimum at a ratio of 1 is not shown")));
  const auto inside = report_with(matching_of(
      {series_of(LoopStructure::pi_with_lag(), "linear plant", 0.16, {0.6, 0.55, 0.5, 0.51})}));
  EXPECT_THAT(concluded(inside), Contains(HasSubstr("The optimum is near a ratio of 1")));
}

TEST(MatchingVerdict, AsksForTheFrictionSlopeOnlyWhereItDecides) {
  const auto with = [](const std::vector<double>& other) {
    return report_with(matching_of(
        {series_of(LoopStructure::pi_with_lag(), "linear plant", 0.9, {0.44, 0.5, 0.52, 0.53}),
         series_of(LoopStructure::pi_with_lag(), "slope at tracking rate", 12.0, other)}));
  };
  const auto decides = with({0.406, 0.407, 0.408, 0.409});
  EXPECT_THAT(decide_matching(decides, *decides.matching),
              HasSubstr("-12.0 % with PI with lag (linear plant), but by -0.2 % with the slope at "
                        "tracking rate: measure that slope before changing flywheels."));
  EXPECT_THAT(concluded(decides), Contains(HasSubstr("measure that slope")));
  const auto alike = with({0.35, 0.4, 0.42, 0.43});
  EXPECT_THAT(decide_matching(alike, *alike.matching),
              AllOf(HasSubstr(", and by -12.5 % with the slope"), Not(HasSubstr("measure"))));
  EXPECT_THAT(concluded(alike), Each(Not(HasSubstr("measure that slope"))));
}

TEST(MatchingVerdict, NamesOneFrictionByItsSlope) {
  const auto report = report_with(
      matching_of({series_of(LoopStructure::pi_with_lag(), "", 0.9, {0.45, 0.5, 0.58, 0.6})}));
  EXPECT_THAT(concluded(report),
              Contains(HasSubstr("-10.0 % (PI with lag, friction slope 0.9 N.m.s/rad).")));
  EXPECT_THAT(to_text(document_of(*report.matching)),
              HasSubstr("PI with lag; friction slope 0.9 N.m.s/rad\n"));
}

}  // namespace
}  // namespace boresight::app
