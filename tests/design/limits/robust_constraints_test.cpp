#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/limits/lqg_search.hpp>
#include <boresight/design/limits/robust_constraints.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Plants {
  TrackingProblem problem = [] {
    TrackingProblem result = reference::tracking_problem();
    result.noise.torque_rms = 0.5;
    return result;
  }();
  Eigen::ArrayXd frequency = plant::frequency_grid(problem.plant, 1e-3, 24.9, 60);

  SampledSetting with_friction(double friction) const {
    plant::AntennaPlant plant = problem.plant;
    plant.drive.viscous_friction = friction;
    return {"plant", plant, fit_wind_filter(problem), problem.noise, 0.02, frequency};
  }
};

// Loops on a plant and on one at standstill.
struct Loops {
  std::vector<SampledSetting> moving, held, none;
  plant::StateSpace controller;
  Eigen::ArrayXXcd response;  // of the controller
};

Loops loops_on(const Plants& plants) {
  Loops result{{plants.with_friction(0.9)}, {plants.with_friction(5.0)}, {}, {}, {}};
  result.controller =
      control::sampled_loop(result.moving.front().problem().plant, reference::lag_loops(), 0.02)
          .controller;
  result.response = SampledSetting::controller_response(result.controller, plants.frequency);
  return result;
}

TEST(RobustConstraints, ExcessIsTheLargestRatioToAGoal) {
  const Plants plants;
  const auto [moving, held, none, controller, response] = loops_on(plants);
  const double peak = moving.front().highest_peak(response).magnitude;
  const double held_peak = held.front().highest_peak(response).magnitude;
  const double effort = moving.front().control_effort(controller);
  ASSERT_LT(held.front().spectral_radius(controller), 1.0);
  ASSERT_GT(held_peak, 1.31);
  const auto excess = [&](const SampledLoopGoals& goals) {
    return RobustConstraints({moving, held, none}, goals, 1).excess(controller);
  };
  EXPECT_LE(excess({1.01 * peak, 1.01 * effort, 1.01 * held_peak}), 0.0);
  EXPECT_NEAR(excess({peak / 1.1, 2.0 * effort, 2.0 * held_peak}), std::log(1.1), 2e-3);
  EXPECT_NEAR(excess({2.0 * peak, effort / 1.2, 2.0 * held_peak}), std::log(1.2), 2e-3);
  EXPECT_NEAR(excess({2.0 * peak, 2.0 * effort, held_peak / 1.3}), std::log(1.3), 2e-3);
  EXPECT_DOUBLE_EQ(RobustConstraints({moving, held, none}, {}, 1).largest_rms(controller),
                   moving.front().boresight_rms(controller));
}

// A gain of the encoder is one of the controller from there.
TEST(RobustConstraints, CountThePeakAtAnEdgeOfTheEncoder) {
  const Plants plants;
  const std::vector<SampledSetting> moving{plants.with_friction(0.9)}, none;
  auto controller =
      control::sampled_loop(moving.front().problem().plant, reference::lag_loops(), 0.02)
          .controller;
  plant::AntennaPlant held = plants.problem.plant;
  held.drive.viscous_friction = 5.0;
  const auto setting = [&](double gain) {
    return SampledSetting("edge", held, fit_wind_filter(plants.problem), plants.problem.noise, 0.02,
                          plants.frequency, gain);
  };
  const std::vector<SampledSetting> at_edges{setting(1.4)};
  const double peak =
      at_edges.front()
          .highest_peak(SampledSetting::controller_response(controller, plants.frequency))
          .magnitude;
  EXPECT_NEAR(RobustConstraints({moving, none, at_edges}, {1e3, 1e3, 1e3, peak / 1.2}, 1)
                  .excess(controller),
              std::log(1.2), 2e-3);
  // As a corner it counts against the goal of the plants.
  EXPECT_NEAR(
      RobustConstraints({.plants = at_edges, .corners = at_edges}, {peak / 1.3, 1e3, 1e3, 1e3}, 1)
          .excess(controller),
      std::log(1.3), 2e-3);
  const double radius = at_edges.front().spectral_radius(controller);
  const auto encoder = std::ranges::find(controller.inputs, "encoder") - controller.inputs.begin();
  controller.b.col(encoder) *= 1.4;
  controller.d.col(encoder) *= 1.4;
  EXPECT_NEAR(setting(1.0).spectral_radius(controller), radius, 1e-12);
  EXPECT_NEAR(setting(1.0)
                  .highest_peak(SampledSetting::controller_response(controller, plants.frequency))
                  .magnitude,
              peak, 1e-9 * peak);
  // So large a gain that the loop is unstable.
  const std::vector<SampledSetting> unstable{setting(50.0)};
  const auto with = [&](const std::vector<SampledSetting>& edges) {
    return RobustConstraints({moving, none, edges}, {1e9, 1e9, 1e9, 1e9}, 1);
  };
  EXPECT_TRUE(with(none).stable(controller));
  EXPECT_FALSE(with(unstable).stable(controller));
  EXPECT_EQ(with(unstable).excess(controller), 3.0);
}

