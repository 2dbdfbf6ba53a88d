#include <cmath>
#include <complex>
#include <utility>

#include <gtest/gtest.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/oscillating_drive.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

FrictionDrive frictionless() {
  FrictionDrive drive;
  drive.oil_stiffness = 90.0;
  drive.leakage_rate = 0.4;
  drive.inertia = 3.0;
  drive.viscous_friction = 2.0;
  return drive;
}

FrictionDrive with_friction() {
  FrictionDrive drive = frictionless();
  drive.friction = {10.0, 17.0, 0.15, 60.0, 1.5, 2.0};
  return drive;
}

// Opening that holds the breakaway torque against leakage.
double moving_opening(const FrictionDrive& drive, double frequency) {
  return drive.friction.breakaway_torque * std::abs(Complex{drive.leakage_rate, frequency}) /
         drive.oil_stiffness;
}

TEST(OscillatingDrive, HasTheLinearResponseWithoutDryFriction) {
  const FrictionDrive drive = frictionless();
  // The hydraulic mode is at 5.5 rad/s.
  for (const auto& [frequency, accuracy] :
       {std::pair{0.02, 0.02}, {0.3, 0.02}, {2.0, 0.02}, {5.48, 0.11}, {8.2, 0.04}}) {
    const DriveOscillation found = oscillation_of(drive, frequency, 0.7, {});
    const Complex s{0.0, frequency};
    const Complex oil = drive.oil_stiffness / (s + drive.leakage_rate);
    const Complex load = drive.inertia * s + drive.viscous_friction;
    const Complex rate = oil / (oil + load);
    EXPECT_LT(std::abs(found.rate - rate), accuracy * std::abs(rate)) << frequency;
    EXPECT_LT(std::abs(found.torque - rate * load), accuracy * std::abs(rate * load)) << frequency;
    // Of a sine the angle has the rate's amplitude over the frequency.
    EXPECT_NEAR(found.angle.maxCoeff(), 0.7 * std::abs(rate) / frequency,
                accuracy * found.angle.maxCoeff());
  }
}

TEST(OscillatingDrive, StandsWhileTheTorqueIsBelowBreakaway) {
  const FrictionDrive drive = with_friction();
  for (const double frequency : {0.05, 1.0}) {
    const double moving = moving_opening(drive, frequency);
    const DriveOscillation held = oscillation_of(drive, frequency, 0.98 * moving, {});
    EXPECT_EQ(held.rate, Complex{});
    EXPECT_EQ(held.angle.maxCoeff(), 0.0);
    // The oil's pressure is that of a held motor.
    const Complex torque = drive.oil_stiffness / Complex{drive.leakage_rate, frequency};
    EXPECT_LT(std::abs(held.torque - torque), 0.02 * std::abs(torque));
    EXPECT_GT(oscillation_of(drive, frequency, 1.05 * moving, {}).angle.maxCoeff(), 0.0);
  }
}

TEST(OscillatingDrive, DissipatesWhatTheValvePutsIn) {
  const FrictionDrive drive = with_friction();
  for (const double times : {1.3, 3.0, 20.0}) {
    const double frequency = 0.3;
    const double opening = times * moving_opening(drive, frequency);
    const DriveOscillation found = oscillation_of(drive, frequency, opening, {});
    // Work of the torque on the motor over a period against friction's, from the angle's steps.
    const auto count = found.angle.size();
    const double step = two_pi / (frequency * static_cast<double>(count));
    double dissipated = 0.0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const double rate = (found.angle[(k + 1) % count] - found.angle[k]) / step;
      const double torque = friction_torque(drive.friction, rate) + drive.viscous_friction * rate;
      dissipated += torque * rate * step;
    }
    // Of the opening, which is a sine, only the fundamental does work: K x is its torque rate.
    const double put_in = 0.5 * opening * opening * found.torque.real() * two_pi / frequency;
    // Leakage takes the rest: lambda T^2/K, at least that of the fundamental.
    const double leaked = 0.5 * opening * opening * std::norm(found.torque) * drive.leakage_rate /
                          drive.oil_stiffness * two_pi / frequency;
    EXPECT_NEAR((dissipated + leaked) / put_in, 1.0, 0.05) << times;
  }
}

TEST(OscillatingDrive, TendsToTheLinearResponseInLargeMotion) {
  FrictionDrive drive = with_friction();
  drive.friction.saturating_torque = 0.0;
  const double frequency = 0.3;
  const DriveOscillation found =
      oscillation_of(drive, frequency, 1000.0 * moving_opening(drive, frequency), {});
  const Complex s{0.0, frequency};
  const Complex oil = drive.oil_stiffness / (s + drive.leakage_rate);
  const Complex load = drive.inertia * s + drive.viscous_friction + drive.friction.viscous_friction;
  const Complex rate = oil / (oil + load);
  EXPECT_LT(std::abs(found.rate - rate), 0.03 * std::abs(rate));
}

TEST(OscillatingDrive, DoesNotDependOnWhereItStarts) {
  const FrictionDrive drive = with_friction();
  const double frequency = 0.3, opening = 2.0 * moving_opening(drive, frequency);
  const DriveOscillation rest = oscillation_of(drive, frequency, opening, {});
  DriveOscillation elsewhere;
  elsewhere.end_torque = 40.0;
  elsewhere.end_rate = -0.5;
  const DriveOscillation other = oscillation_of(drive, frequency, opening, elsewhere);
  EXPECT_LT(std::abs(other.rate - rest.rate), 5e-3 * std::abs(rest.rate));
  EXPECT_NEAR(other.angle.maxCoeff(), rest.angle.maxCoeff(), 5e-3 * rest.angle.maxCoeff());
}

TEST(OscillatingDrive, MovesLessByAWeakerSupply) {
  FrictionDrive drive = with_friction();
  const double frequency = 0.3, opening = 3.0 * moving_opening(drive, frequency);
  const double strong = oscillation_of(drive, frequency, opening, {}).angle.maxCoeff();
  drive.supply_torque = 200.0;
  const double weaker = oscillation_of(drive, frequency, opening, {}).angle.maxCoeff();
  EXPECT_LT(weaker, strong);
  EXPECT_GT(weaker, 0.5 * strong);
}

}  // namespace
}  // namespace boresight::plant
