// What a redesign says of gains that end at bounds of the search.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

// A controller whose search ended at the upper bounds of rate lag corner and position gain.
design::Design design_at_upper_bounds() {
  design::Design design;
  design.verification.passed = true;
  design.boresight_rms = 0.5 * millidegree;
  auto& tuning = design.tuning;
  tuning.status = design::TuningStatus::optimal;
  for (const auto& gain : tuning.controller.structure.gains())
    tuning.controller.gains.push_back(gain.upper);
  tuning.gains_at_bound = {"rate lag corner", "position gain"};
  return design;
}

TEST(RedesignBounds, SayWhatABoundOnlyStopsAndWhatNoSamplingReaches) {
  Report report;
  report.tuning.emplace();
  TuningSection& section = *report.tuning;
  section.design = design_at_upper_bounds();
  section.wind_alternatives = {{plant::WindModel::uniform, 1e-5}};
  const auto concluded = [&] {
    std::vector<std::string> sentences;
    conclude_tuning(report, section, sentences);
    return sentences;
  };
  EXPECT_THAT(concluded(),
              Each(AllOf(Not(HasSubstr("only kp*kr matters")), Not(HasSubstr("Sampled every")))));
  section.trade = design::PositionGainTrade{
      {control::LoopStructure::pi(), {0.228, 1.0, 9.66, 0.25}}, 2, 0, 0.5045 * millidegree, 0};
  section.problem.delay = 0.03;
  EXPECT_THAT(
      concluded(),
      Contains(AllOf(
          HasSubstr("in a [[loop]]. Sampled every 0.02 s"),
          HasSubstr("structure PI-0 instead of PI"),
          HasSubstr("PI with lag has kp at its bound: its rate-loop gain is so low"),
          HasSubstr("0.5045 mdeg, +0.9 %. Lower the upper bound of kp with [[tuning.bound]] or"))));
}

TEST(RedesignBounds, SayThatThePositionGainsMayBeNoLimitOfAMatchingStudy) {
  Report report;
  MatchingSection section;
  section.rows = {{.disks = 0.0, .label = "0 disks"},
                  {.disks = 1.0, .label = "1 disk", .as_built = true}};
  section.series = {{"linear plant",
                     0.16,
                     control::LoopStructure::pi_with_lag(),
                     {design_at_upper_bounds(), design_at_upper_bounds()}}};
  const auto concluded = [&] {
    std::vector<std::string> sentences;
    conclude_matching(report, section, sentences);
    return sentences;
  };
  EXPECT_THAT(concluded(),
              Contains(AllOf(HasSubstr("At 2 of the 2 points"), HasSubstr("only kp*kr matters"))));
  for (auto& design : section.series[0].designs) design.tuning.gains_at_bound = {"rate lag corner"};
  EXPECT_THAT(concluded(), Each(Not(HasSubstr("kp*kr"))));
}

}  // namespace
}  // namespace boresight::app
