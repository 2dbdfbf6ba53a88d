#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/prescribed_motion.hpp"
#include "refused_call.hpp"
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using reference::PrescribedMotion;
using testing::HasSubstr;
using testing::ThrowsMessage;

DriveRecord polynomial(double a1, double a3) {
  return PrescribedMotion{}.record(
      "polynomial", TestKind::other, 4.0, [=](double t) { return 1.0 + a1 * t + a3 * t * t * t; },
      [=](double t) { return a1 + 3.0 * a3 * t * t; });
}

TEST(IntegrateMotion, OfALineIsItsSlopeTimesTheDuration) {
  const auto record = polynomial(3.0, 0.0);
  for (Eigen::Index taper : {0, 50, 200, 300}) {
    const auto motion = integrate_motion(record, {100, 700, taper});
    EXPECT_NEAR(motion.duration, (600.0 - static_cast<double>(taper)) * 0.005, 1e-9);
    EXPECT_NEAR(motion.rate_change, 3.0 * motion.duration, 1e-6);
    // The flank's third derivative has a corner at its ends: second order in the sample time.
    EXPECT_NEAR(motion.jerk, 0.0, 0.005);
    EXPECT_NEAR(motion.mean_rate, 1.0 + 3.0 * 2.0, 1e-9);
    EXPECT_NEAR(motion.rate_weight.sum(), motion.duration, 1e-12);
  }
}

TEST(IntegrateMotion, TakesTheThirdDerivativeWithoutDifferentiating) {
  const auto motion = integrate_motion(polynomial(0.0, 0.5), {100, 700, 250});
  EXPECT_NEAR(motion.jerk, 6.0 * 0.5 * motion.duration, 5e-3 * motion.duration);
}

TEST(IntegrateMotion, ClosesTheEquationOfMotion) {
  PrescribedMotion drive;
  const auto record = drive.fast_ramp();
  const double scale = torque_per_pressure(PrescribedMotion::knowledge());
  for (Eigen::Index taper : {0, 80}) {
    const auto motion = integrate_motion(record, {260, 600, taper}, 0.005);
    const double impulse =
        scale * (motion.pressure_impulse.head(2).sum() - motion.pressure_impulse.tail(2).sum());
    double friction = 0.0;
    for (Eigen::Index i = 0; i < motion.rate.size(); ++i) {
      friction += motion.rate_weight(i) * plant::friction_torque(drive.friction, motion.rate(i));
    }
    EXPECT_NEAR(impulse,
                drive.inertia * motion.rate_change + friction + drive.offset * motion.duration,
                1e-3 * std::abs(impulse));
  }
}

