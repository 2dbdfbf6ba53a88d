#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/ensembles/ensemble_curves.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TrackingProblem coarse_problem() {
  TrackingProblem problem = reference::tracking_problem();
  problem.points_per_decade = 100;
  return problem;
}

std::vector<EnsembleMember> three_members(const TrackingProblem& problem) {
  std::vector<EnsembleMember> members{
      {"nominal", problem.plant}, {"soft", problem.plant}, {"stiff", problem.plant}};
  members[1].plant.drive.oil_stiffness *= 0.6;
  members[1].plant.drive.leakage_rate *= 0.4;
  members[2].plant.drive.oil_stiffness *= 1.3;
  return members;
}

bool within(const EnsembleBand& band) {
  return (band.lower <= band.nominal).all() && (band.nominal <= band.upper).all();
}

bool same(const EnsembleBand& one, const EnsembleBand& other) {
  return (one.lower == other.lower).all() && (one.nominal == other.nominal).all() &&
         (one.upper == other.upper).all();
}

TEST(EnsembleCurves, ReachThePeaksAndRmsOfTheMembersAsEvaluated) {
  const TrackingProblem problem = coarse_problem();
  const auto members = three_members(problem);
  const auto controller = reference::cautious_gains();
  const EnsembleResult evaluated = evaluate(problem, members, controller, {}, 1);
  ASSERT_EQ(evaluated.stable, 3);
  const auto curves = ensemble_curves(problem, members, controller, evaluated, 15.0, 1);
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_TRUE(within(curves.sensitivity.at(b)));
    double highest = 0.0;
    for (const auto& member : evaluated.members) {
      highest = std::max(highest, member.sensitivity_peaks.at(b));
    }
    EXPECT_EQ(curves.worst.at(b).peak, highest);
    // The grid does not hit the peak, and never exceeds it.
    EXPECT_LE(curves.sensitivity.at(b).upper.maxCoeff(), highest * (1.0 + 1e-4));
    EXPECT_GE(curves.sensitivity.at(b).upper.maxCoeff(), highest * 0.97);
    EXPECT_TRUE((curves.worst.at(b).sensitivity <= curves.sensitivity.at(b).upper).all());
  }
  ASSERT_EQ(curves.wind_speed.size(), 60);
  EXPECT_NEAR(curves.wind_speed[39], 10.0, 1e-12);
  EXPECT_TRUE(within(curves.boresight_rms));
  EXPECT_NEAR(curves.boresight_rms.nominal[39] / evaluated.members[0].boresight_rms, 1.0, 5e-3);
  EXPECT_NEAR(curves.boresight_rms.lower[39] / evaluated.min_rms, 1.0, 5e-3);
  EXPECT_NEAR(curves.boresight_rms.upper[39] / evaluated.largest_rms, 1.0, 5e-3);
}

TEST(EnsembleCurves, StepsLeadFromRestToTheCommand) {
  const TrackingProblem problem = coarse_problem();
  const auto members = three_members(problem);
  const auto controller = reference::cautious_gains();
  const auto curves = ensemble_curves(problem, members, controller,
                                      evaluate(problem, members, controller, {}, 1), 15.0, 1);
  for (const auto* step : {&curves.rate_step, &curves.position_step}) {
    EXPECT_TRUE(within(step->response));
    EXPECT_EQ(step->time[0], 0.0);
    EXPECT_NEAR(step->response.nominal[0], 0.0, 1e-9);
    EXPECT_NEAR(step->response.nominal.tail(1)[0], 1.0, 0.05);
    EXPECT_LT(step->response.lower.tail(1)[0], step->response.upper.tail(1)[0]);
  }
}

