#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::plant {
namespace {

const FrictionCurve reference_curve{10.33, 16.83, 0.15, 63.29, 1.5, 2.075};

TEST(FrictionTorque, IsOddAndZeroAtRest) {
  EXPECT_EQ(friction_torque(reference_curve, 0.0), 0.0);
  for (const double rate : {1e-9, 0.1, 2.09, 125.0}) {
    EXPECT_EQ(friction_torque(reference_curve, -rate), -friction_torque(reference_curve, rate));
    EXPECT_EQ(friction_slope(reference_curve, -rate), friction_slope(reference_curve, rate));
  }
}

TEST(FrictionTorque, LeavesRestAtTheBreakawayTorque) {
  EXPECT_NEAR(friction_torque(reference_curve, 1e-9), 16.83, 1e-6);
}

TEST(FrictionTorque, IsALineAtHighRates) {
  // Bump gone, saturating part full: Tc + Th + Bv w.
  const double w = 100.0;
  EXPECT_NEAR(friction_torque(reference_curve, w), 10.33 + 63.29 + 2.075 * w, 1e-10);
  EXPECT_NEAR(friction_slope(reference_curve, w), 2.075, 1e-10);
}

TEST(FrictionTorque, WithoutBumpAndSaturatingPartIsCoulombAndViscous) {
  FrictionCurve line;
  line.coulomb_torque = line.breakaway_torque = 5.0;
  line.viscous_friction = 2.0;
  EXPECT_DOUBLE_EQ(friction_torque(line, 3.0), 11.0);
  EXPECT_DOUBLE_EQ(friction_slope(line, 3.0), 2.0);
}

TEST(EquivalentFriction, IsFourOverPiOfCoulombFriction) {
  FrictionCurve coulomb;
  coulomb.coulomb_torque = coulomb.breakaway_torque = 5.0;
  for (const double rate : {1e-6, 0.03, 2.0, 200.0}) {
    EXPECT_NEAR(equivalent_friction(coulomb, rate) * std::numbers::pi * rate / 20.0, 1.0, 1e-9);
  }
}

TEST(EquivalentFriction, AddsTheViscousFriction) {
  FrictionCurve dry = reference_curve;
  dry.viscous_friction = 0.0;
  for (const double rate : {0.01, 0.3, 4.0}) {
    EXPECT_NEAR(equivalent_friction(reference_curve, rate) - equivalent_friction(dry, rate), 2.075,
                1e-9 * equivalent_friction(dry, rate));
  }
}

TEST(EquivalentFriction, DissipatesAsMuchInAPeriod) {
  // Midpoint rule over a period, 1e5 points: work of T against that of b w.
  constexpr int points = 100000;
  for (const double rate : {0.05, 0.15, 1.0, 20.0}) {
    double work = 0.0, square = 0.0;
    for (int i = 0; i < points; ++i) {
      const double w = rate * std::sin(2.0 * std::numbers::pi * (i + 0.5) / points);
      work += friction_torque(reference_curve, w) * w;
      square += w * w;
    }
    EXPECT_NEAR(equivalent_friction(reference_curve, rate) * square / work, 1.0, 1e-8) << rate;
  }
}

TEST(EquivalentFriction, RefusesAnAmplitudeThatIsNotPositive) {
  for (const double rate : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(equivalent_friction(reference_curve, rate), InvalidInput);
  }
}

TEST(FrictionSlope, IsTheDerivativeOfTheTorque) {
  for (const double rate : {0.01, 0.08, 0.15, 0.4, 1.0, 2.09, 10.0, 125.0}) {
    const double step = 1e-5 * rate;
    const double difference = (friction_torque(reference_curve, rate + step) -
                               friction_torque(reference_curve, rate - step)) /
                              (2.0 * step);
    EXPECT_NEAR(friction_slope(reference_curve, rate), difference,
                1e-7 * (1.0 + std::abs(difference)))
        << rate;
  }
}

TEST(FrictionSlope, IntegratesToTheTorque) {
  const double low = 0.05, high = 3.0;
  constexpr int steps = 20000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    sum += friction_slope(reference_curve, low + (i + 0.5) * (high - low) / steps);
  }
  EXPECT_NEAR(sum * (high - low) / steps,
              friction_torque(reference_curve, high) - friction_torque(reference_curve, low), 1e-5);
}

TEST(FrictionSlope, AtTrackingRateIsTenTimesTheLinearPlants) {
  // Sidereal, 15 arcsec/s at the sky, is 2.09 rad/s of motor.
  const double rate = 15.0 / 3600.0 * 1e3 * reference::mdeg * reference::gear_ratio();
  EXPECT_NEAR(rate, 2.09, 0.005);
  const double slope = friction_slope(reference_curve, rate);
  EXPECT_GT(slope, 10.0 * 0.9);
  EXPECT_LT(slope, 20.0 * 0.9);
}

}  // namespace
}  // namespace boresight::plant
