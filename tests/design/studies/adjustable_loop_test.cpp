#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include <boresight/design/studies/adjustable_loop.hpp>

namespace boresight::design {
namespace {

TunedController tuned_at(double wind_speed) {
  TunedController row;
  row.structure = "PI";
  row.wind_speed = wind_speed;
  row.design.tuning.status = TuningStatus::optimal;
  row.design.tuning.controller = reference::cautious_gains();
  return row;
}

TEST(AdjustableLoop, IsInTheWindOfItsControllerWithoutTheClimate) {
  TuningStudy study;
  study.problem = reference::tracking_problem();
  study.problem.climate = {{study.problem.wind, 1.0}};
  const auto loop = adjustable_loop(study, tuned_at(14.0));
  ASSERT_TRUE(loop.has_value());
  EXPECT_EQ(loop->structure, "PI");
  EXPECT_EQ(loop->controller.gains, reference::cautious_gains().gains);
  EXPECT_EQ(loop->problem.wind.mean_speed, 14.0);
  EXPECT_TRUE(loop->problem.climate.empty());
}

TEST(AdjustableLoop, IsNoneWithoutAStableController) {
  TunedController row = tuned_at(10.0);
  row.design.tuning.status = TuningStatus::unstable;
  EXPECT_FALSE(adjustable_loop(TuningStudy{}, row).has_value());
  RecommendedDesign recommended;
  recommended.design = row.design;
  EXPECT_FALSE(adjustable_loop(recommended).has_value());
  recommended.design.tuning.status = TuningStatus::infeasible;
  EXPECT_TRUE(adjustable_loop(recommended).has_value());
}

TEST(AdjustableLoop, IsThatOfTheLoopsBesideAStateSpaceWhichHasNoGains) {
  TunedController row = tuned_at(10.0);
  row.structure = state_space_name;
  row.design.tuning.controller = {reference::lag_loops_as_state_space().structure, {}};
  EXPECT_FALSE(adjustable_loop(TuningStudy{}, row).has_value());
  TuningStudy study;
  study.problem = reference::tracking_problem();
  study.wind_speeds = {10.0};
  study.controllers = {tuned_at(10.0), row};
  const auto beside = adjustable_loop(study, row);
  ASSERT_TRUE(beside.has_value());
  EXPECT_EQ(beside->structure, "PI");
  EXPECT_EQ(beside->controller.gains, reference::cautious_gains().gains);
  RecommendedDesign recommended;
  recommended.design = row.design;
  recommended.structure = row.design.tuning.controller.structure;
  recommended.loops = {"PI", tuned_at(10.0).design};
  const auto of_redesign = adjustable_loop(recommended);
  ASSERT_TRUE(of_redesign.has_value());
  EXPECT_EQ(of_redesign->structure, "PI");
  EXPECT_EQ(of_redesign->controller.gains, reference::cautious_gains().gains);
}

}  // namespace
}  // namespace boresight::design