TEST(IntegrateMotion, RefusesWhatIsNoWindow) {
  const auto record = polynomial(1.0, 0.0);
  for (const MotionWindow& window :
       {MotionWindow{-1, 10, 0}, MotionWindow{5, 5, 0}, MotionWindow{0, 801, 0},
        MotionWindow{0, 10, 6}, MotionWindow{0, 10, -1}}) {
    EXPECT_THAT(reference::Call([&] { integrate_motion(record, window); }),
                ThrowsMessage<InvalidInput>(HasSubstr("of record 'polynomial'")));
  }
  EXPECT_THAT(reference::Call([&] {
                integrate_motion(record, {0, 10, 0}, 0.0);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive group and sample times")));
  auto uneven = record;
  uneven.outlet_pressure[1].values.conservativeResize(5);
  EXPECT_THAT(reference::Call([&] {
                integrate_motion(uneven, {0, 10, 0});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found a pressure of 5")));
}

TEST(IntegrateOverSpeed, OfALineIsTheChangeOfSpeedTimesTheAcceleration) {
  const auto motion = integrate_over_speed(polynomial(3.0, 0.0), {0, 800, 0}, 2.5, 10.3, 0.2);
  EXPECT_NEAR(motion.duration, 7.8, 1e-9);
  EXPECT_NEAR(motion.rate_change, 3.0 * 7.8, 1e-6);
  EXPECT_NEAR(motion.rate_weight.sum(), 7.8, 1e-9);
}

TEST(IntegrateOverSpeed, FrictionCancelsOverAClosedPathPassedAtUnequalAccelerations) {
  // Up within 1 s, down within 7 s: over time friction does not cancel, over speed it does.
  PrescribedMotion drive;
  const auto up = drive.record(
      "up", TestKind::other, 1.0, [](double t) { return 20.0 * t; }, [](double) { return 20.0; });
  const auto down = drive.record(
      "down", TestKind::other, 7.0, [](double t) { return 20.0 * std::exp(-t / 1.5); },
      [](double t) { return -20.0 / 1.5 * std::exp(-t / 1.5); });
  const double scale = torque_per_pressure(PrescribedMotion::knowledge());
  double impulse = 0.0, change = 0.0, path = 0.0;
  for (const auto& [record, from, to] : {std::tuple{up, 1.0, 18.0}, std::tuple{down, 18.0, 1.0}}) {
    const auto motion = integrate_over_speed(record, {0, record.samples() - 1, 0}, from, to, 0.1);
    impulse +=
        scale * (motion.pressure_impulse.head(2).sum() - motion.pressure_impulse.tail(2).sum());
    change += motion.rate_change;
    path += motion.duration;
  }
  EXPECT_NEAR(path, 0.0, 1e-9);
  EXPECT_NEAR(impulse / change, drive.inertia, 5e-3 * drive.inertia);
}

TEST(IntegrateOverSpeed, RefusesASmoothingLongerThanTheWindow) {
  EXPECT_THAT(reference::Call([] {
                integrate_over_speed(polynomial(3.0, 0.0), {0, 20, 0}, 1.0, 1.2, 1.0);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive smoothing time and a window of ")));
}

TEST(UsableSamples, LeavesAGuardAboutClippedAndMissingOnes) {
  auto record = polynomial(1.0, 0.0);
  record.motor_rate.valid[200] = false;
  record.inlet_pressure[1].valid.assign(static_cast<std::size_t>(record.samples()), true);
  record.inlet_pressure[1].valid[400] = false;
  record.motor_rate_limit = 1.0 + 1.0 * 3.5;
  const auto found = stretches(usable_samples(record, 0.05));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].last, 189);
  EXPECT_EQ(found[1].first, 211);
  EXPECT_EQ(found[1].last, 389);
  EXPECT_EQ(found[2].first, 411);
  // The limit is reached at 3.5 s less a thousandth of 4.5 rad/s.
  EXPECT_EQ(found[2].last, 700 - 1 - 10);
}

TEST(NoiseLevel, IsTheNoisesAloneOnASlowMotionWithOutliers) {
  const numerics::NormalNumbers normal(3);
  Eigen::VectorXd signal(4000);
  for (Eigen::Index i = 0; i < signal.size(); ++i) {
    signal(i) = 20.0 * std::sin(0.01 * static_cast<double>(i)) +
                0.3 * normal.pair(static_cast<std::uint64_t>(i)).real();
    if (i % 100 == 0) signal(i) += 50.0;
  }
  EXPECT_NEAR(noise_level(signal), 0.3, 0.03);
  EXPECT_EQ(noise_level(Eigen::VectorXd::Ones(4)), 0.0);
}

TEST(StructuralJerkInertia, LiesBetweenThreeFifthsAndAllOfTheAntennaAtTheLowestMode) {
  DriveKnowledge knowledge = PrescribedMotion::knowledge();
  EXPECT_EQ(structural_jerk_inertia(knowledge).value, 0.0);
  knowledge.locked_rotor_frequencies = {{2.0, 0.1}, {3.0, 0.1}};
  const auto [value, deviation] = structural_jerk_inertia(knowledge);
  const double all = 0.45 / std::pow(4.0 * std::numbers::pi, 2);
  EXPECT_NEAR(value, 0.8 * all, 1e-15);
  EXPECT_NEAR(deviation, 0.4 * all / std::sqrt(12.0), 1e-15);
}

}  // namespace
}  // namespace boresight::identification
