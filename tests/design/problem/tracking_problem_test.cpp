#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::design {
namespace {

using reference::relative_error;

TEST(MotorWindSpectrum, IsTheAxisTorqueThroughTheGears) {
  const TrackingProblem problem = reference::tracking_problem();
  Eigen::ArrayXd w(3);
  w << 0.01, 1.0, 50.0;
  const auto found = motor_wind_spectrum(problem.wind, problem.gear_ratio, w);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double axis = plant::wind_torque_spectrum(problem.wind.site, plant::WindModel::coherence,
                                                    10.0, w[i] / two_pi);
    EXPECT_LT(relative_error(found[i] * 8.250479e8, axis), 1e-6);
  }
}

TEST(MakeEvaluator, SpansTheBandOfTheProblem) {
  const auto problem = reference::tracking_problem();
  const auto evaluator = make_evaluator(problem);
  const Eigen::ArrayXd& w = evaluator.response().frequency;
  EXPECT_NEAR(w[0], two_pi * 1e-4, 1e-12);
  EXPECT_NEAR(w[w.size() - 1], 8.0 * problem.plant.drive.valve_corner, 1e-9);
  EXPECT_LT((w - two_pi * 25.0).abs().minCoeff(), 1e-9);
  EXPECT_EQ(evaluator.delay(), 0.03);
}

// The rms against speed of one controller.
class RmsAtSpeed {
 public:
  RmsAtSpeed() {
    const auto evaluation = evaluator_.evaluate(controller_, false);
    stable_ = evaluation.stable();
    design_rms_ = std::sqrt(evaluation.boresight_variance()) / problem_.gear_ratio;
    noise_ = evaluation.noise_variance;
    transmission_ = evaluator_.wind_transmission(controller_);
  }
  double at(double speed) const {
    return boresight_rms_at_speed(problem_, evaluator_, transmission_, noise_, speed);
  }
  double limit(double budget) const {
    return wind_speed_limit(problem_, evaluator_, controller_, noise_, budget);
  }
  double floor() const { return std::sqrt(noise_) / problem_.gear_ratio; }
  double design_rms() const { return design_rms_; }
  bool stable() const { return stable_; }

 private:
  TrackingProblem problem_ = reference::tracking_problem();
  control::LoopEvaluator evaluator_ = make_evaluator(problem_);
  control::Controller controller_ = reference::cautious_gains();
  Eigen::ArrayXd transmission_;
  double noise_ = 0.0, design_rms_ = 0.0;
  bool stable_ = false;
};

TEST(BoresightRmsAtSpeed, IsTheEvaluationsAtTheDesignSpeed) {
  const RmsAtSpeed rms;
  ASSERT_TRUE(rms.stable());
  EXPECT_LT(relative_error(rms.at(10.0), rms.design_rms()), 1e-12);
}

TEST(BoresightRmsAtSpeed, RisesWithSpeedFromTheNoiseFloor) {
  const RmsAtSpeed rms;
  double previous = rms.floor();
  for (double speed = 0.2; speed < 60.0; speed *= 1.2) {
    EXPECT_GT(rms.at(speed), previous);
    previous = rms.at(speed);
  }
  EXPECT_LT(relative_error(rms.at(0.1), rms.floor()), 1e-3);
}

TEST(WindSpeedLimit, IsWhereTheRmsMeetsTheBudget) {
  const RmsAtSpeed rms;
  for (const double fraction : {0.3, 1.0, 5.0}) {
    const double budget = rms.floor() + fraction * (rms.design_rms() - rms.floor());
    const double limit = rms.limit(budget);
    EXPECT_GT(limit, 0.1);
    EXPECT_LT(limit, 60.0);
    EXPECT_LT(relative_error(rms.at(limit), budget), 1e-4);
  }
  EXPECT_NEAR(rms.limit(rms.design_rms()), 10.0, 1e-3);
}

TEST(WindSpeedLimit, EndsWhereTheSearchDoes) {
  const RmsAtSpeed rms;
  EXPECT_EQ(rms.limit(0.99 * rms.floor()), 0.0);
  EXPECT_EQ(rms.limit(1.01 * rms.at(60.0)), std::numeric_limits<double>::infinity());
}

TEST(FitWindFilter, FollowsTheWindOfTheProblem) {
  for (const auto model : {plant::WindModel::uniform, plant::WindModel::coherence}) {
    TrackingProblem problem = reference::tracking_problem();
    problem.wind.model = model;
    const auto filter = fit_wind_filter(problem.wind, problem.gear_ratio);
    EXPECT_EQ(filter.poles.size(), 6u);
    EXPECT_LT(filter.worst_log_error, 0.05);
  }
}

TEST(FitWindFilter, KeepsTheClosedLoopRmsOfEveryWindModel) {
  for (const auto model :
       {plant::WindModel::uniform, plant::WindModel::vickery, plant::WindModel::coherence}) {
    for (const double speed : {5.0, 10.0, 20.0}) {
      TrackingProblem problem = reference::tracking_problem();
      problem.wind.model = model;
      problem.wind.mean_speed = speed;
      auto evaluator = make_evaluator(problem);
      const auto controller = reference::cautious_gains();
      const double exact = std::sqrt(evaluator.evaluate(controller, false).wind_variance);
      const auto rms =
          control::lyapunov_rms(problem.plant, controller, problem.delay,
                                fit_wind_filter(problem.wind, problem.gear_ratio), problem.noise);
      EXPECT_NEAR(rms.wind / exact, 1.0, 5e-3) << to_string(model) << " " << speed << " m/s";
    }
  }
}

}  // namespace
}  // namespace boresight::design