// A second-order loop overshoots by exp(-pi zeta/sqrt(1 - zeta^2)) (Franklin and Powell, 3.4).
TEST(StepOverEnsemble, OvershootIsThatOfASecondOrderLoop) {
  const auto response = [](const Eigen::ArrayXd& time, double zeta) -> Eigen::ArrayXd {
    const double damped = std::sqrt(1.0 - zeta * zeta);
    return 1.0 -
           (-zeta * time).exp() * ((damped * time).cos() + zeta / damped * (damped * time).sin());
  };
  const auto overshoot = [](double zeta) {
    return std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
  };
  StepOverEnsemble step;
  EXPECT_EQ(step.overshoot(), 0.0);
  step.time = Eigen::ArrayXd::LinSpaced(4001, 0.0, 20.0);
  step.response.nominal = response(step.time, 0.5);
  step.response.upper = response(step.time, 0.3);
  EXPECT_NEAR(step.overshoot(), overshoot(0.5), 1e-5);
  EXPECT_NEAR(step.largest_overshoot(), overshoot(0.3), 1e-5);
  step.response.nominal = 1.0 - (-step.time).exp();
  EXPECT_EQ(step.overshoot(), 0.0);
}

TEST(EnsembleCurves, LeaveUnstableMembersOutOfTheirRanges) {
  const TrackingProblem problem = coarse_problem();
  auto members = three_members(problem);
  members.resize(1);
  const auto controller = reference::cautious_gains();
  const EnsembleResult evaluated = evaluate(problem, members, controller, {}, 1);
  const auto alone = ensemble_curves(problem, members, controller, evaluated, 15.0, 1);
  members.push_back({"unstable", problem.plant});
  EnsembleResult with_unstable = evaluated;
  with_unstable.members.push_back(evaluated.members.front());
  with_unstable.members.back().stable = false;
  members.back().plant.drive.oil_stiffness *= 0.1;
  const auto two = ensemble_curves(problem, members, controller, with_unstable, 15.0, 1);
  EXPECT_EQ(two.members, 2U);
  EXPECT_EQ(two.stable, 1U);
  EXPECT_TRUE(same(two.boresight_rms, alone.boresight_rms));
  EXPECT_TRUE(same(two.sensitivity[1], alone.sensitivity[1]));
  EXPECT_EQ(two.worst[1].member, "nominal");
}

TEST(EnsembleCurves, AreTheSameForAnyNumberOfThreads) {
  const TrackingProblem problem = coarse_problem();
  const auto members = three_members(problem);
  const auto controller = reference::cautious_gains();
  const EnsembleResult evaluated = evaluate(problem, members, controller, {}, 1);
  const auto one = ensemble_curves(problem, members, controller, evaluated, 15.0, 1);
  const auto three = ensemble_curves(problem, members, controller, evaluated, 15.0, 3);
  EXPECT_TRUE(same(one.boresight_rms, three.boresight_rms));
  EXPECT_TRUE(same(one.position_step.response, three.position_step.response));
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_TRUE(same(one.sensitivity.at(b), three.sensitivity.at(b)));
    EXPECT_EQ(one.worst.at(b).member, three.worst.at(b).member);
  }
}

TEST(EnsembleCurves, RefuseOtherMembersThanWereEvaluated) {
  const TrackingProblem problem = coarse_problem();
  const auto members = three_members(problem);
  const auto controller = reference::cautious_gains();
  EnsembleResult evaluated = evaluate(problem, members, controller, {}, 1);
  EXPECT_THROW(ensemble_curves(problem, members, controller, evaluated, 0.0, 1), InvalidInput);
  evaluated.members.pop_back();
  EXPECT_THROW(ensemble_curves(problem, members, controller, evaluated, 15.0, 1), InvalidInput);
}

TEST(HighestComparedSpeed, IncludesLimitsUpToThreeTimesTheMeanSpeed) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(highest_compared_speed(10.0, {}), 15.0);
  EXPECT_EQ(highest_compared_speed(10.0, {0.0, infinity, 9.0}), 15.0);
  EXPECT_NEAR(highest_compared_speed(10.0, {20.0}), 21.6, 1e-12);
  EXPECT_EQ(highest_compared_speed(10.0, {40.0}), 30.0);
}

}  // namespace
}  // namespace boresight::design
