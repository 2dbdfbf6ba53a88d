#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/prescribed_motion.hpp"
#include "refused_call.hpp"
#include <boresight/identification/friction/friction_curve_fit.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using reference::PrescribedMotion;
using testing::HasSubstr;
using testing::ThrowsMessage;

const numerics::Uncertain start{1.6, 0.5};

TEST(FrictionCurveFit, RecoversCurveOffsetAndInertiaOfARigidAntenna) {
  PrescribedMotion drive;
  drive.pressure_noise = 5e3;
  drive.rate_noise = 0.01;
  drive.tachometer_zero = 0.02;
  FrictionCurveOptions options;
  options.tachometer_zero = 0.001;
  const auto fit = fit_friction_curve(drive.campaign(), start, options);
  for (double rate : {0.3, 0.6, 1.0, 2.0, 6.0, 18.0, 28.0}) {
    const double expected = friction_torque(drive.friction, rate);
    EXPECT_NEAR(friction_torque(fit.curve, rate), expected, 0.02 * expected) << rate;
  }
  EXPECT_NEAR(fit.offset, drive.offset, 0.1);
  EXPECT_NEAR(fit.inertia, drive.inertia, 0.005 * drive.inertia);
  EXPECT_NEAR(fit.tachometer_zero, 0.02, 0.005);
  EXPECT_LT(fit.scatter, 0.5);
  EXPECT_GT(fit.highest_rate, 25.0);
}

TEST(FrictionCurveFit, APureStribeckCurveNeedsNoSaturatingPart) {
  PrescribedMotion drive;
  drive.friction = {40.0, 70.0, 1.0, 0.0, 1.0, 2.0};
  const auto fit = fit_friction_curve(drive.campaign(), start);
  for (double rate : {0.4, 0.8, 1.5, 3.0, 10.0, 25.0}) {
    const double expected = friction_torque(drive.friction, rate);
    EXPECT_NEAR(friction_torque(fit.curve, rate), expected, 0.02 * expected) << rate;
  }
}

TEST(FrictionCurveFit, SaysWhatFastTestsAloneDoNotDetermine) {
  PrescribedMotion drive;
  drive.pressure_noise = 5e3;
  auto campaign = drive.campaign();
  campaign.records = {drive.constant_speed(6.0), drive.constant_speed(18.0), drive.fast_ramp()};
  FrictionCurveOptions options;
  options.tests = {TestKind::constant_speed};
  const auto fit = fit_friction_curve(campaign, start, options);
  ASSERT_EQ(fit.parameters.size(), 10u);
  EXPECT_EQ(fit.parameters[1].name, "Stribeck torque Ts - Tc");
  EXPECT_FALSE(fit.parameters[1].determined);
  EXPECT_THAT(fit.notes[0], HasSubstr("do not determine"));
  EXPECT_THAT(fit.notes[0], HasSubstr("Stribeck torque"));
}

TEST(FrictionCurveFit, DoesNotDependOnTheDirectionsName) {
  PrescribedMotion drive;
  const auto one = fit_friction_curve(drive.campaign(), start);
  drive.sign = -1.0;
  const auto other = fit_friction_curve(drive.campaign(), start);
  EXPECT_NEAR(one.inertia, other.inertia, 1e-6);
  EXPECT_NEAR(one.offset, -other.offset, 1e-4);
  for (double rate : {0.5, 5.0, 20.0}) {
    EXPECT_NEAR(friction_torque(one.curve, rate), friction_torque(other.curve, rate), 1e-3);
  }
}

TEST(FrictionCurveFit, ScalesWithTheTorquesUnit) {
  PrescribedMotion drive;
  auto campaign = drive.campaign();
  const auto one = fit_friction_curve(campaign, start);
  campaign.knowledge.displacement.value *= 100.0;
  campaign.knowledge.displacement.standard_uncertainty *= 100.0;
  const auto other = fit_friction_curve(campaign, {160.0, 50.0});
  EXPECT_NEAR(other.inertia, 100.0 * one.inertia, 1e-4 * other.inertia);
  EXPECT_NEAR(friction_torque(other.curve, 3.0), 100.0 * friction_torque(one.curve, 3.0),
              1e-3 * friction_torque(other.curve, 3.0));
}

