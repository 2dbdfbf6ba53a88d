#include <cmath>

#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::design {
namespace {

TrackingProblem problem() {
  TrackingProblem problem;
  problem.plant = reference::antenna();
  problem.gear_ratio = reference::gear_ratio();
  problem.wind = {reference::wind_site(), plant::WindModel::coherence, 10.0};
  return problem;
}

// With the encoder fixed, the boresight follows the wind torque by the springs alone at low
// frequency.
TEST(StaticBending, IsTheLimitOfTheStructuresResponse) {
  const TrackingProblem own = problem();
  const auto response =
      plant::structure_response(own.plant.structure, Eigen::ArrayXd::Constant(1, 1e-4));
  const double torque =
      plant::mean_wind_torque(own.wind.site, own.wind.mean_speed) / own.gear_ratio;
  EXPECT_NEAR(
      static_bending(own) / (response.boresight_per_wind.real()(0) * torque / own.gear_ratio), 1.0,
      1e-6);
}

TEST(StaticBending, GrowsWithTheSquareOfTheSpeed) {
  TrackingProblem windy = problem();
  windy.wind.mean_speed *= 2.0;
  EXPECT_NEAR(static_bending(windy) / static_bending(problem()), 4.0, 1e-12);
}

}  // namespace
}  // namespace boresight::design
