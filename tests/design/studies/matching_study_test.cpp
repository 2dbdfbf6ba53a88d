#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/matching_study.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

MatchOptions small_options() {
  MatchOptions options;
  options.points = 4;
  options.starts = 2;
  options.time_runs = MatchTimeRuns::none;
  options.variants = false;
  return options;
}

const MatchingStudy& small_study() {
  static const MatchingStudy study = study_matching(reference::demo_mission(), {}, small_options());
  return study;
}

std::string message_of(const MatchOptions& options) {
  try {
    study_matching(reference::demo_mission(), {}, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(MatchingStudy, MarksRatioOneAndAsBuiltAmongTheEvenlySpacedDisks) {
  const auto& points = small_study().points;
  ASSERT_EQ(points.size(), 5U);
  int on_grid = 0, unit = 0;
  for (const auto& point : points) {
    on_grid += point.on_grid ? 1 : 0;
    if (!point.unit_ratio) continue;
    ++unit;
    EXPECT_NEAR(point.motor_to_load_ratio, 1.0, 1e-9);
  }
  EXPECT_EQ(on_grid, 4);
  EXPECT_EQ(unit, 1);
  EXPECT_EQ(points.front().disks, 0.0);
  EXPECT_TRUE(points.back().as_built);
}

TEST(MatchingStudy, TunesTheMissionsStructuresAndVerifiesThem) {
  const auto& study = small_study();
  ASSERT_EQ(study.series.size(), 2U);
  EXPECT_TRUE(study.settled);
  EXPECT_EQ(study.members, 0U);
  EXPECT_FALSE(study.tuned_as_built);
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    const auto& plain = study.series[0].values[i];
    const auto& lagged = study.series[1].values[i];
    EXPECT_TRUE(plain.found && lagged.found);
    EXPECT_TRUE(plain.verification.passed) << plain.verification.failure;
    EXPECT_LT(lagged.boresight_rms, plain.boresight_rms * (1.0 + study.tolerance));
    EXPECT_FALSE(plain.time_domain);
  }
  for (const auto& series : study.series) {
    ASSERT_TRUE(series.best);
    EXPECT_LE(series.within_1_percent.lowest, study.points[*series.best].disks);
    EXPECT_GE(series.within_5_percent.highest, series.within_1_percent.highest);
  }
}

// Without a nonlinear drive what the supply's torque leaves beyond friction accelerates all of the
// inertia.
TEST(MatchingStudy, SlewsByNewtonWithoutANonlinearDrive) {
  Mission mission = reference::demo_mission();
  mission.antenna.nonlinear.reset();
  MatchOptions options = small_options();
  options.structures.loops = {mission.structures.loops.front()};
  const auto study = study_matching(mission, {}, options);
  EXPECT_FALSE(study.slew_by_simulation);
  const double ratio = plant::gear_ratio(mission.antenna);
  const double supply = mission.antenna.drive.supply_pressure *
                        plant::torque_per_pressure(mission.antenna.hydraulics);
  for (const auto& point : study.points) {
    const double friction =
        plant::friction_torque(mission.antenna.friction_curve, study.slew_rate * ratio);
    EXPECT_NEAR(point.acceleration * ratio * point.reflected_inertia, supply - friction,
                1e-9 * supply);
    EXPECT_NEAR(point.slew_time,
                study.slew_distance / study.slew_rate + study.slew_rate / point.acceleration, 1e-9);
  }
}

TEST(MatchingStudy, AnInterruptLeavesWhatWasWhole) {
  MatchOptions options = small_options();
  options.tune_as_built = true;
  int steps = 0;
  options.progress = [&](std::string_view, std::size_t, std::size_t) { ++steps; };
  options.interrupted = [&] { return steps >= 2; };
  const auto study = study_matching(reference::demo_mission(), {}, options);
  EXPECT_FALSE(study.series[1].curve.controllers.back().searched);
  EXPECT_FALSE(study.settled);
  EXPECT_FALSE(study.tuned_as_built);
}

TEST(MatchingStudy, SaysWhatItCannotWorkOn) {
  MatchOptions options = small_options();
  options.points = 3;
  EXPECT_EQ(message_of(options), "match: expected at least 4 points, found 3");
  options = small_options();
  options.max_disks = -1.0;
  EXPECT_EQ(message_of(options), "match: expected more than 0 disks at most, found -1");
}

}  // namespace
}  // namespace boresight::design
