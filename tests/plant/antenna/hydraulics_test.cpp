#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(BulkModulus, GivesThePublishedValueOfTheLongestLine) {
  // Eq. 26 in the paper's own inches: 614 in, 38.3 Hz, 7.95e-5 lbf s2/in4 -> 175 857 lbf/in2.
  EXPECT_NEAR(bulk_modulus_from_slosh(614.0, 38.3, 7.95e-5), 175857.0, 1.0);
  // In SI to the digits of its rounded length and density.
  EXPECT_NEAR(bulk_modulus_from_slosh(15.60, 38.3, 850.0), 1212.5e6, 2e-3 * 1212.5e6);
}

TEST(BulkModulus, MakesAWaveOfOneSoundPassageAHalfPeriod) {
  const double modulus = 1229e6, density = 850.0, length = 14.2;
  const double sound = std::sqrt(modulus / density);
  EXPECT_NEAR(slosh_frequency(length, modulus, density), 0.5 * sound / length, 1e-9);
  EXPECT_NEAR(
      bulk_modulus_from_slosh(length, slosh_frequency(length, modulus, density), density) / modulus,
      1.0, 1e-14);
}

TEST(OilStiffness, IsTheTorqueOfTheOilSqueezedOutByOneTurn) {
  const HydraulicDrive drive = reference::hydraulic_drive();
  // Eqs. 9 to 15 step by step: turn by theta, move e_v D theta of oil, pressures, torque.
  const double theta = 1e-3;
  const double volume = drive.volumetric_efficiency * 4.0 * drive.displacement * theta;
  const double pressure = drive.bulk_modulus * (volume / drive.volume_1 + volume / drive.volume_2);
  const double torque = torque_per_pressure(drive) * pressure;
  EXPECT_NEAR(oil_stiffness(drive), torque / theta, 1e-12 * torque / theta);
  EXPECT_NEAR(torque_per_pressure(drive) * 1e6, 22.89, 0.005);  // N m/MPa
  EXPECT_NEAR(4.0 * drive.displacement, 2.4401e-5, 1e-9);       // m3/rad
}

TEST(OilStiffness, LeavesTheEfficienciesOutWhereAsked) {
  HydraulicDrive drive = reference::hydraulic_drive();
  const double both = oil_stiffness(drive);
  drive.efficiency_in_stiffness = EfficiencyInStiffness::none;
  EXPECT_NEAR(both / oil_stiffness(drive), 0.938 * 0.9412, 1e-12);
}

TEST(OilStiffness, NamesTheArgumentItRefuses) {
  const auto refuses = [](double HydraulicDrive::*member, const char* name) {
    for (const double bad : {0.0, -1.0, std::nan("")}) {
      HydraulicDrive drive = reference::hydraulic_drive();
      drive.*member = bad;
      EXPECT_THAT(reference::Call([&] { oil_stiffness(drive); }),
                  ThrowsMessage<InvalidInput>(HasSubstr(name)));
    }
  };
  refuses(&HydraulicDrive::motor_count, "motor count");
  refuses(&HydraulicDrive::displacement, "displacement");
  refuses(&HydraulicDrive::torque_efficiency, "torque efficiency");
  refuses(&HydraulicDrive::volumetric_efficiency, "volumetric efficiency");
  refuses(&HydraulicDrive::bulk_modulus, "bulk modulus");
  refuses(&HydraulicDrive::volume_1, "volume V1");
  refuses(&HydraulicDrive::volume_2, "volume V2");
}

TEST(HydraulicFrequency, InvertsToTheInertia) {
  const double stiffness = oil_stiffness(reference::hydraulic_drive());
  for (const double inertia : {0.1, 1.45, 1.776, 40.0}) {
    const double frequency = hydraulic_frequency(stiffness, inertia);
    EXPECT_NEAR(std::pow(two_pi * frequency, 2) * inertia, stiffness, 1e-12 * stiffness);
    EXPECT_NEAR(inertia_from_resonance(stiffness, frequency), inertia, 1e-13 * inertia);
  }
}

TEST(HydraulicFrequency, GivesTheInertiaOfTheMeasuredResonance) {
  const double inertia = inertia_from_resonance(oil_stiffness(reference::hydraulic_drive()), 0.97);
  EXPECT_NEAR(inertia, 1.416, 5e-4);  // the paper prints 1.45, which its own numbers do not give
}

TEST(HydraulicDamping, IsThatOfTheCharacteristicEquation) {
  // s2 + (Bf/J + lambda) s + (K + Bf lambda)/J = 0: its root is a zero of the polynomial.
  const double k = 52.6, j = 1.8, leakage = 1.219, friction = 0.9;
  const double natural = std::sqrt((k + friction * leakage) / j);
  const double zeta = hydraulic_damping(k, j, leakage, friction);
  const std::complex<double> root =
      natural * std::complex<double>{-zeta, std::sqrt(1.0 - zeta * zeta)};
  const std::complex<double> value =
      root * root + (friction / j + leakage) * root + (k + friction * leakage) / j;
  EXPECT_LT(std::abs(value), 1e-12);
  // lambda = 1.219 1/s was chosen for 0.10 at 0.97 Hz.
  EXPECT_NEAR(hydraulic_damping(k, inertia_from_resonance(k, 0.97), 1.219, 0.0), 0.10, 1e-4);
}

TEST(HydraulicDamping, MovesOppositelyToFrequencyWithLeakageAlone) {
  // 2 zeta wn = lambda holds no inertia: a flywheel lowers the frequency and raises the damping.
  const double k = 52.6, leakage = 1.2;
  for (const double inertia : {0.5, 1.0, 2.0}) {
    const double product =
        2.0 * hydraulic_damping(k, inertia, leakage, 0.0) * hydraulic_frequency(k, inertia);
    EXPECT_NEAR(product * two_pi, leakage, 1e-12);
  }
}

TEST(Hydraulics, NamesWhatItRefuses) {
  EXPECT_THAT(reference::Call([] { bulk_modulus_from_slosh(-1, 40, 850); }),
              ThrowsMessage<InvalidInput>(HasSubstr("line length, found -1")));
  EXPECT_THAT(reference::Call([] { bulk_modulus_from_slosh(1, 0, 850); }),
              ThrowsMessage<InvalidInput>(HasSubstr("slosh frequency")));
  EXPECT_THAT(reference::Call([] { slosh_frequency(1, 1e9, std::nan("")); }),
              ThrowsMessage<InvalidInput>(HasSubstr("density")));
  EXPECT_THAT(reference::Call([] { hydraulic_frequency(1, 0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("reflected inertia")));
  EXPECT_THAT(reference::Call([] { inertia_from_resonance(0, 1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("oil stiffness")));
  EXPECT_THAT(reference::Call([] { inertia_from_resonance(1, 0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("frequency")));
  EXPECT_THAT(reference::Call([] { hydraulic_damping(1, -1, 1, 1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("hydraulic_damping")));
}

}  // namespace
}  // namespace boresight::plant
