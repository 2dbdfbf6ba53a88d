#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/problem/mean_wind_load.hpp>

namespace boresight::design {
namespace {

// Twice the wind has four times of both; half the leakage needs half the flow.
TEST(MeanWindLoad, GrowsWithTheSquareOfTheWindAndItsFlowWithTheLeakage) {
  TrackingProblem problem = reference::tracking_problem();
  const MeanWindLoad load = mean_wind_load(problem);
  EXPECT_GT(load.torque, 0.0);
  EXPECT_NEAR(load.demand * problem.plant.drive.oil_stiffness,
              load.torque * problem.plant.drive.leakage_rate, 1e-12 * load.torque);
  problem.wind.mean_speed *= 2.0;
  problem.plant.drive.leakage_rate *= 0.5;
  EXPECT_NEAR(mean_wind_load(problem).torque, 4.0 * load.torque, 1e-12 * load.torque);
  EXPECT_NEAR(mean_wind_load(problem).demand, 2.0 * load.demand, 1e-12 * load.demand);
}

}  // namespace
}  // namespace boresight::design
