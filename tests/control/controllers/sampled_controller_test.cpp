#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double period = 0.02;

// Gains that keep the reference antenna's loops stable.
Controller cautious(const LoopStructure& structure) {
  Controller controller{structure, {}};
  const std::map<std::string, double> values{
      {"kr", 0.3},  {"wi", 1.0}, {"wp", 8.0}, {"wz", 12.0}, {"kT", 0.002}, {"wd", 2.0}, {"kp", 0.3},
      {"wip", 0.1}, {"wn", 20.}, {"zz", 0.1}, {"zp", 0.7},  {"cs", 0.002}, {"wcs", 1.0}};
  for (const auto& gain : structure.gains()) controller.gains.push_back(values.at(gain.symbol));
  return controller;
}

TEST(SampledController, HasTheSignalsOfTheController) {
  const auto controller = sampled_controller(cautious(LoopStructure::full()), period);
  EXPECT_THAT(controller.inputs, ElementsAre("tachometer", "encoder", "angle_reference",
                                             "rate_disturbance", "motor_torque"));
  EXPECT_THAT(controller.outputs, ElementsAre("valve_demand", "rate_command"));
  EXPECT_EQ(controller.sample_time, period);
  EXPECT_EQ(controller.b.col(1), -controller.b.col(2));
  const auto rate = sampled_rate_loop_controller(cautious(LoopStructure::pi()), period);
  EXPECT_THAT(rate.inputs, ElementsAre("tachometer"));
  EXPECT_THAT(rate.outputs, ElementsAre("valve_demand"));
}

// Halving the sample time quarters the error of every channel.
TEST(SampledController, ConvergesAtSecondOrderToTheContinuousController) {
  for (const LoopStructure& structure : reference::loop_structures()) {
    SCOPED_TRACE(structure.name());
    const Controller controller = cautious(structure);
    const auto continuous = to_state_space(controller);
    const auto error = [&](double sample_time) {
      const auto sampled = plant::subsystem(sampled_controller(controller, sample_time),
                                            continuous.inputs, continuous.outputs);
      double worst = 0.0;
      for (const double w : {0.3, 2.0, 9.0, 25.0}) {
        const Eigen::MatrixXcd exact = plant::frequency_response(continuous, w);
        const Eigen::MatrixXcd found = plant::frequency_response(sampled, w);
        worst = std::max(
            worst, ((found - exact).array().abs() / exact.array().abs().max(1e-12)).maxCoeff());
      }
      return worst;
    };
    const double coarse = error(2e-3), fine = error(1e-3);
    EXPECT_LT(coarse, 1e-2);
    EXPECT_NEAR(coarse / fine, 4.0, 0.05);
  }
}

TEST(SampledController, KeepsTheResponseOfEachBlockAtItsCorner) {
  // Only the position path's gain, and one block of the rate path.
  const auto rate = [](BlockKind kind, std::vector<GainDescription> gains) {
    return LoopStructure("one block",
                         {{LoopPath::rate, BlockKind::gain, {{"g", "g", "1", 0.01, 10.0}}},
                          {LoopPath::rate, kind, std::move(gains)},
                          {LoopPath::position, BlockKind::gain, {{"p", "p", "1", 0.01, 10.0}}}});
  };
  const GainDescription corner{"corner", "w", "rad/s", 0.1, 300.0};
  for (const double w : {3.0, 40.0, 78.0}) {
    const Controller lag{rate(BlockKind::lag, {corner}), {2.0, w, 1.0}};
    const Complex found =
        plant::frequency_response(sampled_rate_loop_controller(lag, period), w)(0, 0);
    EXPECT_LT(std::abs(found + 2.0 / Complex(1.0, 1.0)), 1e-12) << w;
  }
  const GainDescription top{"top", "zz", "1", 1e-3, 1.0}, bottom{"bottom", "zp", "1", 0.05, 2.0};
  for (const double w : {20.0, 100.0, 140.0}) {
    const Controller notch{rate(BlockKind::notch, {corner, top, bottom}), {1.0, w, 0.05, 0.5, 1.0}};
    const Complex found =
        plant::frequency_response(sampled_rate_loop_controller(notch, period), w)(0, 0);
    EXPECT_LT(std::abs(found + 0.1), 1e-11) << w;
  }
}

