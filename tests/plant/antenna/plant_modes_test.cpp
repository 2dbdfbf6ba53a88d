#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::plant {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

// The mode whose frequency is nearest, among the oscillating ones.
PlantMode nearest(const std::vector<PlantMode>& modes, double frequency) {
  PlantMode best;
  for (const auto& mode : modes) {
    if (mode.pole.imag() == 0.0) continue;
    if (std::abs(mode.frequency - frequency) < std::abs(best.frequency - frequency)) best = mode;
  }
  return best;
}

TEST(PlantModes, AreThoseOfTheReferenceAntenna) {
  const auto modes = plant_modes(reference::antenna());
  EXPECT_NEAR(nearest(modes, 0.848).frequency, 0.848, 5e-4);
  EXPECT_NEAR(nearest(modes, 0.848).damping_ratio, 0.152, 5e-4);
  for (const double frequency : {2.26, 3.26, 4.41, 5.93}) {
    const PlantMode mode = nearest(modes, frequency);
    EXPECT_NEAR(mode.frequency, frequency, 5e-3);
    EXPECT_THAT(mode.description, HasSubstr("structure: mode"));
    EXPECT_LT(mode.damping_ratio, 0.03);
  }
  EXPECT_NEAR(nearest(modes, 12.0).frequency, 12.0, 1e-9);
  EXPECT_NEAR(nearest(modes, 12.0).damping_ratio, 0.7, 1e-9);
  EXPECT_EQ(nearest(modes, 12.0).description, "valve");
  EXPECT_NEAR(nearest(modes, 12.2).frequency, 12.2, 0.05);
  EXPECT_EQ(modes.front().description, "free rotation of the antenna");
}

TEST(PlantModes, AreThePolesInOrder) {
  reference::RandomNumbers random(61);
  for (int trial = 0; trial < 10; ++trial) {
    const AntennaPlant plant = reference::random_antenna(random);
    const auto modes = plant_modes(plant);
    Eigen::Index poles = 0;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      poles += modes[i].pole.imag() > 0.0 ? 2 : 1;
      EXPECT_GT(modes[i].participation, 0.0);
      EXPECT_LE(modes[i].participation, 1.0 + 1e-12);
      if (i == 0) continue;
      EXPECT_GE(modes[i].frequency, modes[i - 1].frequency);
    }
    EXPECT_EQ(poles, to_state_space(plant).a.rows());
  }
}

TEST(PlantModes, BearEachItsOwnNameAndOneIsTheHydraulicMode) {
  for (const double softer : {1.0, 0.3, 0.03}) {
    AntennaPlant plant = reference::antenna();
    plant.drive.oil_stiffness *= softer;
    plant.drive.valve_damping = 1.5;  // two real poles, which one name would not tell apart
    const auto modes = plant_modes(plant);
    std::set<std::string> names;
    for (const auto& mode : modes) {
      EXPECT_TRUE(names.insert(mode.description).second) << mode.description;
    }
    EXPECT_TRUE(names.contains("valve, 2 of 2"));
    const auto called = std::ranges::find_if(modes, [](const PlantMode& mode) {
      return mode.description == "hydraulic: antenna on oil and gear springs in series";
    });
    ASSERT_NE(called, modes.end());
    EXPECT_EQ(called->frequency, hydraulic_mode(modes).frequency);
  }
}

TEST(PlantModes, CallTheLowestHydraulicWhereTheStructureMovesMost) {
  // Oil far stiffer than the structure, on which the antenna then swings.
  AntennaPlant plant = reference::antenna();
  plant.drive.oil_stiffness *= 10.0;
  const auto modes = plant_modes(plant);
  const auto lowest =
      std::ranges::find_if(modes, [](const PlantMode& mode) { return mode.pole.imag() != 0.0; });
  ASSERT_NE(lowest, modes.end());
  EXPECT_GT(lowest->participation, 0.5);
  EXPECT_THAT(lowest->description,
              AllOf(StartsWith("structure: mode 1 ("), EndsWith(", the hydraulic mode")));
  EXPECT_EQ(hydraulic_mode(modes).frequency, lowest->frequency);
}

TEST(HydraulicMode, FollowsFlywheelsAsTheOilSpringSays) {
  // Fewer disks: higher frequency, and with leakage less damping.
  const auto with = hydraulic_mode(plant_modes(reference::antenna(24.0)));
  const auto without = hydraulic_mode(plant_modes(reference::antenna(0.0)));
  EXPECT_THAT(with.description, HasSubstr("hydraulic"));
  EXPECT_GT(without.frequency, 1.3 * with.frequency);
  // A flexible structure lowers the mode below the rigid formula.
  const AntennaPlant plant = reference::antenna();
  EXPECT_LT(with.frequency,
            hydraulic_frequency(plant.drive.oil_stiffness, reflected_inertia(plant)));
}

