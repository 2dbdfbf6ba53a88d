#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/prescribed_motion.hpp"
#include "refused_call.hpp"
#include <boresight/identification/friction/friction_tests.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using reference::PrescribedMotion;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(HalfPeriods, OfASquareWaveAreItsHalves) {
  Eigen::VectorXd wave = Eigen::VectorXd::Zero(450);
  for (Eigen::Index i = 20; i < 450; ++i) wave(i) = (i - 20) / 100 % 2 == 0 ? 2.0 : -2.0;
  const auto found = half_periods(wave);
  ASSERT_EQ(found.size(), 4u);  // the last, of 30 samples, is left out
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].first, 20 + 100 * static_cast<Eigen::Index>(i));
    EXPECT_EQ(found[i].last, 119 + 100 * static_cast<Eigen::Index>(i));
    EXPECT_EQ(found[i].direction, i % 2 == 0 ? 1 : -1);
  }
  EXPECT_TRUE(half_periods(Eigen::VectorXd::Zero(100)).empty());
}

TEST(MeanUncertainty, OfCorrelatedNoiseGrowsWithItsCorrelation) {
  // x' = a x + noise: the mean's variance is (1 + a)/(1 - a) times that of white noise.
  const numerics::NormalNumbers normal(7);
  for (double a : {0.0, 0.8}) {
    const Eigen::Index count = 20000;
    Eigen::VectorXd series(count);
    double x = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) {
      x = a * x + std::sqrt(1.0 - a * a) * normal.pair(static_cast<std::uint64_t>(i)).real();
      series(i) = x;
    }
    const double expected = std::sqrt((1.0 + a) / (1.0 - a) / static_cast<double>(count));
    EXPECT_NEAR(mean_uncertainty(series), expected, 0.25 * expected) << a;
  }
}

TEST(ConstantSpeedTests, RecoverEachSpeedAndTheOffset) {
  PrescribedMotion drive;
  drive.pressure_noise = 5e3;
  drive.rate_noise = 0.01;
  auto campaign = drive.campaign();
  const auto tests = constant_speed_tests(campaign, {drive.inertia, 0.1});
  ASSERT_EQ(tests.points.size(), 4u);
  for (const auto& point : tests.points) {
    EXPECT_NEAR(point.coulomb.value, friction_torque(drive.friction, point.rate), 0.15);
    EXPECT_NEAR(point.offset.value, drive.offset, 0.1);
    EXPECT_EQ(point.unsettled, 0u);
    EXPECT_EQ(point.tails, 6u);
  }
  EXPECT_NEAR(tests.offset.value, drive.offset, 0.1);
  ASSERT_TRUE(tests.has_line);
  // A curve through four speeds lies far from a straight line.
  EXPECT_GT(tests.line_misfit, 10.0);
  EXPECT_THAT(tests.notes.back(), HasSubstr("a point lies up to"));
}

TEST(ConstantSpeedTests, LineThroughTwoSpeedsIsExact) {
  PrescribedMotion drive;
  drive.friction = {50.0, 50.0, 1.0, 1e-12, 1.0, 3.0};
  auto campaign = drive.campaign();
  campaign.records = {drive.constant_speed(4.0), drive.constant_speed(16.0)};
  const auto tests = constant_speed_tests(campaign, {drive.inertia, 0.1});
  EXPECT_NEAR(tests.intercept.value, 50.0, 0.05);
  EXPECT_NEAR(tests.slope.value, 3.0, 0.01);
  EXPECT_NEAR(tests.line_misfit, 0.0, 1e-9);
  EXPECT_THAT(tests.notes.back(), HasSubstr("two speeds cannot show"));
}