TEST(SampledController, StaysStableAndSlowlyChangingBeyondTheNyquistFrequency) {
  Controller controller = cautious(LoopStructure::pressure_feedback());
  double last = 0.0;
  for (const double corner : {78.0, 79.0, 150.0, 157.0, 158.0, 300.0, 3000.0}) {
    controller.gains[2] = corner;
    const double warped = prewarped(controller, period).gains[2];
    EXPECT_GT(warped, last);  // no jump back, none to infinity
    EXPECT_LT(warped, 1.3 * corner);
    last = warped;
    const auto rate = sampled_rate_loop_controller(controller, period);
    for (const Complex& pole : numerics::eigenvalues(rate.a)) {
      EXPECT_LT(std::abs(pole - 1.0) < 1e-9 ? 0.0 : std::abs(pole), 1.0) << corner;
    }
  }
  // A lag far beyond passes what is below: within 2 % and one degree at 1 Hz.
  controller.gains[2] = 3000.0;
  const double w = two_pi;
  const Complex far =
      plant::frequency_response(sampled_rate_loop_controller(controller, period), w)(0, 0);
  const Complex exact = plant::frequency_response(rate_loop_controller(controller), w)(0, 0);
  EXPECT_LT(std::abs(far / exact - 1.0), 0.02);
}

// The dead time of the continuous form is one sample of computation and half a hold.
TEST(SampledController, EvaluatesDesignsLikeTheContinuousFormWithItsDeadTime) {
  const auto antenna = reference::antenna();
  const auto plant = plant::to_state_space(antenna);
  const Eigen::ArrayXd frequency =
      Eigen::ArrayXd::LinSpaced(400, std::log(0.01), std::log(600.0)).exp();
  int stable = 0, unstable = 0;
  for (const LoopStructure& structure : reference::loop_structures()) {
    for (const double factor : {0.5, 1.0, 30.0}) {
      Controller controller = cautious(structure);
      controller.gains[0] *= factor;
      const bool continuous =
          stability(antenna, controller, reference::delay, frequency).closed_loop_abscissa < 0.0;
      const auto loop = sampled_closed_loop(sampled_loop(plant, controller, period));
      const bool sampled = numerics::eigenvalues(loop.a).cwiseAbs().maxCoeff() < 1.0;
      EXPECT_EQ(continuous, sampled) << structure.name() << " " << factor;
      ++(sampled ? stable : unstable);
    }
  }
  EXPECT_GT(stable, 7);
  EXPECT_GT(unstable, 3);
}

TEST(SampledController, LeavesOnlyTheFreeAngleWithThePositionLoopOpen) {
  const auto plant = plant::to_state_space(reference::antenna());
  const auto loop = sampled_closed_loop(
      sampled_rate_loop(plant, cautious(LoopStructure::pressure_feedback()), period));
  int at_one = 0;
  for (const Complex& pole : numerics::eigenvalues(loop.a)) {
    if (std::abs(pole - 1.0) < 1e-6) {
      ++at_one;
    } else {
      EXPECT_LT(std::abs(pole), 1.0);
    }
  }
  EXPECT_EQ(at_one, 1);
}

TEST(SampledController, RefusesWhatIsNoSampleTime) {
  const Controller controller = cautious(LoopStructure::pi());
  EXPECT_THAT(reference::Call([&] { sampled_controller(controller, 0.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a sample time above 0, found 0 s")));
  EXPECT_THAT(reference::Call([&] { sampled_rate_loop_controller(controller, std::nan("")); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a sample time above 0, found nan")));
  EXPECT_THAT(reference::Call([&] {
                sampled_controller({LoopStructure::pi(), {1.0}}, period);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected 4 gains")));
}

}  // namespace
}  // namespace boresight::control
