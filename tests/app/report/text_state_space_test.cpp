#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/document/on_one_line.hpp"
#include "io/description/recording_visitor.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/io/description/state_space_results.hpp>

namespace boresight::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

design::StateSpaceStudy study() {
  design::StateSpaceStudy study;
  study.wind_speed = 10.0;
  study.simulated.controller = "state space, order 9";
  study.simulated.rms.emplace().rms.value = 0.2 * millidegree;
  study.simulated.result.wind.static_error = 0.75 * millidegree;
  study.simulated.result.wind.predicted_rms = 0.19 * millidegree;
  design::LimitCycleResult rest;
  rest.limit_cycle = true;
  rest.starts = rest.starts_with_limit_cycle = 3;
  rest.boresight_amplitude = 0.06 * millidegree;
  study.simulated.result.limit_cycles = {rest};
  study.limit_cycle_free = true;
  auto& change = study.change.emplace();
  change.value = -0.35;
  change.lower = -0.40;
  change.upper = -0.30;
  return study;
}

TimeDomainSection loops() {
  TimeDomainSection loops;
  loops.controller = "FULL+L+C, robust";
  loops.result.wind.predicted_rms = loops.result.wind.boresight_rms = 0.31 * millidegree;
  loops.result.wind.static_error = 0.33 * millidegree;
  loops.result.slew.emplace().overshoot = 2.5 * millidegree;
  loops.result.slew->settling_time = 0.0;
  return loops;
}

TEST(TextStateSpace, PutsItBesideTheLoops) {
  const std::string text = to_text(document_of(study(), loops()));
  EXPECT_THAT(text, HasSubstr("FULL+L+C, robust  state space, order 9"));
  EXPECT_THAT(text, ContainsRegex("rms, simulated +0[.]3100 +0[.]2000"));
  EXPECT_THAT(text, ContainsRegex("limit cycle at rest +- +[+]-0[.]0600"));
  // The root of 0.2^2 + 0.06^2/2.
  EXPECT_THAT(text, ContainsRegex("rms and limit cycle in quadrature +0[.]3100 +0[.]2045"));
  EXPECT_THAT(text, ContainsRegex("static boresight error in the mean wind +0[.]3300 +0[.]7500"));
  EXPECT_THAT(text, ContainsRegex("slew overshoot +2[.]5000 +-"));
  EXPECT_THAT(text, ContainsRegex("slew settled after, s +at once +-"));
}

TEST(TextStateSpace, LeadsWithItsVerdict) {
  const auto verdict = [](const design::StateSpaceStudy& study) {
    return on_one_line(to_text(document_of(study, loops())));
  };
  EXPECT_THAT(verdict(study()),
              HasSubstr("Better: its simulated rms is 0.204 mdeg, against 0.310 of "
                        "FULL+L+C, robust (-35.0 %, 95 % -40.0 % to -30.0 %), "
                        "limit cycles included."));
  EXPECT_THAT(
      state_space_advantage(study(), loops()),
      HasSubstr("(state space, order 9) would be better, but cannot be commissioned loop by loop: "
                "0.204 mdeg rms"));
  auto cycling = study();
  cycling.limit_cycle_free = false;
  EXPECT_THAT(verdict(cycling),
              HasSubstr("Not usable, as it limit-cycles beyond the allowed amplitude"));
  EXPECT_EQ(state_space_advantage(cycling, loops()), "");
  auto unsettled = study();
  unsettled.simulated.result.slew.emplace();
  EXPECT_THAT(verdict(unsettled),
              HasSubstr("Not usable, as it does not settle within the tightest budget after a "
                        "slew: its simulated rms"));
  EXPECT_EQ(state_space_advantage(unsettled, loops()), "");
  unsettled.simulated.result.slew->settling_time = 3.0;
  EXPECT_THAT(verdict(unsettled), HasSubstr("Better: "));
  auto even = study();
  even.change->upper = 0.01;
  EXPECT_THAT(verdict(even), HasSubstr("No advantage: its simulated rms"));
  EXPECT_EQ(state_space_advantage(even, loops()), "");
  even.change.reset();
  EXPECT_THAT(verdict(even), HasSubstr("No verdict: a run did not complete."));
  EXPECT_EQ(state_space_advantage(even, loops()), "");
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