TEST(FrictionCurveFit, BandIsWiderWithTheInstrumentsAndHoldsTheTruth) {
  PrescribedMotion drive;
  drive.pressure_noise = 5e3;
  drive.rate_noise = 0.01;
  drive.gain << 0.006, -0.004, 0.005, -0.008;
  drive.zero << 1e4, -2e4, 1.5e4, 3e4;
  auto campaign = drive.campaign();
  campaign.instruments = {0.007, 2e4, 0.003, 0.0};
  const auto fit = fit_friction_curve(campaign, start);
  for (double rate : {-18.0, -2.0, 0.6, 6.0, 18.0}) {
    const auto recorded = friction_as_recorded(fit, rate);
    const auto antenna = friction_of_antenna(fit, campaign, rate);
    EXPECT_EQ(recorded.value, antenna.value);
    EXPECT_LT(recorded.standard_uncertainty, antenna.standard_uncertainty);
    const double truth = friction_torque(drive.friction, rate);
    EXPECT_LE(antenna.lower, truth) << rate;
    EXPECT_GE(antenna.upper, truth) << rate;
  }
  // The level is common to all tests here: gains and offset cannot be told apart.
  const double scale = torque_per_pressure(campaign.knowledge);
  const double shown =
      drive.offset + scale * (9e6 * (drive.gain.head(2).sum() - drive.gain.tail(2).sum()) +
                              drive.zero.head(2).sum() - drive.zero.tail(2).sum());
  const auto recorded = offset_as_recorded(fit);
  EXPECT_NEAR(recorded.value, shown, 0.1);
  EXPECT_LE(std::abs(recorded.value - shown), 4.0 * recorded.standard_uncertainty + 0.05);
  const auto antenna = offset_of_antenna(fit, campaign);
  EXPECT_LE(antenna.lower, drive.offset);
  EXPECT_GE(antenna.upper, drive.offset);
  EXPECT_GT(antenna.standard_uncertainty, 0.5 * scale * 0.007 * 2.0 * 9e6);
}

TEST(FrictionCurveFit, GradientIsThatOfTheCurve) {
  Eigen::VectorXd estimate(10);
  estimate << 2.0, 1.5, -1.0, 4.0, 0.5, 0.7, 0.0, 0.0, 0.0, 0.0;
  for (double rate : {-3.0, 0.4, 5.0}) {
    const Eigen::VectorXd slope = friction_gradient(friction_curve(estimate), rate);
    for (Eigen::Index i = 0; i < 6; ++i) {
      Eigen::VectorXd up = estimate, down = estimate;
      up(i) += 1e-5;
      down(i) -= 1e-5;
      EXPECT_NEAR(slope(i),
                  (friction_torque(friction_curve(up), rate) -
                   friction_torque(friction_curve(down), rate)) /
                      2e-5,
                  1e-7)
          << rate << ' ' << i;
    }
  }
}

TEST(RemainingGainErrors, AreThoseThatDoNotActOnTheCommonLevel) {
  const Eigen::Vector4d all(0.01, 0.02, -0.03, 0.005);
  const Eigen::VectorXd rest = remaining_gain_errors(all, 2);
  EXPECT_NEAR(rest(0) + rest(1) - rest(2) - rest(3), 0.0, 1e-17);
  EXPECT_NEAR((all - rest)(0), -(all - rest)(3), 1e-17);
}

TEST(FrictionCurveFit, NamesWhatIsMissing) {
  PrescribedMotion drive;
  auto campaign = drive.campaign();
  EXPECT_THAT(reference::Call([&] {
                fit_friction_curve(campaign, {0.0, 0.1});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive inertia and uncertainty")));
  FrictionCurveOptions options;
  options.correlation_time = 0.0;
  EXPECT_THAT(reference::Call([&] { fit_friction_curve(campaign, start, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive correlation time")));
  campaign.records.clear();
  EXPECT_THAT(reference::Call([&] { fit_friction_curve(campaign, start); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("found 0; add constant-speed")));
  campaign.records = {drive.record(
      "one way", TestKind::valve_steps, 40.0, [](double) { return 3.0; },
      [](double) { return 0.0; })};
  EXPECT_THAT(reference::Call([&] { fit_friction_curve(campaign, start); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("all one way")));
}

}  // namespace
}  // namespace boresight::identification
