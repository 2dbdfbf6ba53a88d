#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/verification/stable_gain.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

control::Controller states(double factor) {
  return control::with_output_times(factor, reference::lag_loops_as_state_space());
}

TEST(StableGain, IsOneOfAStableLoop) {
  EXPECT_EQ(largest_stable_factor(reference::tracking_problem(), states(1.0)), 1.0);
}

TEST(StableGain, IsTheEdgeOfStability) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto found = largest_stable_factor(problem, states(50.0));
  ASSERT_TRUE(found);
  const auto stable = [&](double factor) {
    return control::stability(problem.plant, states(50.0 * factor), problem.delay, {}).stable();
  };
  EXPECT_TRUE(stable(*found));
  EXPECT_FALSE(stable(1.02 * *found));
  // The same edge, whatever the output was.
  EXPECT_NEAR(50.0 * *found / (30.0 * largest_stable_factor(problem, states(30.0)).value_or(0.0)),
              1.0, 0.02);
}

TEST(StableGain, IsNoneWhereTheSignIsWrong) {
  EXPECT_FALSE(largest_stable_factor(reference::tracking_problem(), states(-1.0)));
}

TEST(StableGain, RefusesGains) {
  EXPECT_THAT(reference::Call([] {
                largest_stable_factor(reference::tracking_problem(), reference::cautious_gains());
              }),
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("expected a state space")));
}

}  // namespace
}  // namespace boresight::design
