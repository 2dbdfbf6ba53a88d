#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../random_numbers.hpp"
#include "../reference_antenna.hpp"
#include <boresight/plant/error.hpp>
#include <boresight/plant/motors_held_modes.hpp>

namespace boresight::plant {
namespace {

using reference::relative_error;
using testing::HasSubstr;

// An antenna as stated by its frequencies with the motors held.
StructureSpecification motors_held(StructureSpecification antenna) {
  const auto held = motors_held_modes(make_structure(antenna));
  antenna.locked_rotor_frequency = held[0].frequency;
  for (std::size_t i = 0; i < antenna.modes.size(); ++i) {
    antenna.modes[i].frequency = held[i + 1].frequency;
  }
  return antenna;
}

// Modes in order that lie apart, of any weight.
StructureSpecification random_specification(reference::RandomNumbers& random) {
  StructureSpecification antenna;
  antenna.antenna_inertia = random.log_uniform(0.1, 10.0);
  antenna.locked_rotor_frequency = random.log_uniform(0.5, 5.0);
  antenna.bull_gear_wind_fraction = 1.0;
  antenna.bull_gear_beam_weight = 1.0;
  const int modes = random.integer(1, 4);
  double frequency = antenna.locked_rotor_frequency;
  for (int i = 0; i < modes; ++i) {
    frequency *= random.log_uniform(1.3, 2.5);
    antenna.modes.push_back({frequency, 0.01, random.uniform(0.1, 0.9) / modes, 0.0, 0.0});
  }
  return antenna;
}

double furthest_apart(const StructureSpecification& one, const StructureSpecification& other) {
  double apart =
      relative_error(make_structure(one).gear_stiffness, make_structure(other).gear_stiffness);
  for (std::size_t i = 0; i < one.modes.size(); ++i) {
    apart = std::max(apart, relative_error(one.modes[i].frequency, other.modes[i].frequency));
  }
  return apart;
}

std::string refusal(const StructureSpecification& stated) {
  try {
    hold_bull_gear_of(stated);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "taken";
}

TEST(MotorsHeldModes, AreTheRootsOfTheSecularEquation) {
  reference::RandomNumbers random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const auto antenna = random_specification(random);
    const auto structure = make_structure(antenna);
    const auto held = motors_held_modes(structure);
    ASSERT_EQ(held.size(), antenna.modes.size() + 1);
    EXPECT_LT(relative_error(held[0].frequency, antenna.locked_rotor_frequency), 1e-9);
    for (std::size_t i = 0; i < antenna.modes.size(); ++i) {
      EXPECT_LT(held[i].frequency, antenna.modes[i].frequency);
      EXPECT_GT(held[i + 1].frequency, antenna.modes[i].frequency);
    }
    for (const auto& vibration : held) {
      const double s = std::pow(reference::two_pi * vibration.frequency, 2);
      double sum = structure.gear_stiffness - s * structure.bull_gear_inertia;
      double largest = structure.gear_stiffness;
      for (const auto& mode : structure.modes) {
        const double term = s * mode.stiffness / (mode.stiffness / mode.inertia - s);
        sum -= term;
        largest = std::max(largest, std::abs(term));
      }
      EXPECT_LT(std::abs(sum), 1e-8 * largest);
    }
  }
}

// A turn of the whole antenna has all of its inertia and bends nothing but the gear spring; turned
// with constant acceleration it bends that by J/K_g, and every mode by 1/x_i besides.
TEST(MotorsHeldModes, ShareInertiaAndStiffnessOfTheWholeAntenna) {
  reference::RandomNumbers random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const auto structure = make_structure(random_specification(random));
    const double inertia = antenna_inertia(structure);
    double bending = inertia / structure.gear_stiffness;
    for (const auto& mode : structure.modes) {
      bending += mode.inertia / inertia * mode.inertia / mode.stiffness;
    }
    double fractions = 0.0;
    double stiffness = 0.0;
    double compliance = 0.0;
    for (const auto& vibration : motors_held_modes(structure)) {
      const double s = std::pow(reference::two_pi * vibration.frequency, 2);
      EXPECT_GT(vibration.inertia_fraction, 0.0);
      fractions += vibration.inertia_fraction;
      stiffness += vibration.inertia_fraction * inertia * s;
      compliance += vibration.inertia_fraction / s;
    }
    EXPECT_NEAR(fractions, 1.0, 1e-12);
    EXPECT_LT(relative_error(stiffness, structure.gear_stiffness), 1e-9);
    EXPECT_LT(relative_error(compliance, bending), 1e-9);
  }
}

// The turn leans on the bull gear alone (K 1 = K_g e_b), so that each mode's square of the bull
// gear's swing goes as fraction times s^2; the bull gear's response to a torque on it is zero where
// the modes swing with it held. So frequencies and fractions give those of the bull gear held.
TEST(MotorsHeldModes, DetermineTheModesWithTheBullGearHeld) {
  reference::RandomNumbers random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const auto structure = make_structure(random_specification(random));
    const auto held = motors_held_modes(structure);
    for (const auto& mode : structure.modes) {
      const double x = mode.stiffness / mode.inertia;
      double response = 0.0;
      double largest = 0.0;
      for (const auto& vibration : held) {
        const double s = std::pow(reference::two_pi * vibration.frequency, 2);
        const double term = vibration.inertia_fraction * s * s / (s - x);
        response += term;
        largest = std::max(largest, std::abs(term));
      }
      EXPECT_LT(std::abs(response), 1e-8 * largest);
    }
  }
}

