#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_nonlinear_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::plant {
namespace {

// u = 0.5 (1 + 2/s) (rate_command - tachometer).
StateSpace rate_loop() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(1, 1);
  Eigen::MatrixXd b(1, 2);
  b << 1.0, -1.0;
  return {a,
          b,
          Eigen::MatrixXd::Constant(1, 1, 1.0),
          0.5 * b,
          {"rate_command", "tachometer"},
          {"valve_command"},
          {"rate_integral"}};
}

TEST(FeedbackInterconnection, LinearisesToTheLoopOfTheLinearisedAntenna) {
  const auto antenna = reference::nonlinear_antenna();
  const auto open = to_feedback_system(antenna);
  const auto loop = closed(open, rate_loop());
  EXPECT_THAT(std::vector<std::string>(loop.linear.inputs.begin(), loop.linear.inputs.begin() + 2),
              testing::ElementsAre("wind_torque", "rate_command"));
  const auto point = trim(antenna, {2.0, 0.0, {}});
  Eigen::VectorXd state(point.state.size() + 1);
  state << point.state, point.input[0];
  const auto small_loop = linearise(loop, state, Eigen::Vector2d(0.0, 2.0));
  const auto small_open = linearise(open, point.state, point.input);
  const auto expected = connect({small_open, rate_loop()}, {"wind_torque", "rate_command"},
                                {"tachometer", "beam", "valve_command"});
  const auto found = subsystem(small_loop, {"wind_torque", "rate_command"},
                               {"tachometer", "beam", "valve_command"});
  for (const double w : {0.01, 1.0, 5.3, 14.0, 70.0}) {
    const Eigen::MatrixXcd reference = frequency_response(expected, w);
    EXPECT_LT((frequency_response(found, w) - reference).norm(), 1e-10 * reference.norm());
  }
}

TEST(FeedbackInterconnection, RefusesAControllerThatDrivesNothing) {
  auto controller = rate_loop();
  controller.outputs = {"valve_comand"};
  try {
    closed(to_feedback_system(reference::nonlinear_antenna()), controller);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("valve_comand"));
  }
}

}  // namespace
}  // namespace boresight::plant
