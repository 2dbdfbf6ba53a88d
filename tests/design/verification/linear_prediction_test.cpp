#include <cmath>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

constexpr double sample_time = 0.02;

control::Controller leaky_controller() {
  return reference::lag_loops();
}

control::Controller sampled(const control::Controller& controller) {
  return control::state_space_controller(
      "sampled", plant::subsystem(control::sampled_controller(controller, sample_time),
                                  {"tachometer", "encoder"}, {"valve_demand"}));
}

TEST(LinearPrediction, IsTheSameOfLoopsAndOfTheirSampledForm) {
  const TrackingProblem problem = reference::tracking_problem();
  // Sampling changes the response by the square of the frequency over the sampling rate.
  const Eigen::ArrayXd frequency = Eigen::Array4d(1e-3, 0.05, 0.3, 1.0);
  const Eigen::ArrayXd loops = wind_transmission(problem, leaky_controller(), frequency);
  const Eigen::ArrayXd states = wind_transmission(problem, sampled(leaky_controller()), frequency);
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    EXPECT_NEAR(states[i] / loops[i], 1.0, 1e-6 + 1e-3 * frequency[i] * frequency[i])
        << frequency[i];
  }
  EXPECT_NEAR(predicted_rms(problem, sampled(leaky_controller())) /
                  predicted_rms(problem, leaky_controller()),
              1.0, 1e-3);
}

// By the spectrum in the band, and by the covariance of the sampled loop in wind by its filter.
TEST(LinearPrediction, OfAStateSpaceIsThatOfItsCovariance) {
  TrackingProblem problem = reference::tracking_problem();
  problem.noise.torque_rms = 0.5;
  const SampledSetting setting("own", problem.plant, fit_wind_filter(problem), problem.noise,
                               sample_time, Eigen::ArrayXd::LinSpaced(30, 0.1, 150.0));
  const auto controller = sampled(leaky_controller());
  const auto evaluated = setting.evaluate(
      plant::renamed(*controller.structure.state_space(), {{"valve_demand", "valve_command"}}));
  EXPECT_NEAR(predicted_rms(problem, controller) / evaluated.boresight_rms, 1.0, 1e-3);
}

// A loop that integrates the angle holds the encoder still, and the structure bends beyond it.
TEST(LinearPrediction, StaticErrorOfAnIntegratingLoopIsTheFlexure) {
  const TrackingProblem problem = reference::tracking_problem();
  const double flexure = std::abs(static_bending(problem));
  EXPECT_NEAR(static_boresight_error(problem, reference::cautious_gains()), flexure,
              1e-5 * flexure);
}

// Of one without, the mean torque's leakage flow is a rate error that the position error commands:
// u = lambda T/K = R(0) P(0) error.
TEST(LinearPrediction, StaticErrorOfALeakyLoopIsThatOfItsGain) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto& drive = problem.plant.drive;
  const double torque =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
  const double demand = drive.leakage_rate / drive.oil_stiffness * torque;
  const control::Controller controller = leaky_controller();
  const double static_gain = control::gain(controller, "kr") * control::gain(controller, "kp");
  const double encoder = demand / static_gain / problem.gear_ratio;
  const double expected = std::abs(static_bending(problem)) + encoder;
  EXPECT_NEAR(static_boresight_error(problem, controller), expected, 1e-5 * expected);
  EXPECT_NEAR(static_boresight_error(problem, sampled(controller)), expected, 1e-5 * expected);
  EXPECT_GT(encoder, 0.05 * expected);
  EXPECT_NEAR(static_encoder_error(problem, controller), encoder, 1e-12 * encoder);
  EXPECT_NEAR(static_encoder_error(problem, sampled(controller)), encoder, 1e-9 * encoder);
  EXPECT_EQ(static_encoder_error(problem, reference::cautious_gains()), 0.0);
}

}  // namespace
}  // namespace boresight::design
