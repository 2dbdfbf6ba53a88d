#include <cmath>
#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include "design/verification/demo_loop.hpp"
#include <boresight/design/verification/integrator_agreement.hpp>
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using reference::DemoLoop;

TEST(SimulatedRms, IsTheSameForAnyNumberOfThreads) {
  DemoLoop setting;
  setting.options.records = 4;
  setting.options.winds = 8;
  const auto two = simulated_rms(setting.problem, setting.loop, setting.options);
  setting.options.threads = 1;
  const auto one = simulated_rms(setting.problem, setting.loop, setting.options);
  EXPECT_EQ(two.status, RunStatus::complete);
  EXPECT_EQ(one.rms.value, two.rms.value);
  EXPECT_EQ(one.rms.upper, two.rms.upper);
  EXPECT_LE(one.rms.lower, (1.0 - integrator_agreement_limit) * one.rms.value);
  EXPECT_GE(one.rms.upper, (1.0 + integrator_agreement_limit) * one.rms.value);
  // The same loop in the same winds is a tie with itself.
  const auto change = relative_change({one, 0.0}, {two, 0.0});
  ASSERT_TRUE(change);
  EXPECT_EQ(change->value, 0.0);
  EXPECT_LT(change->lower, 0.0);
  EXPECT_GT(change->upper, 0.0);
}

TEST(SimulatedRms, TakesOverRecordsThatWereRun) {
  DemoLoop setting;
  setting.options.records = 4;
  setting.options.winds = 12;
  setting.options.duration = 20.0;
  const auto few = simulated_rms(setting.problem, setting.loop, setting.options);
  setting.options.records = 6;
  const auto whole = simulated_rms(setting.problem, setting.loop, setting.options);
  setting.options.known = few.mean_squares;
  setting.options.shared = std::make_shared<SharedWinds>();
  const auto more = simulated_rms(setting.problem, setting.loop, setting.options);
  EXPECT_EQ(more.mean_squares, whole.mean_squares);
  EXPECT_EQ(more.rms.upper, whole.rms.upper);
  // Not run again: what is stated of them stands.
  setting.options.known = 2.0 * few.mean_squares;
  EXPECT_EQ(simulated_rms(setting.problem, setting.loop, setting.options).mean_squares.head(4),
            2.0 * few.mean_squares);
  setting.options.records = 4;
  setting.options.known = whole.mean_squares;
  EXPECT_THROW(simulated_rms(setting.problem, setting.loop, setting.options), InvalidInput);
}

TEST(SharedWinds, PreparesTheRecordsOfOneWindOnce) {
  const DemoLoop setting;
  SharedWinds winds;
  const SharedWinds::Records records{setting.problem, setting.loop, 0.0, 10.0};
  const auto first = winds.courses(records);
  EXPECT_EQ(winds.courses(records), first);
  const auto squares = winds.line_squares(records, 401, 3, 5, 2);
  EXPECT_EQ(winds.line_squares(records, 401, 3, 5, 1), squares);
  EXPECT_EQ(squares->rows(), 200);
  EXPECT_NE(winds.line_squares(records, 401, 4, 5, 1), squares);
  TrackingProblem stronger = setting.problem;
  stronger.wind.mean_speed *= 2.0;
  EXPECT_NE(winds.courses({stronger, setting.loop, 0.0, 10.0}), first);
  // By Parseval, of the seed's own gusts about their mean.
  const Eigen::VectorXd gusts = first->gusts(4).tail(401);
  const double variance = (gusts.array() - gusts.mean()).square().mean();
  const double by_lines = 2.0 * squares->col(1).sum() / (401.0 * 401.0);
  EXPECT_NEAR(by_lines / variance, 1.0, 1e-12);  // an odd number of samples: no line is left out
}