TEST(ConstantSpeedTests, UnsettledTailsAreSaidAndTheirInertiaSubtracted) {
  PrescribedMotion drive;
  drive.friction = {50.0, 50.0, 1.0, 1e-12, 1.0, 0.001};
  auto campaign = drive.campaign();
  campaign.records = {drive.constant_speed(15.0, 1.5)};
  auto& command = campaign.records[0].rate_command.emplace();
  command.values = campaign.records[0].motor_rate.values;
  for (Eigen::Index i = 0; i < command.values.size(); ++i) {
    command.values(i) = i / 1200 % 2 == 0 ? 15.0 : -15.0;
  }
  const auto tests = constant_speed_tests(campaign, {drive.inertia, 0.1});
  ASSERT_EQ(tests.points.size(), 1u);
  EXPECT_EQ(tests.points[0].unsettled, 6u);
  EXPECT_NEAR(tests.points[0].coulomb.value, 50.0, 0.1);
  EXPECT_THAT(tests.notes[0], HasSubstr("6 of 6 half periods had not settled"));
  EXPECT_THAT(tests.notes[1], HasSubstr("One speed alone"));
  FrictionTestOptions plain;
  plain.subtract_inertia = false;
  const auto left_in = constant_speed_tests(campaign, {drive.inertia, 0.1}, plain);
  EXPECT_NEAR(left_in.points[0].coulomb.value - tests.points[0].coulomb.value,
              tests.points[0].inertia_torque, 1e-9);
  EXPECT_GT(left_in.points[0].coulomb.value, 51.0);
}

TEST(ConstantSpeedTests, CommonLevelTimesGainErrorsIsInTheOffsetsInterval) {
  PrescribedMotion drive;
  auto campaign = drive.campaign();
  campaign.instruments.pressure_gain = 0.01;
  const auto tests = constant_speed_tests(campaign, {drive.inertia, 0.1});
  const double scale = torque_per_pressure(PrescribedMotion::knowledge());
  const double expected = scale * 0.01 * std::sqrt(4.0) * drive.common_pressure;
  EXPECT_NEAR(tests.offset.standard_uncertainty, expected, 0.15 * expected);
  // Gains at the common level act alike up and down: friction hardly feels them.
  EXPECT_LT(tests.points[0].coulomb.standard_uncertainty, 0.2 * expected);
}

TEST(ConstantSpeedTests, MirroredMotionMirrorsTheOffsetAlone) {
  PrescribedMotion drive;
  const auto one = constant_speed_tests(drive.campaign(), {drive.inertia, 0.1});
  drive.sign = -1.0;
  const auto other = constant_speed_tests(drive.campaign(), {drive.inertia, 0.1});
  EXPECT_NEAR(one.intercept.value, other.intercept.value, 1e-6);
  EXPECT_NEAR(one.slope.value, other.slope.value, 1e-6);
  EXPECT_NEAR(one.offset.value, -other.offset.value, 1e-6);
}

TEST(ConstantSpeedTests, RefusesACampaignWithoutThem) {
  PrescribedMotion drive;
  auto campaign = drive.campaign();
  campaign.records = {drive.fast_ramp()};
  EXPECT_THAT(reference::Call([&] {
                constant_speed_tests(campaign, {1.8, 0.1});
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("record a bipolar square wave")));
  FrictionTestOptions options;
  options.settled_fraction = 0.0;
  EXPECT_THAT(reference::Call([&] {
                constant_speed_tests(campaign, {1.8, 0.1}, options);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive settled fraction")));
}

TEST(SlowRampTests, FindTheTorqueAtBreakaway) {
  PrescribedMotion drive;
  drive.rate_noise = 0.005;
  const auto tests = slow_ramp_tests(drive.campaign());
  ASSERT_EQ(tests.breakaways.size(), 4u);
  EXPECT_EQ(tests.breakaways[0].direction, 1);
  EXPECT_EQ(tests.breakaways[1].direction, -1);
  // Motion counts from a tenth of the largest rate on, 0.12 rad/s; the average just after runs to
  // 0.18 rad/s. J w' adds 0.43 N m.
  const double accelerates = drive.inertia * 1.2 / 5.0;
  EXPECT_NEAR(tests.breakaway.value, friction_torque(drive.friction, 0.12) + accelerates, 0.3);
  EXPECT_NEAR(tests.coulomb.value, friction_torque(drive.friction, 0.15) + accelerates, 0.3);
  EXPECT_NEAR(tests.offset.value, drive.offset, 0.05);
}

TEST(SlowRampTests, RefusesARampThatNeverRests) {
  PrescribedMotion drive;
  auto campaign = drive.campaign();
  campaign.records = {drive.constant_speed(2.0)};
  campaign.records[0].test = TestKind::slow_ramp;
  EXPECT_THAT(reference::Call([&] { slow_ramp_tests(campaign); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("found 0 up and 0 down")));
  FrictionTestOptions options;
  options.rest_fraction = 1.0;
  EXPECT_THAT(reference::Call([&] { slow_ramp_tests(campaign, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("rest fraction between 0 and 1")));
}

}  // namespace
}  // namespace boresight::identification
