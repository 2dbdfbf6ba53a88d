#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/prescribed_motion.hpp"
#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/identification/impulse/impulse_momentum.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using reference::PrescribedMotion;
using testing::HasSubstr;
using testing::ThrowsMessage;

ImpulseMomentumOptions quick() {
  ImpulseMomentumOptions options;
  options.random_samples = 100;
  return options;
}

PrescribedMotion clipped() {
  PrescribedMotion drive;
  drive.rate_limit = 22.6;
  drive.pressure_noise = 5e3;
  drive.rate_noise = 0.01;
  return drive;
}

TEST(RampWindows, RunFromZeroToThePlateauAndAsLongFromItsEnd) {
  const auto drive = clipped();
  auto campaign = drive.campaign();
  const auto two = ramp_windows(campaign, 5);
  ASSERT_EQ(two.size(), 2u);
  const auto& [first, second] = std::tie(two[0].window, two[1].window);
  // 30 sin(2 pi (t - 1)/10) passes 2 % of 22.6 and reaches 22.6 rad/s.
  const double start = 1.0 + 10.0 / (2.0 * M_PI) * std::asin(0.02 * 22.6 / 30.0);
  const double reach = 1.0 + 10.0 / (2.0 * M_PI) * std::asin(22.6 / 30.0);
  const double leave = 1.0 + 5.0 - (reach - 1.0);
  EXPECT_NEAR(static_cast<double>(first.first) * 0.005, start, 0.02);
  EXPECT_NEAR(static_cast<double>(first.last) * 0.005, reach, 0.011);
  EXPECT_NEAR(static_cast<double>(second.first) * 0.005, leave, 0.011);
  EXPECT_EQ(second.last - second.first, first.last - first.first);
  EXPECT_TRUE(two[0].accelerating);
  EXPECT_FALSE(two[1].accelerating);
  EXPECT_THAT(reference::Call([&] { ramp_windows(campaign, 6); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected one of 6 records, found number 6")));
}

TEST(RampWindows, TakeTheLargestRateWhereNothingIsClipped) {
  auto campaign = PrescribedMotion{}.campaign();
  const auto two = ramp_windows(campaign, 5);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(static_cast<double>(two[0].window.last) * 0.005, 3.5, 0.011);
  EXPECT_EQ(two[1].window.first, two[0].window.last);
}

TEST(ImpulseWindows, KeepClearOfClippedSamplesAndOfReversals) {
  const auto drive = clipped();
  const auto campaign = drive.campaign();
  const auto windows = impulse_windows(campaign);
  EXPECT_GT(windows.size(), 16u);
  for (const auto& one : windows) {
    const auto& rate = campaign.records[one.record].motor_rate;
    for (Eigen::Index i = one.window.first; i <= one.window.last; ++i) {
      EXPECT_TRUE(rate.is_valid(i));
      EXPECT_GT(rate.values(i) * one.direction, -0.1);  // noise, where phi is 0
    }
    EXPECT_GE(std::abs(one.to_rate - one.from_rate), 0.25 * 0.9 * 22.0);
    EXPECT_EQ(one.accelerating, std::abs(one.to_rate) > std::abs(one.from_rate));
  }
  ImpulseWindowOptions options;
  options.smallest_change = 0.0;
  EXPECT_THAT(reference::Call([&] { impulse_windows(campaign, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive smallest change")));
}

TEST(ImpulseMomentum, RecoversTheInertiaOfARigidAntenna) {
  const auto drive = clipped();
  const auto result = impulse_momentum(drive.campaign(), quick());
  EXPECT_EQ(result.estimates.size(), 8u);
  for (const auto& [rule, treatment] :
       {std::pair{WindowRule::two_on_the_ramp, FrictionTreatment::curve},
        std::pair{WindowRule::every_speed_change, FrictionTreatment::curve},
        std::pair{WindowRule::same_path, FrictionTreatment::cancelled},
        std::pair{WindowRule::whole_records, FrictionTreatment::curve}}) {
    const auto* estimate = result.find(rule, treatment);
    ASSERT_NE(estimate, nullptr);
    EXPECT_NEAR(estimate->inertia.value, drive.inertia, 0.01 * drive.inertia) << estimate->name;
    EXPECT_LE(estimate->as_recorded.standard_uncertainty,
              1.05 * estimate->inertia.standard_uncertainty)
        << estimate->name;
    double sum = 0.0;
    for (const auto& fraction : estimate->fractions) sum += fraction.fraction;
    EXPECT_NEAR(sum, 1.0, 1e-9) << estimate->name;
  }
  ASSERT_TRUE(result.best.has_value());
  EXPECT_EQ(result.estimates[*result.best].rule, WindowRule::whole_records);
}

TEST(ImpulseMomentum, AStraightLineWhereFrictionIsNoneIsBiasedAndItsIntervalKnowsIt) {
  auto drive = clipped();
  drive.skew = 0.5;
  const auto result = impulse_momentum(drive.campaign(), quick());
  for (const auto treatment :
       {FrictionTreatment::constant_speed_line, FrictionTreatment::slow_ramp_line}) {
    const auto* line = result.find(WindowRule::two_on_the_ramp, treatment);
    ASSERT_NE(line, nullptr);
    EXPECT_GT(std::abs(line->inertia.value / drive.inertia - 1.0), 0.03);
    EXPECT_LE(line->inertia.lower, drive.inertia);
    EXPECT_GE(line->inertia.upper, drive.inertia);
    ASSERT_TRUE(line->friction_model_error.has_value());
    EXPECT_NEAR(*line->friction_model_error, line->inertia.value - drive.inertia, 0.03);
    EXPECT_THAT(line->note, HasSubstr("% by the straight-line friction"));
  }
}

TEST(ImpulseMomentum, AStraightLineIsRightWhereFrictionIsOne) {
  auto drive = clipped();
  drive.friction = {50.0, 50.0, 1.0, 0.0, 1.0, 3.0};
  const auto result = impulse_momentum(drive.campaign(), quick());
  for (const auto rule : {WindowRule::two_on_the_ramp, WindowRule::every_speed_change}) {
    for (const auto treatment :
         {FrictionTreatment::constant_speed_line, FrictionTreatment::slow_ramp_line}) {
      const auto* line = result.find(rule, treatment);
      ASSERT_NE(line, nullptr);
      EXPECT_NEAR(line->inertia.value, drive.inertia, 0.02 * drive.inertia) << line->name;
    }
  }
}

TEST(ImpulseMomentum, NeedsNoFrictionTestWhereFrictionCancels) {
  const auto drive = clipped();
  auto campaign = drive.campaign();
  campaign.records = {drive.fast_ramp()};
  ImpulseMomentumOptions options = quick();
  options.curve.tests = {TestKind::slow_ramp};
  const auto result = impulse_momentum(campaign, options);
  ASSERT_EQ(result.estimates.size(), 1u);
  EXPECT_EQ(result.estimates[0].treatment, FrictionTreatment::cancelled);
  EXPECT_NEAR(result.estimates[0].inertia.value, drive.inertia, 0.01 * drive.inertia);
  EXPECT_EQ(result.best, 0u);
  EXPECT_EQ(result.notes.size(), 3u);  // no curve, no constant speed, no slow ramp
}

TEST(ImpulseMomentum, IsTheSameForTheSameSeed) {
  const auto drive = clipped();
  auto campaign = drive.campaign();
  campaign.instruments = {0.007, 2e4, 0.003, 0.0};
  const auto one = impulse_momentum(campaign, quick());
  const auto again = impulse_momentum(campaign, quick());
  auto options = quick();
  options.seed = 2;
  const auto other = impulse_momentum(campaign, options);
  for (std::size_t i = 0; i < one.estimates.size(); ++i) {
    EXPECT_EQ(one.estimates[i].inertia.lower, again.estimates[i].inertia.lower);
    EXPECT_NE(one.estimates[i].inertia.lower, other.estimates[i].inertia.lower);
    EXPECT_EQ(one.estimates[i].inertia.value, other.estimates[i].inertia.value);
  }
}

TEST(ImpulseMomentum, IntervalsHoldOverDrawnInstruments) {
  reference::RandomNumbers random(5);
  int inertia = 0, offset = 0, friction = 0, path = 0;
  constexpr int trials = 40;
  for (int trial = 0; trial < trials; ++trial) {
    const auto normal = [&] {
      return std::sqrt(-2.0 * std::log(random.uniform(1e-12, 1.0))) *
             std::cos(random.uniform(0.0, 2.0 * M_PI));
    };
    PrescribedMotion drive = clipped();
    drive.sample_time = 0.02;
    drive.seed = static_cast<std::uint64_t>(trial) + 10;
    drive.inertia = random.uniform(1.4, 2.2);
    for (Eigen::Index i = 0; i < 4; ++i) {
      drive.gain(i) = 0.01 * normal();
      drive.zero(i) = 2e4 * normal();
    }
    drive.tachometer_scale = 0.005 * normal();
    auto campaign = drive.campaign();
    campaign.instruments = {0.01, 2e4, 0.005, 0.0};
    const auto result = impulse_momentum(campaign, quick());
    const auto covers = [](const numerics::Interval& interval, double truth) {
      return interval.lower <= truth && truth <= interval.upper ? 1 : 0;
    };
    inertia += covers(result.estimates[*result.best].inertia, drive.inertia);
    path += covers(result.find(WindowRule::same_path, FrictionTreatment::cancelled)->inertia,
                   drive.inertia);
    offset += covers(offset_of_antenna(*result.friction, campaign), drive.offset);
    friction += covers(friction_of_antenna(*result.friction, campaign, 6.0),
                       friction_torque(drive.friction, 6.0));
  }
  // Of 40 at 95 %, fewer than 34 happen about once in three hundred times.
  EXPECT_GE(inertia, 34);
  EXPECT_GE(path, 34);
  EXPECT_GE(offset, 34);
  EXPECT_GE(friction, 34);
}

TEST(ImpulseMomentum, NamesWhatItCannotUse) {
  Campaign campaign;
  EXPECT_THAT(reference::Call([&] { impulse_momentum(campaign); }),
              ThrowsMessage<InvalidInput>(HasSubstr("campaign with records, found none")));
  campaign = PrescribedMotion{}.campaign();
  campaign.records[2].inlet_pressure.pop_back();
  EXPECT_THAT(reference::Call([&] { impulse_momentum(campaign); }),
              ThrowsMessage<InvalidInput>(HasSubstr("same 2 motors in every record")));
  campaign = PrescribedMotion{}.campaign();
  ImpulseMomentumOptions options;
  options.random_samples = 10;
  EXPECT_THAT(reference::Call([&] { impulse_momentum(campaign, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 20 samples")));
  campaign.records = {PrescribedMotion{}.slow_ramp()};
  campaign.records[0].test = TestKind::other;
  EXPECT_THAT(reference::Call([&] { impulse_momentum(campaign); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("record a fast ramp")));
}

}  // namespace
}  // namespace boresight::identification
