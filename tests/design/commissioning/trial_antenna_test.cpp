#include <atomic>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/design/commissioning/trial_antenna.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TEST(ForEachPlant, VisitsEachOnceAndReportsInOrder) {
  std::vector<std::atomic<int>> visits(130);
  std::vector<std::size_t> reported;
  TrialOptions options;
  options.threads = 2;
  options.progress = [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 130U);
    reported.push_back(done);
  };
  for_each_plant(10, 130, options, [&](std::size_t i) { ++visits[i]; });
  for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i], i < 10 ? 0 : 1);
  EXPECT_THAT(reported, testing::ElementsAre(60, 110, 130));
  options.stop = [] { return true; };
  EXPECT_THROW(for_each_plant(0, 1, options, [](std::size_t) {}), Interrupted);
}

// The loop is of the changed plant, the feedforward of the unchanged one.
TEST(TrialAntenna, KeepsTheFeedforwardOfTheUnchangedAntenna) {
  const auto& planned = reference::planned_stages();
  const StageController& last = planned.plan.stages.back().controller;
  const TrialAntenna antenna(planned.mission, planned.move);
  const std::vector<plant::AntennaChange> heavier{plant::scaled_by("at_shaft.motor_inertia", 3.0)};
  const double mismatched = antenna.observer(heavier).observe(last).move_error;
  TrackingProblem own = tracking_problem(planned.mission);
  own.plant = plant::linear_plant(plant::changed(planned.mission.antenna, heavier));
  const double matched =
      StageObserver(own, own.plant, WindTable(own), planned.move).observe(last).move_error;
  EXPECT_GT(std::abs(mismatched - matched), 0.02 * matched);
  EXPECT_DOUBLE_EQ(
      antenna.observer({}).observe(last).move_error,
      StageObserver(tracking_problem(planned.mission), tracking_problem(planned.mission).plant,
                    WindTable(tracking_problem(planned.mission)), planned.move)
          .observe(last)
          .move_error);
}

}  // namespace
}  // namespace boresight::design
