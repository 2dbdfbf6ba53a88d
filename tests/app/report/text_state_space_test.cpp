#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/io/description/state_space_results.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;
using testing::Not;

design::StateSpaceStudy study() {
  design::StateSpaceStudy study;
  study.wind_speed = 10.0;
  study.simulated.controller = "LQG, order 9";
  study.simulated.rms.emplace().rms.value = 0.2 * millidegree;
  study.simulated.result.wind.static_error = 0.75 * millidegree;
  study.limit_cycle_free = true;
  auto& change = study.change.emplace();
  change.value = -0.35;
  change.lower = -0.40;
  change.upper = -0.30;
  return study;
}

TEST(TextStateSpace, PutsItBesideTheLoops) {
  TimeDomainSection loops;
  loops.controller = "FULL+L+C, robust";
  loops.result.wind.predicted_rms = 0.31 * millidegree;
  loops.result.wind.static_error = 0.33 * millidegree;
  loops.result.slew.emplace().overshoot = 2.5 * millidegree;
  const std::string text = to_text(document_of(study(), loops));
  EXPECT_THAT(text, HasSubstr("FULL+L+C, robust  LQG, order 9"));
  EXPECT_THAT(text, testing::ContainsRegex("rms, simulated +[0-9.-]+ +0[.]2000"));
  EXPECT_THAT(text,
              testing::ContainsRegex("static boresight error in the mean wind +0.3300 +0.7500"));
  EXPECT_THAT(text, testing::ContainsRegex("slew overshoot +2.5000 +-"));
}

TEST(TextStateSpace, TellsOfAnAdvantageOnlyWhereThereIsOne) {
  EXPECT_THAT(state_space_advantage(study()),
              HasSubstr("(LQG, order 9) has 0.200 mdeg rms simulated, 35 % less (95 % 30 % to 40 "
                        "%), and no limit cycle beyond the tightest budget"));
  auto cycling = study();
  cycling.limit_cycle_free = false;
  EXPECT_EQ(state_space_advantage(cycling), "");
  auto even = study();
  even.change->upper = 0.01;
  EXPECT_EQ(state_space_advantage(even), "");
  even.change.reset();
  EXPECT_EQ(state_space_advantage(even), "");
}

TEST(TextStateSpace, IsDescribedInItsUnits) {
  io::RecordingVisitor v;
  io::describe(v, study());
  EXPECT_NEAR(*v.numbers_found.at("expected_rms.rms_mdeg"), 0.2, 1e-12);
  EXPECT_NEAR(*v.numbers_found.at("change.upper_95_1"), -0.30, 1e-15);
  EXPECT_NEAR(*v.numbers_found.at("runs.static_error_mdeg"), 0.75, 1e-12);
}

}  // namespace
}  // namespace boresight::app
