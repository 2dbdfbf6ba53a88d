#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/held_modes.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;

// Damping in proportion to stiffness, which couples the modes in neither form.
StructureSpecification specification() {
  StructureSpecification antenna;
  antenna.antenna_inertia = 0.36;
  antenna.bull_gear_wind_fraction = 0.1;
  antenna.bull_gear_beam_weight = 0.05;
  antenna.locked_rotor_frequency = 2.0;
  antenna.modes = {{2.4, 0.0048, 0.62, 0.65, 0.80},
                   {3.4, 0.0068, 0.14, 0.15, 0.25},
                   {4.6, 0.0092, 0.07, 0.10, -0.10}};
  return antenna;
}

VibrationModes free_modes() {
  return to_vibration_modes(make_structure(specification()));
}

TEST(HeldModes, AreTheMassesThatTheFreeModesCameFrom) {
  const auto expected = specification();
  const auto held = hold_bull_gear(free_modes());
  EXPECT_NEAR(held.antenna_inertia, expected.antenna_inertia, 1e-12);
  EXPECT_NEAR(held.bull_gear_wind_fraction, expected.bull_gear_wind_fraction, 1e-10);
  EXPECT_NEAR(held.bull_gear_beam_weight, expected.bull_gear_beam_weight, 1e-10);
  ASSERT_EQ(held.modes.size(), expected.modes.size());
  for (std::size_t i = 0; i < held.modes.size(); ++i) {
    EXPECT_NEAR(held.modes[i].frequency, expected.modes[i].frequency, 1e-10);
    EXPECT_NEAR(held.modes[i].inertia_fraction, expected.modes[i].inertia_fraction, 1e-10);
    EXPECT_NEAR(held.modes[i].wind_fraction, expected.modes[i].wind_fraction, 1e-10);
    EXPECT_NEAR(held.modes[i].beam_weight, expected.modes[i].beam_weight, 1e-10);
    EXPECT_NEAR(held.modes[i].damping_ratio, expected.modes[i].damping_ratio, 1e-10);
  }
}

// The same from frequencies with the bull gear held by other means: the zeros of the response from
// gear torque to bull gear.
TEST(HeldModes, StandAtTheZerosOfTheDrivePoint) {
  auto modes = free_modes();
  modes.frequency[2] *= 1.1;  // no longer of any chain
  const auto held = hold_bull_gear(modes);
  for (const auto& mode : held.modes) {
    const double square = std::pow(2.0 * std::numbers::pi * mode.frequency, 2);
    double sum = 0.0;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
      const double term =
          std::pow(modes.force_shape(i, 0), 2) / (std::pow(modes.frequency[i], 2) - square);
      sum += term;
      largest = std::max(largest, std::abs(term));
    }
    EXPECT_LT(std::abs(sum), 1e-8 * largest);
  }
}

TEST(HeldModes, DoNotDependOnUnitsOrSignsAndAddWindPatches) {
  const auto reference = hold_bull_gear(free_modes());
  auto modes = free_modes();
  modes.force_shape *= -7.0;
  modes.displacement_shape *= -7.0;
  modes.force_shape.conservativeResize(Eigen::NoChange, 3);
  modes.forces = {"gear_torque", "wind_1", "wind_2"};
  modes.force_shape.col(2) = 0.3 * modes.force_shape.col(1);
  modes.force_shape.col(1) *= 0.7;
  const auto held = hold_bull_gear(modes);
  EXPECT_NEAR(held.antenna_inertia, reference.antenna_inertia / 49.0, 1e-12);
  ASSERT_EQ(held.modes.size(), reference.modes.size());
  for (std::size_t i = 0; i < held.modes.size(); ++i) {
    EXPECT_NEAR(held.modes[i].inertia_fraction, reference.modes[i].inertia_fraction, 1e-10);
    EXPECT_NEAR(held.modes[i].wind_fraction, reference.modes[i].wind_fraction, 1e-10);
    EXPECT_NEAR(held.modes[i].beam_weight, reference.modes[i].beam_weight, 1e-10);
  }
}

TEST(HeldModes, OfARigidAntennaAreNone) {
  VibrationModes rigid;
  rigid.frequency = rigid.damping_ratio = Eigen::VectorXd::Zero(1);
  rigid.forces = {"gear_torque", "wind_torque"};
  rigid.displacements = {"bull_gear_angle", "encoder", "beam"};
  rigid.rates = {"bull_gear_rate", "", ""};
  rigid.force_shape = Eigen::MatrixXd::Constant(1, 2, 0.5);
  rigid.displacement_shape = Eigen::MatrixXd::Constant(3, 1, 0.5);
  const auto held = hold_bull_gear(rigid);
  EXPECT_TRUE(held.modes.empty());
  EXPECT_DOUBLE_EQ(held.antenna_inertia, 4.0);
  EXPECT_DOUBLE_EQ(held.bull_gear_wind_fraction, 1.0);
}

TEST(HeldModes, LeaveOutWhatNothingMovesAndRefuseWhatTheyCannotHold) {
  auto modes = free_modes();
  const Eigen::Index last = modes.frequency.size() - 1;
  modes.force_shape.row(last).setZero();
  modes.displacement_shape.col(last).setZero();
  EXPECT_EQ(hold_bull_gear(modes).modes.size(), static_cast<std::size_t>(last) - 1);

  const auto refusal = [](const std::function<void(VibrationModes&)>& edit) -> std::string {
    auto spoilt = free_modes();
    edit(spoilt);
    try {
      hold_bull_gear(spoilt);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal([&](VibrationModes& m) {
                m.force_shape(last, 0) = m.displacement_shape(0, last) = 0.0;
                m.displacement_shape(1, last) = 0.0;
              }),
              HasSubstr("that it does not but that moves the beam in wind"));
  EXPECT_THAT(refusal([](VibrationModes& m) { m.displacement_shape(1, 2) *= 1.01; }),
              HasSubstr("expected an encoder that follows the bull gear"));
  EXPECT_THAT(refusal([](VibrationModes& m) { m.displacement_shape.row(2) *= 1.02; }),
              HasSubstr("expected the beam in the free turn as at the bull gear"));
  EXPECT_THAT(refusal([](VibrationModes& m) { m.force_shape.col(1) *= 0.98; }),
              HasSubstr("expected the wind's work in the free turn"));
  EXPECT_THAT(refusal([](VibrationModes& m) {
                m.force_shape.conservativeResize(Eigen::NoChange, 1);
                m.forces.resize(1);
              }),
              HasSubstr("expected a wind force"));
  EXPECT_THAT(refusal([](VibrationModes& m) { m.frequency[0] = 0.1; }),
              HasSubstr("expected one mode of frequency 0"));
}

}  // namespace
}  // namespace boresight::plant