// 1 + L of the whole loop is (1 + L of tachometer and torque)(1 + L of the position loop).
TEST(RobustConstraints, ThePositionLoopIsCutAtTheEncoderAlone) {
  const Plants plants;
  const auto [moving, held, none, controller, response] = loops_on(plants);
  plant::StateSpace rest = controller;
  const auto encoder = std::ranges::find(rest.inputs, "encoder") - rest.inputs.begin();
  rest.b.col(encoder).setZero();
  rest.d.col(encoder).setZero();
  const auto sensitivity = [&](const SampledSetting& setting, const plant::StateSpace& of) {
    return sensitivity_function(sampled_spectrum(setting, plants.frequency),
                                SampledSetting::controller_response(of, plants.frequency));
  };
  const auto position_peak = [&](const SampledSetting& setting) {
    return (sensitivity(setting, controller) / sensitivity(setting, rest)).abs().maxCoeff();
  };
  const double peak = position_peak(moving.front()), at_rest = position_peak(held.front());
  EXPECT_NEAR(moving.front().highest_position_peak(response).magnitude, peak, 2e-3 * peak);

  const SampledLoopGoals goals{1e3, 1e3, 10.0 * at_rest, 1e3, peak / 1.1};
  const RobustConstraints limited({moving, held, none}, goals, 1);
  EXPECT_NEAR(limited.excess(controller), std::log(1.1), 4e-3);
  EXPECT_EQ(limited.excess(controller, limited.peaks(controller)), limited.excess(controller));
  const Eigen::VectorXd ratios = limited.peaks(controller);
  ASSERT_EQ(ratios.size(), 4);
  EXPECT_NEAR(ratios[0],
              std::log(moving.front().highest_peak(response).magnitude / goals.sensitivity_peak),
              1e-12);
  EXPECT_NEAR(ratios[2], std::log(1.1), 3e-3);
  EXPECT_NEAR(ratios[3], std::log(0.1), 3e-3);
  EXPECT_EQ(RobustConstraints({moving, held, none}, {1e3, 1e3, 1e3}, 1).peaks(controller).size(),
            2);

  const Eigen::VectorXd rms = limited.rms(controller);
  ASSERT_EQ(rms.size(), 2);
  EXPECT_DOUBLE_EQ(rms[0], limited.largest_rms(controller));
  EXPECT_DOUBLE_EQ(rms[1], held.front().boresight_rms(controller));
}

