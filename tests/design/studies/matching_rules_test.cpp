#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/matching_rules.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {
namespace {

// Two points with straight lines between them.
MatchingStudy two_points(double first_rms, double last_rms) {
  MatchingStudy study;
  study.points = {{.disks = 0.0, .motor_to_load_ratio = 0.01}, {.disks = 1000.0}};
  MatchSeries series;
  series.values.resize(2);
  series.values[0].boresight_rms = first_rms;
  series.values[1].boresight_rms = last_rms;
  for (auto& value : series.values) value.found = true;
  series.best = first_rms < last_rms ? 0U : 1U;
  study.series.push_back(series);
  return study;
}

TEST(MatchingRules, AskForTheInertiaTheyAreNamedAfter) {
  const Mission mission = reference::demo_mission();
  const auto rules = evaluate_rules(mission, two_points(1.0, 2.0));
  ASSERT_EQ(rules.size(), 4U);
  EXPECT_EQ(rules.front().rule, ClassicRule::one_to_one);
  EXPECT_EQ(rules.back().rule, ClassicRule::no_flywheels);
  EXPECT_EQ(rules.back().motor_to_load_ratio, 0.01);
  const double load =
      plant::gear_train_inertia(mission.antenna) + plant::antenna_inertia(mission.antenna);
  for (const auto& rule : rules) {
    if (!rule.disks || rule.rule == ClassicRule::no_flywheels) continue;
    const double motors = plant::motor_inertia(
        changed(mission.antenna, {plant::set_to("motor.flywheel_disks", *rule.disks)}));
    EXPECT_NEAR(motors / load, rule.motor_to_load_ratio, 1e-9);
  }
}

TEST(MatchingRules, CostWhatTheStraightLineGivesThere) {
  const auto rules = evaluate_rules(reference::demo_mission(), two_points(1.0, 2.0));
  EXPECT_EQ(rules.back().cost.front(), 0.0);
  ASSERT_TRUE(rules.front().disks);
  EXPECT_NEAR(rules.front().cost.front(), *rules.front().disks / 1000.0, 1e-12);
}

TEST(MatchingRules, CostIsNotKnownBesideAPointWithoutAController) {
  MatchingStudy study = two_points(1.0, 2.0);
  study.series.front().values[1].found = false;
  for (const auto& rule : evaluate_rules(reference::demo_mission(), study)) {
    EXPECT_TRUE(std::isnan(rule.cost.front()));
  }
}

}  // namespace
}  // namespace boresight::design
