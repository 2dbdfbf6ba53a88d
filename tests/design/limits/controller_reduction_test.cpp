#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "refused_call.hpp"
#include <boresight/design/limits/controller_reduction.hpp>
#include <boresight/design/limits/lqg_search.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct DesignedLoop {
  SampledSetting setting = [] {
    TrackingProblem problem = reference::tracking_problem();
    problem.noise.torque_rms = 0.5;
    return SampledSetting("own", problem.plant, fit_wind_filter(problem), problem.noise, 0.02,
                          Eigen::ArrayXd::LinSpaced(40, 0.1, 150.0));
  }();
  double command_weight = 0.01;
  plant::StateSpace controller =
      weighted_lqg(setting, {.command_weight = command_weight, .friction_torque = 20.0});
};

TEST(ControllerReduction, KeepsTheLoopAtFullOrder) {
  const DesignedLoop loop;
  const ControllerReduction reduction(
      loop.controller, loop.setting.controller_gramians(loop.controller, loop.command_weight));
  const auto same = reduction.of_order(reduction.largest_order());
  const auto before = loop.setting.evaluate(loop.controller), after = loop.setting.evaluate(same);
  EXPECT_NEAR(after.boresight_rms / before.boresight_rms, 1.0, 1e-6);
  EXPECT_NEAR(after.control_effort / before.control_effort, 1.0, 1e-6);
  const auto& values = reduction.singular_values();
  for (Eigen::Index i = 1; i < values.size(); ++i) EXPECT_LE(values[i], values[i - 1]);
}

// Half the states carry next to nothing; a quarter does not do.
TEST(ControllerReduction, LosesLittleWithTheStatesThatContributeLittle) {
  const DesignedLoop loop;
  const ControllerReduction reduction(
      loop.controller, loop.setting.controller_gramians(loop.controller, loop.command_weight));
  const double rms = loop.setting.evaluate(loop.controller).boresight_rms;
  const Eigen::Index states = loop.controller.a.rows();
  EXPECT_NEAR(loop.setting.evaluate(reduction.of_order(states * 2 / 3)).boresight_rms / rms, 1.0,
              5e-3);
  const auto few = loop.setting.evaluate(reduction.of_order(2));
  EXPECT_TRUE(few.spectral_radius >= 1.0 || few.boresight_rms > 1.01 * rms);
}

// The coordinates of the controller do not matter, its inputs' and outputs' units neither.
TEST(ControllerReduction, DoesNotDependOnTheCoordinates) {
  const DesignedLoop loop;
  plant::StateSpace scaled = loop.controller;
  const Eigen::Index states = scaled.a.rows();
  // Reflected, which is its own inverse, and scaled.
  const Eigen::VectorXd normal = Eigen::VectorXd::LinSpaced(states, -1.0, 2.0).normalized();
  const Eigen::MatrixXd reflection =
      Eigen::MatrixXd::Identity(states, states) - 2.0 * normal * normal.transpose();
  const Eigen::VectorXd scale = Eigen::VectorXd::LinSpaced(states, 0.5, 20.0);
  const Eigen::MatrixXd there = reflection * scale.asDiagonal();
  const Eigen::MatrixXd back = scale.cwiseInverse().asDiagonal() * reflection;
  scaled.a = there * scaled.a * back;
  scaled.b = there * scaled.b;
  scaled.c = scaled.c * back;
  const auto reduced = [&](const plant::StateSpace& controller) {
    const ControllerReduction reduction(
        controller, loop.setting.controller_gramians(controller, loop.command_weight));
    return loop.setting.evaluate(reduction.of_order(12)).boresight_rms;
  };
  EXPECT_NEAR(reduced(scaled) / reduced(loop.controller), 1.0, 1e-6);
}

// Dearer commands raise the cost of a start by the sum of their squares, as the loop run sample by
// sample from that start gives it. The covariance does not depend on the cost.
TEST(ControllerReduction, CostToGoIsThatOfTheLoopRunFromAStart) {
  const DesignedLoop loop;
  const auto cheap = loop.setting.controller_gramians(loop.controller, 1.0);
  const auto dear = loop.setting.controller_gramians(loop.controller, 3.0);
  EXPECT_EQ(cheap.covariance, dear.covariance);
  const plant::StateSpace& plant = loop.setting.sampled().plant;
  const Eigen::Index states = loop.controller.a.rows();
  const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(states, -1.0, 1.0);
  Eigen::VectorXd own = start, other = Eigen::VectorXd::Zero(plant.a.rows());
  double sum = 0.0;
  for (int k = 0; k < 200000; ++k) {
    const Eigen::VectorXd seen = plant.c * other;
    const double command = (loop.controller.c * own + loop.controller.d * seen)[0];
    sum += command * command;
    own = loop.controller.a * own + loop.controller.b * seen;
    other = plant.a * other + plant.b.col(0) * command;
  }
  const double expected = start.dot((dear.cost_to_go - cheap.cost_to_go) * start) / 2.0;
  EXPECT_NEAR(sum / expected, 1.0, 1e-6);
}

TEST(ControllerReduction, RefusesOtherSizes) {
  const DesignedLoop loop;
  const auto gramians = loop.setting.controller_gramians(loop.controller, loop.command_weight);
  ControllerGramians small = gramians;
  small.covariance.conservativeResize(3, 3);
  EXPECT_THAT(reference::Call([&] { ControllerReduction(loop.controller, small); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 3 x 3")));
  const ControllerReduction reduction(loop.controller, gramians);
  EXPECT_THAT(reference::Call([&] { reduction.of_order(reduction.largest_order() + 1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected an order from 0 to")));
}

}  // namespace
}  // namespace boresight::design