TEST(MotorsHeldModes, GoForwardsAndBack) {
  reference::RandomNumbers random(5);
  int several = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto antenna = random_specification(random);
    const auto stated = motors_held(antenna);
    const auto found = hold_bull_gear_of(stated);
    several += found.size() > 1 ? 1 : 0;
    double nearest = 1.0;
    double softer = 0.0;
    for (const auto& one : found) {
      nearest = std::min(nearest, furthest_apart(one, antenna));
      const auto again = motors_held(one);
      for (std::size_t i = 0; i < stated.modes.size(); ++i) {
        EXPECT_LT(relative_error(again.modes[i].frequency, stated.modes[i].frequency), 1e-9);
      }
      const double spring = make_structure(one).gear_stiffness;
      EXPECT_GT(spring, softer) << "the softest first";
      softer = spring;
    }
    EXPECT_LT(nearest, 1e-9) << "trial " << trial << ", modes " << antenna.modes.size();
  }
  EXPECT_GT(several, 50);
}

// Two roots of (1 + r) x^2 - (s0 + s1) x + s0 s1 = 0. The gear spring is J_b s0 s1/x, of which
// follows the fraction of the lowest mode, (s1 - K_g/J)/(s1 - s0).
TEST(MotorsHeldModes, OfOneModeAreTwoAntennas) {
  StructureSpecification stated;
  stated.antenna_inertia = 1.0;
  stated.locked_rotor_frequency = 1.0;
  stated.bull_gear_wind_fraction = stated.bull_gear_beam_weight = 1.0;
  stated.modes = {{2.0, 0.01, 0.2, 0.0, 0.0}};
  const auto found = hold_bull_gear_of(stated);
  ASSERT_EQ(found.size(), 2U);
  const double root = std::sqrt(25.0 - 4.0 * 1.25 * 4.0);
  EXPECT_NEAR(found[0].modes[0].frequency, std::sqrt((5.0 + root) / 2.5), 1e-12);
  EXPECT_NEAR(found[1].modes[0].frequency, std::sqrt((5.0 - root) / 2.5), 1e-12);
  EXPECT_EQ(found[0].modes[0].damping_ratio, 0.01);
  for (const auto& antenna : found) {
    const double x = std::pow(antenna.modes[0].frequency, 2);
    const auto held = motors_held_modes(make_structure(antenna));
    EXPECT_NEAR(held[0].inertia_fraction, (4.0 - 0.8 * 4.0 / x) / 3.0, 1e-9);
    EXPECT_NEAR(held[1].inertia_fraction, (0.8 * 4.0 / x - 1.0) / 3.0, 1e-9);
  }
}

// A light bull gear on a stiff spring, whose own frequency lies above all modes.
TEST(MotorsHeldModes, GiveTheReferenceAntennaBack) {
  const auto found = hold_bull_gear_of(motors_held(reference::structure()));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(furthest_apart(found[0], reference::structure()), 1e-9);
}

TEST(MotorsHeldModes, RefuseWhatIsNoAntenna) {
  StructureSpecification stated;
  stated.locked_rotor_frequency = 0.97;
  stated.modes = {{1.9, 0.01, 0.8, 1.0, 1.0}};
  // 4 (1 + r) s0 s1 <= (s0 + s1)^2 leaves a fraction of 0.344.
  EXPECT_THAT(refusal(stated), HasSubstr("expected inertia fractions of which an antenna has these "
                                         "frequencies with the motors held, found none: the mode "
                                         "of 1.9 Hz would need an inertia_fraction of some 0.32 in "
                                         "the place of 0.8"));
  stated.modes[0].inertia_fraction = 0.32;
  EXPECT_EQ(refusal(stated), "taken");
  const auto refused = [&](const std::function<void(StructureSpecification&)>& change,
                           const std::string& words) {
    auto changed = stated;
    change(changed);
    EXPECT_THAT(refusal(changed), HasSubstr(words));
  };
  refused([](auto& s) { s.modes[0].frequency = 0.9; }, "found 0.9 Hz behind 0.97 Hz");
  refused([](auto& s) { s.modes[0].inertia_fraction = 0.0; }, "positive inertia fractions");
  refused([](auto& s) { s.modes[0].inertia_fraction = 1.0; }, "sum to less than 1");
  refused([](auto& s) { s.modes.resize(9, s.modes[0]); }, "at most 8 modes");
}

}  // namespace
}  // namespace boresight::plant
