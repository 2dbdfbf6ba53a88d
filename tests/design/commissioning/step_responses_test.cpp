#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/commissioning/step_responses.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd staircase(Index samples, Index every, double size) {
  VectorXd values(samples);
  for (Index k = 0; k < samples; ++k) values[k] = size * static_cast<double>(k / every);
  return values;
}

TEST(IsSteady, OfRestMotionAndResolutionButNotOfSteps) {
  EXPECT_TRUE(is_steady(VectorXd::Constant(100, 3.0)));
  EXPECT_TRUE(is_steady(VectorXd::LinSpaced(100, 0.0, 1.0)));
  EXPECT_TRUE(is_steady(staircase(1000, 25, 1e-5)));
  EXPECT_FALSE(is_steady(staircase(1000, 250, 1.0)));
  VectorXd square = VectorXd::Zero(1000);
  for (Index k = 0; k < 1000; ++k) square[k] = (k / 100) % 2 == 1 ? 1.0 : 0.0;
  EXPECT_FALSE(is_steady(square));
}

TEST(StepsOf, AreShortChangesNotMotions) {
  VectorXd command = VectorXd::Zero(600);
  command.segment(200, 200).setConstant(1.0);
  const auto steps = steps_of(command);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].first, 199);
  EXPECT_EQ(steps[0].behind, 200);
  // Split over two samples by interpolation.
  command[200] = 0.4;
  EXPECT_EQ(steps_of(command)[0].behind, 201);
  EXPECT_EQ(steps_of(command).size(), 2U);
  VectorXd ramp = VectorXd::Zero(600);
  for (Index k = 200; k < 300; ++k) ramp[k] = 0.01 * static_cast<double>(k - 199);
  ramp.tail(300).setConstant(1.0);
  EXPECT_TRUE(steps_of(ramp).empty());
}

TEST(StepResponses, AreOverTheStepAboutTheMotionBeforeIt) {
  identification::Signal command, response;
  command.values = response.values = VectorXd::LinSpaced(400, 0.0, 399.0) * 1e-3;
  command.values.tail(200).array() += 2.0;
  response.values.tail(200).array() += 1.0;
  auto found = step_responses(command, response, steps_of(command.values), 50);
  ASSERT_EQ(found.single.size(), 1U);
  EXPECT_NEAR(found.size, 2.0, 1e-9);
  EXPECT_TRUE(found.single[0].isApprox(VectorXd::Constant(200, 0.5), 1e-9));
  EXPECT_NEAR(found.noise, 0.0, 1e-9);
  // One sample that is not valid, or too little time.
  response.valid.assign(400, true);
  response.valid[300] = false;
  found = step_responses(command, response, steps_of(command.values), 50);
  EXPECT_TRUE(found.single.empty());
  EXPECT_EQ(found.masked, 1U);
  EXPECT_EQ(step_responses(command, response, steps_of(command.values), 300).hurried, 1U);
}

}  // namespace
}  // namespace boresight::design