TEST(HydraulicMode, OfARigidAntennaIsTheClosedForm) {
  AntennaPlant plant = reference::antenna();
  StructureSpecification specification = reference::structure();
  specification.locked_rotor_frequency *= 1e3;
  for (auto& mode : specification.modes) mode.frequency *= 1e3;
  plant.structure = make_structure(specification);
  const double j = reflected_inertia(plant);
  for (const double friction : {0.0, 3.0, 60.0}) {  // the last one overdamped
    plant.drive.viscous_friction = friction;
    const auto mode = hydraulic_mode(plant_modes(plant));
    const double zeta =
        hydraulic_damping(plant.drive.oil_stiffness, j, plant.drive.leakage_rate, friction);
    const double natural =
        std::sqrt((plant.drive.oil_stiffness + friction * plant.drive.leakage_rate) / j);
    EXPECT_NEAR(mode.damping_ratio, zeta, 1e-4 * zeta);
    EXPECT_NEAR(mode.frequency * two_pi, natural, 1e-4 * natural);
    EXPECT_EQ(zeta > 1.0, mode.description.ends_with("overdamped"));
  }
}

TEST(HydraulicMode, StaysOneModeAsFlywheelsAreAdded) {
  // With oil stiffer than the structure the motors' largest swing is in a mode above.
  for (const double stiffness : {1.0, 3.0, 6.0}) {
    AntennaPlant plant = reference::antenna(0.0);
    plant.drive.oil_stiffness *= stiffness;
    PlantMode before = hydraulic_mode(plant_modes(plant));
    EXPECT_LT(before.frequency, reference::structure().locked_rotor_frequency);
    for (double disks = 2.0; disks <= 48.0; disks += 2.0) {
      plant.drive.motor_inertia = reference::antenna(disks).drive.motor_inertia;
      const PlantMode mode = hydraulic_mode(plant_modes(plant));
      EXPECT_LT(mode.frequency, before.frequency) << stiffness << ", " << disks;
      EXPECT_GT(mode.frequency, 0.93 * before.frequency) << stiffness << ", " << disks;
      EXPECT_GT(mode.damping_ratio, before.damping_ratio) << stiffness << ", " << disks;
      before = mode;
    }
  }
}

// An antenna of one body on the gear spring, the oil so many times as stiff as that.
AntennaPlant on_gear_spring(double oil_over_gear) {
  AntennaPlant plant = reference::antenna(24.0);
  StructureSpecification specification = reference::structure();
  specification.modes.clear();
  specification.gear_damping_ratio = 0.0;
  specification.bull_gear_wind_fraction = 1.0;
  specification.bull_gear_beam_weight = 1.0;
  plant.structure = make_structure(specification);
  plant.drive.oil_stiffness = oil_over_gear * plant.structure.gear_stiffness;
  plant.drive.viscous_friction = 0.0;
  plant.drive.leakage_rate = 0.0;
  return plant;
}

TEST(OilFraction, IsTheOilSpringsShareOfTheElasticEnergy) {
  for (const double stiffer : {0.1, 1.0, 10.0}) {
    const AntennaPlant plant = on_gear_spring(stiffer);
    const double k = plant.drive.oil_stiffness, kg = plant.structure.gear_stiffness;
    int modes = 0;
    for (const auto& mode : plant_modes(plant)) {
      if (mode.pole.imag() == 0.0 || mode.oil_participation < 1e-6) continue;
      ++modes;
      // Motor and bull gear swing as (kg - J w^2) and kg.
      const double motor =
          kg - plant.structure.bull_gear_inertia * std::pow(two_pi * mode.frequency, 2);
      const double oil = k * motor * motor, gear = kg * std::pow(motor - kg, 2);
      EXPECT_NEAR(mode.oil_fraction, oil / (oil + gear), 1e-8) << stiffer;
      EXPECT_NEAR(mode.gear_fraction, gear / (oil + gear), 1e-8) << stiffer;
    }
    EXPECT_EQ(modes, 2);
  }
}

TEST(OilFraction, IsHowTheFrequencyFollowsTheOil) {
  for (const double friction : {0.0, 3.0, 60.0}) {
    AntennaPlant plant = reference::antenna(24.0);
    plant.drive.viscous_friction = friction;
    constexpr double step = 1e-5;
    const auto own = hydraulic_mode(plant_modes(plant));
    const auto at = [&](double factor) {
      AntennaPlant other = plant;
      other.drive.oil_stiffness *= factor;
      return hydraulic_mode(plant_modes(other)).frequency;
    };
    const double slope = std::log(at(1.0 + step) / at(1.0 - step)) / step;
    EXPECT_NEAR(own.oil_fraction, slope, 1e-6) << friction;
    const auto on_gear = [&](double factor) {
      AntennaPlant other = plant;
      other.structure.gear_stiffness *= factor;
      return hydraulic_mode(plant_modes(other)).frequency;
    };
    EXPECT_NEAR(own.gear_fraction, std::log(on_gear(1.0 + step) / on_gear(1.0 - step)) / step, 1e-6)
        << friction;
  }
}

TEST(ModeOfOil, IsAnotherThanTheHydraulicOneOnASoftGearSpring) {
  const auto soft = plant_modes(on_gear_spring(100.0));
  EXPECT_LT(hydraulic_mode(soft).oil_fraction, 0.1);
  EXPECT_GT(mode_of_oil(soft).oil_fraction, 0.9);
  EXPECT_GT(mode_of_oil(soft).frequency, 2.0 * hydraulic_mode(soft).frequency);
  const auto stiff = plant_modes(on_gear_spring(0.1));
  EXPECT_EQ(mode_of_oil(stiff).frequency, hydraulic_mode(stiff).frequency);
}

TEST(HydraulicMode, NeedsAModeThatMovesTheOil) {
  EXPECT_THAT(reference::Call([] { hydraulic_mode({}); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("no mode of the plant")));
}

}  // namespace
}  // namespace boresight::plant
