#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_antenna.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

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

// The same, with the fractions that its modes have with the motors held.
StructureSpecification motors_held_effective(StructureSpecification antenna) {
  const auto held = motors_held_modes(make_structure(antenna));
  antenna = motors_held(antenna);
  for (std::size_t i = 0; i < antenna.modes.size(); ++i) {
    antenna.modes[i].inertia_fraction = held[i + 1].inertia_fraction;
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

template <class Solve>
std::string refusal(const StructureSpecification& stated, const Solve& solve) {
  try {
    solve(stated);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "taken";
}

std::string refusal(const StructureSpecification& stated) {
  return refusal(stated, hold_bull_gear_of);
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
    double gear_fractions = 0.0;
    for (const auto& vibration : held) {
      const double s = std::pow(two_pi * vibration.frequency, 2);
      gear_fractions += vibration.gear_fraction;
      EXPECT_NEAR(
          vibration.gear_fraction,
          vibration.inertia_fraction * antenna_inertia(structure) * s / structure.gear_stiffness,
          1e-9);
      double sum = structure.gear_stiffness - s * structure.bull_gear_inertia;
      double largest = structure.gear_stiffness;
      for (const auto& mode : structure.modes) {
        const double term = s * mode.stiffness / (mode.stiffness / mode.inertia - s);
        sum -= term;
        largest = std::max(largest, std::abs(term));
      }
      EXPECT_LT(std::abs(sum), 1e-8 * largest);
    }
    EXPECT_NEAR(gear_fractions, 1.0, 1e-9);
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
      const double s = std::pow(two_pi * vibration.frequency, 2);
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
        const double s = std::pow(two_pi * vibration.frequency, 2);
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
                                         "of 1.9 Hz would need an inertia_fraction of some 0.32 "
                                         "instead of 0.8"));
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

TEST(EffectiveFractions, GiveTheAntennaBack) {
  reference::RandomNumbers random(17);
  for (int trial = 0; trial < 200; ++trial) {
    const auto antenna = random_specification(random);
    const auto stated = motors_held_effective(antenna);
    const auto found = antenna_of_effective_fractions(stated);
    EXPECT_LT(furthest_apart(found, antenna), 1e-9) << "trial " << trial;
    for (std::size_t i = 0; i < antenna.modes.size(); ++i) {
      EXPECT_LT(relative_error(found.modes[i].inertia_fraction, antenna.modes[i].inertia_fraction),
                1e-9)
          << "trial " << trial << ", mode " << i;
      EXPECT_EQ(found.modes[i].damping_ratio, antenna.modes[i].damping_ratio);
    }
    EXPECT_EQ(found.locked_rotor_frequency, stated.locked_rotor_frequency);
  }
}

// Any fractions have an antenna, of however many modes and however near to one another.
TEST(EffectiveFractions, AreThoseOfTheAntennaFound) {
  reference::RandomNumbers random(19);
  for (int trial = 0; trial < 100; ++trial) {
    StructureSpecification stated;
    stated.antenna_inertia = random.log_uniform(0.1, 10.0);
    stated.locked_rotor_frequency = random.log_uniform(0.5, 5.0);
    stated.bull_gear_wind_fraction = stated.bull_gear_beam_weight = 1.0;
    const int modes = random.integer(1, 12);
    double frequency = stated.locked_rotor_frequency;
    double left = 1.0;
    for (int i = 0; i < modes; ++i) {
      frequency *= random.log_uniform(1.02, 2.0);
      const double fraction = left * random.log_uniform(0.001, 0.9);
      left -= fraction;
      stated.modes.push_back({frequency, 0.01, fraction, 0.0, 0.0});
    }
    const auto structure = make_structure(antenna_of_effective_fractions(stated));
    const auto held = motors_held_modes(structure);
    EXPECT_LT(relative_error(held[0].frequency, stated.locked_rotor_frequency), 1e-8);
    double spring = left * std::pow(two_pi * stated.locked_rotor_frequency, 2);
    for (std::size_t i = 0; i < stated.modes.size(); ++i) {
      EXPECT_LT(relative_error(held[i + 1].frequency, stated.modes[i].frequency), 1e-8);
      EXPECT_NEAR(held[i + 1].inertia_fraction, stated.modes[i].inertia_fraction, 1e-8);
      spring += stated.modes[i].inertia_fraction * std::pow(two_pi * stated.modes[i].frequency, 2);
    }
    EXPECT_LT(relative_error(structure.gear_stiffness, stated.antenna_inertia * spring), 1e-8)
        << "trial " << trial;
  }
}

// p_0 (s_1 - x) + p_1 (s_0 - x) = 0 with p_j as e_j s_j^2: a straight line. The bull gear has
// (sum e s)^2/sum e s^2 of the inertia and the mode the rest.
TEST(EffectiveFractions, OfOneModeAreAClosedForm) {
  StructureSpecification stated;
  stated.antenna_inertia = 3.0;
  stated.locked_rotor_frequency = 1.9;
  stated.gear_damping_ratio = 0.02;
  stated.modes = {{3.4, 0.01, 0.25, 0.7, 0.8}};
  const double lower = 1.9 * 1.9;
  const double upper = 3.4 * 3.4;
  const double compliance = 0.75 * lower * lower + 0.25 * upper * upper;
  const double x = lower * upper * (0.75 * lower + 0.25 * upper) / compliance;
  const auto found = antenna_of_effective_fractions(stated);
  EXPECT_NEAR(found.modes[0].frequency, std::sqrt(x), 1e-13);
  EXPECT_NEAR(found.modes[0].inertia_fraction,
              1.0 - std::pow(0.75 * lower + 0.25 * upper, 2) / compliance, 1e-13);
  EXPECT_NEAR(found.modes[0].frequency, 2.326, 5e-4);
  EXPECT_NEAR(found.modes[0].inertia_fraction, 0.2744, 5e-5);
  EXPECT_EQ(found.antenna_inertia, 3.0);
  EXPECT_EQ(found.gear_damping_ratio, 0.02);
  EXPECT_EQ(found.modes[0].wind_fraction, 0.7);
  EXPECT_EQ(found.modes[0].beam_weight, 0.8);
}

// A light mode is beside its frequency with the motors held and moves nothing. Of the antenna
// without it, the mode lies at 2.351 Hz, so that in rising order the light one comes behind.
TEST(EffectiveFractions, OfALightModeLeaveTheOthers) {
  StructureSpecification stated;
  stated.locked_rotor_frequency = 2.0;
  stated.modes = {{2.5, 0.01, 1e-12, 0.0, 0.0}, {4.0, 0.01, 0.3, 0.0, 0.0}};
  const auto found = antenna_of_effective_fractions(stated);
  EXPECT_NEAR(found.modes[1].frequency, 2.5, 1e-10);
  EXPECT_LT(found.modes[1].inertia_fraction, 1e-10);
  auto alone = stated;
  alone.modes.erase(alone.modes.begin());
  const auto without = antenna_of_effective_fractions(alone);
  EXPECT_NEAR(found.modes[0].frequency, without.modes[0].frequency, 1e-9);
  EXPECT_NEAR(found.modes[0].inertia_fraction, without.modes[0].inertia_fraction, 1e-9);
  alone.modes.clear();
  EXPECT_EQ(antenna_of_effective_fractions(alone).locked_rotor_frequency, 2.0);
}

TEST(EffectiveFractions, RefuseWhatIsNoAntenna) {
  const auto refused = [](double frequency, double fraction, const std::string& words) {
    StructureSpecification stated;
    stated.locked_rotor_frequency = 1.9;
    stated.modes = {{2.4, 0.01, 0.25, 0.0, 0.0}, {frequency, 0.01, fraction, 0.0, 0.0}};
    EXPECT_THAT(refusal(stated, antenna_of_effective_fractions), HasSubstr(words));
  };
  refused(3.4, 0.25, "taken");
  refused(2.4, 0.25, "found 2.4 Hz behind 2.4 Hz");
  refused(-1.0, 0.25, "found -1 Hz behind 2.4 Hz");
  refused(3.4, 0.0, "expected positive effective inertia fractions, found 0");
  refused(3.4, 0.75, "expected effective inertia fractions that sum to less than 1, found 1");
  refused(3.4, 1e-320, "found none but for rounding");
}

}  // namespace
}  // namespace boresight::plant