// The gain is that of the loop without its encoder, from the encoder's input of the controller.
TEST(RobustConstraints, LimitTheGainFromEncoderToTorqueOfALockedMotor) {
  const Plants plants;
  const auto [moving, held, none, controller, response] = loops_on(plants);
  const std::vector<SampledSetting> motor_locked{plants.with_friction(1e7)};
  const plant::StateSpace& plant = motor_locked.front().sampled().plant;
  const plant::StateSpace all = from_sensors(controller);
  const Eigen::Index n = plant.a.rows(), m = all.a.rows();
  const SampledPeak peak = motor_locked.front().highest_locked_motor_gain(response);
  const auto z = std::polar(1.0, peak.frequency * 0.02);
  Eigen::MatrixXd a(n + m, n + m), feedback = all.d, into = all.b;
  feedback.col(1).setZero();
  into.col(1).setZero();
  a << plant.a + plant.b * feedback * plant.c, plant.b * all.c, into * plant.c, all.a;
  Eigen::VectorXd b(n + m);
  b << plant.b * all.d(0, 1), all.b.col(1);
  const Eigen::VectorXcd state = (z * Eigen::MatrixXcd::Identity(n + m, n + m) - a)
                                     .fullPivLu()
                                     .solve(b.cast<std::complex<double>>());
  EXPECT_NEAR(std::abs((plant.c.row(2) * state.head(n)).value()), peak.magnitude,
              1e-3 * peak.magnitude);

  SampledLoopGoals goals{1e3, 1e3, 1e3, 1e3};
  goals.locked_motor_gain = peak.magnitude / 1.2;
  const RobustConstraints limited({.plants = moving, .motor_locked = motor_locked}, goals, 1);
  EXPECT_NEAR(limited.excess(controller), std::log(1.2), 2e-3);
  ASSERT_EQ(limited.peaks(controller).size(), 2);
  EXPECT_NEAR(limited.peaks(controller)[1], std::log(1.2), 1e-12);
  goals.locked_motor_gain.reset();
  EXPECT_EQ(RobustConstraints({.plants = moving, .motor_locked = motor_locked}, goals, 1)
                .peaks(controller)
                .size(),
            1);
}

TEST(RobustConstraints, AnUnstableLoopExceedsEveryGoal) {
  const Plants plants;
  const std::vector<SampledSetting> moving{plants.with_friction(0.9)}, none;
  auto controller = weighted_lqg(moving.front(), {.command_weight = 0.05});
  controller.c *= -1.0;
  controller.d *= -1.0;
  ASSERT_GT(moving.front().spectral_radius(controller), 1.0);
  EXPECT_EQ(RobustConstraints({moving, none, none}, {1e9, 1e9, 1e9}, 2).excess(controller), 3.0);
}

TEST(RobustConstraints, AControllerThatIsUnstableByItselfExceedsThemToo) {
  const Plants plants;
  const std::vector<SampledSetting> moving{plants.with_friction(0.9)}, none;
  const auto controller = weighted_lqg(
      moving.front(), {.command_weight = 0.05, .input_noise = 1e-3, .friction_torque = 20.0});
  ASSERT_LT(moving.front().spectral_radius(controller), 1.0);
  ASSERT_GT(numerics::spectral_radius(controller.a), 1.0);
  EXPECT_EQ(RobustConstraints({moving, none, none}, {1e9, 1e9, 1e9}, 1).excess(controller), 3.0);
}

TEST(RobustConstraints, RefuseWhatCannotBeCompared) {
  const Plants plants;
  const std::vector<SampledSetting> one{plants.with_friction(0.9)}, none;
  const auto constraints = [&none](const std::vector<SampledSetting>& moving,
                                   const std::vector<SampledSetting>& held,
                                   const SampledLoopGoals& goals) {
    return [&moving, &held, &none, goals] {
      (void)RobustConstraints({moving, held, none}, goals, 1);
    };
  };
  EXPECT_THAT(constraints(none, none, {}),
              ThrowsMessage<InvalidInput>(HasSubstr("at least one plant")));
  const std::vector<SampledSetting> other{{"other", plants.problem.plant,
                                           fit_wind_filter(plants.problem), plants.problem.noise,
                                           0.02, 0.99 * plants.frequency}};
  EXPECT_THAT(constraints(one, other, {}),
              ThrowsMessage<InvalidInput>(HasSubstr("the same frequencies")));
  EXPECT_THAT(
      constraints(one, none, {2.0, 0.0, 3.0}),
      ThrowsMessage<InvalidInput>(HasSubstr("control effort and a gain above 0, found 2, 3 at "
                                            "standstill, 2.5 at an edge and 0 rad/s")));
  EXPECT_THAT(constraints(one, none, {2.0, 0.6, 3.0, 2.5, 2.0, -4.0}),
              ThrowsMessage<InvalidInput>(HasSubstr("0.6 rad/s, -4 N.m/rad")));
}

}  // namespace
}  // namespace boresight::design