// Ten records of which each has the mean square that the linear loop gives it, and 100 winds, about
// `mean`; every figure is scale^2 of that.
SimulatedRms on_a_line(double mean, double scale, std::uint64_t seed = 1) {
  SimulatedRms found;
  found.records = 10;
  found.winds = 100;
  found.seed = seed;
  found.linear_mean_squares =
      scale * scale * Eigen::VectorXd::LinSpaced(100, 0.5 * mean, 1.5 * mean);
  found.mean_squares = found.linear_mean_squares.head(10);
  found.rms.value = scale * std::sqrt(mean);
  return found;
}

TEST(RelativeChange, IsTheRatioOfTheRms) {
  const auto one = on_a_line(4.0, 1.0), other = on_a_line(4.0, 1.1);
  const auto change = relative_change({one, 0.0}, {other, 0.0});
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->value, 0.1, 1e-9);
  EXPECT_GT(change->lower, 0.0);
  const auto back = relative_change({other, 0.0}, {one, 0.0});
  ASSERT_TRUE(back);
  EXPECT_NEAR((1.0 + back->value) * (1.0 + change->value), 1.0, 1e-9);
}

// sqrt(4 + 0.8^2 / 2) over 2.
TEST(RelativeChange, CountsTheLimitCycle) {
  const auto one = on_a_line(4.0, 1.0);
  const auto change = relative_change({one, 0.0}, {one, 0.8});
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->value, std::sqrt(1.08) - 1.0, 1e-12);
}

// What errs alike in one wind is no difference: the interval is far narrower than the two.
TEST(RelativeChange, IsNarrowerThanTwoIntervalsAndNoNarrowerThanTheIntegration) {
  const auto one = on_a_line(4.0, 1.0);
  auto other = one;
  for (Eigen::Index i = 0; i < other.mean_squares.size(); ++i) {
    other.mean_squares[i] += i % 2 == 0 ? 1e-9 : -1e-9;
  }
  const auto change = relative_change({one, 0.0}, {other, 0.0});
  ASSERT_TRUE(change);
  EXPECT_LT(change->lower, 0.0);
  EXPECT_GT(change->upper, 0.0);
  EXPECT_NEAR(left_open({one, 0.0}, {other, 0.0}), std::sqrt(2.0) * integrator_agreement_limit,
              1e-7);
}

// Of a loop with four records and one with ten, over the four.
TEST(RelativeChange, ComparesTheRecordsThatBothRan) {
  const auto one = on_a_line(4.0, 1.0);
  auto few = on_a_line(4.0, 1.1);
  few.records = 4;
  few.mean_squares.conservativeResize(4);
  const auto change = relative_change({one, 0.0}, {few, 0.0});
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->value, 0.1, 1e-9);
  few.mean_squares.conservativeResize(3);
  EXPECT_FALSE(relative_change({one, 0.0}, {few, 0.0}));
}

TEST(RelativeChange, AsksForTheSameWinds) {
  const auto one = on_a_line(4.0, 1.0);
  EXPECT_FALSE(relative_change({one, 0.0}, {on_a_line(4.0, 1.0, 2), 0.0}));
  EXPECT_FALSE(relative_change({one, 0.0}, {SimulatedRms{}, 0.0}));
  EXPECT_EQ(left_open({one, 0.0}, {SimulatedRms{}, 0.0}), 0.0);
}

TEST(SimulatedRms, StatesARunThatLosesItsTarget) {
  DemoLoop setting;
  setting.options.records = 4;
  setting.options.winds = 4;
  setting.loop.antenna.valve.stroke_limit *= 0.01;
  setting.options.tracking_rate *= 50.0;
  const auto found = simulated_rms(setting.problem, setting.loop, setting.options);
  EXPECT_NE(found.status, RunStatus::complete);
  EXPECT_TRUE(std::isnan(found.rms.value));
}

TEST(SimulatedRms, RefusesTooFewRecords) {
  DemoLoop setting;
  setting.options.records = 3;
  EXPECT_THROW(simulated_rms(setting.problem, setting.loop, setting.options), InvalidInput);
  setting.options.records = 10;
  setting.options.winds = 9;
  EXPECT_THROW(simulated_rms(setting.problem, setting.loop, setting.options), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
