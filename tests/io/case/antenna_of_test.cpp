#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;

std::vector<std::string> case_files() {
  const std::string root = BORESIGHT_SOURCE_DIR;
  return {root + "/cases/dss14-70m/case.toml",
          root + "/cases/dss14-70m/campaign.toml",
          root + "/cases/dss14-64m/case.toml",
          root + "/tests/data/campaigns/full/case.toml",
          root + "/tests/data/campaigns/small-dish/case.toml",
          root + "/tests/data/campaigns/paper-like/case.toml"};
}

Case reference() {
  return read_case(case_path("dss14-70m"));
}

TEST(AntennaOf, EveryCaseIsAnAntenna) {
  for (const std::string& file : case_files()) {
    const plant::Antenna antenna = antenna_of(read_case(file));
    EXPECT_NO_THROW(plant::validate(antenna)) << file;
    if (antenna.nonlinear) {
      EXPECT_NO_THROW(to_feedback_system(nonlinear_antenna(antenna))) << file;
    }
  }
}

TEST(AntennaOf, PlantHasTheNumbersOfTheCase) {
  for (const std::string& file : case_files()) {
    const Case stated = read_case(file);
    const plant::AntennaPlant plant = linear_plant(antenna_of(stated));
    EXPECT_EQ(plant.drive.oil_stiffness, plant::oil_stiffness(hydraulic_drive(stated)));
    EXPECT_EQ(plant.drive.leakage_rate, stated.drive->leakage_rate.value);
    EXPECT_EQ(plant.drive.viscous_friction, stated.drive->viscous_friction.value);
    const double ratio = gear_ratio(stated);
    plant::StructureSpecification structure = structure_specification(*stated.structure);
    structure.antenna_inertia = stated.antenna->inertia.value / (ratio * ratio);
    const plant::Structure expected = plant::make_structure(structure);
    EXPECT_EQ(plant.structure.gear_stiffness, expected.gear_stiffness);
    ASSERT_EQ(plant.structure.modes.size(), expected.modes.size());
    for (std::size_t i = 0; i < expected.modes.size(); ++i) {
      EXPECT_EQ(plant.structure.modes[i].stiffness, expected.modes[i].stiffness);
      EXPECT_EQ(plant.structure.modes[i].wind_fraction, expected.modes[i].wind_fraction);
    }
  }
}

TEST(AntennaOf, The70MetreCaseIsTheDemo) {
  const plant::Antenna stated = antenna_of(reference());
  const plant::Antenna demo = plant::demo_antenna();
  const auto near = [](double x, double y) { return std::abs(x / y - 1.0) < 1e-12; };
  EXPECT_TRUE(near(gear_ratio(stated), gear_ratio(demo)));
  EXPECT_TRUE(near(stated.inertia, demo.inertia));
  EXPECT_TRUE(near(gear_train_inertia(stated), gear_train_inertia(demo)));
  EXPECT_TRUE(near(motor_inertia(stated), motor_inertia(demo)));
  EXPECT_TRUE(near(oil_stiffness(stated), oil_stiffness(demo)));
  EXPECT_TRUE(near(stated.drive.supply_pressure, demo.drive.supply_pressure));
  EXPECT_TRUE(near(stated.drive.tracking_rate, demo.drive.tracking_rate));
  EXPECT_TRUE(near(stated.sensors.encoder_noise, demo.sensors.encoder_noise));
  EXPECT_EQ(stated.structure.modes.size(), demo.structure.modes.size());
  EXPECT_EQ(plant::change_paths(stated), plant::change_paths(demo));
}

TEST(AntennaOf, SpreadsTheMotorsOverTheLinesStated) {
  const plant::Antenna antenna = antenna_of(reference());
  ASSERT_TRUE(antenna.nonlinear.has_value());
  EXPECT_THAT(antenna.nonlinear->line_lengths,
              ElementsAre(13.11, testing::DoubleNear(13.94, 1e-12),
                          testing::DoubleNear(14.77, 1e-12), testing::DoubleNear(15.60, 1e-12)));
}

TEST(AntennaOf, WithoutSimulationHasNoNonlinearDrive) {
  Case stated = reference();
  stated.simulation.reset();
  EXPECT_FALSE(antenna_of(stated).nonlinear.has_value());
}

TEST(AntennaOf, ChangesAPlantByTheKeysOfTheCase) {
  const Case stated = reference();
  Case softer = stated;
  softer.oil->bulk_modulus->value *= 0.8;
  softer.structure->modes[1].frequency.value *= 1.1;
  const auto edited = make_plant(softer);
  const auto changed = make_plant(stated, {plant::scaled_by("oil.bulk_modulus", 0.8),
                                           plant::scaled_by("structure.mode[1].frequency", 1.1)});
  EXPECT_EQ(edited.drive.oil_stiffness, changed.drive.oil_stiffness);
  EXPECT_EQ(edited.structure.modes[1].stiffness, changed.structure.modes[1].stiffness);
  EXPECT_EQ(edited.structure.gear_stiffness, changed.structure.gear_stiffness);
}

TEST(AntennaOf, GivesEveryAntennaOfFrequenciesWithTheMotorsHeld) {
  Case stated = reference();
  stated.structure->modes.resize(1);
  stated.structure->modes[0].frequency.value = 4.0;
  stated.structure->modes[0].inertia_fraction.value = 0.2;
  stated.structure->modes[0].wind_fraction.value = 1.0;
  stated.structure->modes[0].beam_weight.value = 0.95;
  stated.structure->motors_held = true;
  const auto antennas = antennas_of(stated);
  ASSERT_EQ(antennas.size(), 2U);
  EXPECT_LT(linear_plant(antennas[0]).structure.gear_stiffness,
            linear_plant(antennas[1]).structure.gear_stiffness);
  EXPECT_EQ(linear_plant(antennas[0]).structure.gear_stiffness,
            make_plant(stated).structure.gear_stiffness);
}

}  // namespace
}  // namespace boresight::io
