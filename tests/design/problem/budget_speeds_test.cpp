#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::design {
namespace {

struct Setting {
  TrackingProblem problem = reference::tracking_problem();
  control::Controller controller = reference::cautious_gains();
  control::LoopEvaluator evaluator = make_evaluator(problem);
  double noise = evaluator.evaluate(controller, false).noise_variance;
  Eigen::ArrayXd transmission = evaluator.wind_transmission(controller);

  std::vector<double> speeds(double budget, const NonlinearEffect& effect) const {
    PointingBudget one;
    one.rms = budget;
    return budget_speeds(problem, controller, {one}, effect);
  }
  double rms(double speed) const {
    return boresight_rms_at_speed(problem, evaluator, transmission, noise, speed);
  }
};

// In that wind the rms with the limit cycle is the budget.
TEST(BudgetSpeeds, EndWhereTheRmsWithTheLimitCycleIsTheBudget) {
  const Setting setting;
  const double budget = setting.rms(12.0);
  double before = 12.0 * 1.001;
  for (const double amplitude : {0.0, 0.3, 0.9}) {
    const NonlinearEffect effect{1.05, amplitude * budget};
    const double speed = setting.speeds(budget, effect).front();
    EXPECT_NEAR(effect.rms(setting.rms(speed)), budget, 1e-4 * budget);
    EXPECT_LT(speed, before);
    before = speed;
  }
}

TEST(BudgetSpeeds, AreThoseOfTheLinearLoopWithoutAnEffect) {
  const Setting setting;
  EXPECT_NEAR(setting.speeds(setting.rms(12.0), {}).front(), 12.0, 1e-3);
  // A simulated rms below the linear one does not lengthen them.
  EXPECT_NEAR(setting.speeds(setting.rms(12.0), {0.7, 0.0}).front(), 12.0, 1e-3);
}

TEST(BudgetSpeeds, AreNoneWhereTheLimitCycleTakesTheBudget) {
  const Setting setting;
  const double budget = setting.rms(12.0);
  EXPECT_EQ(setting.speeds(budget, {1.0, 1.5 * budget}).front(), 0.0);
}

}  // namespace
}  // namespace boresight::design
