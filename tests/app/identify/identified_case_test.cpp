#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/campaign/identified_case.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

io::Case seventy_metres() {
  return io::read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml");
}

identification::DriveEstimate estimate() {
  identification::DriveEstimate found;
  found.inertia = 1.79;
  found.motor_inertia = 1.21;
  found.oil_stiffness = 51.0;
  found.bulk_modulus = 1.2e9;
  found.leakage_rate = 0.6;
  found.lowest_frequency = 1.9;
  found.friction = {11.0, 17.0, 0.16, 60.0, 1.4, 2.2};
  found.offset_as_recorded = -4.0;
  found.bristle_stiffness = 2000.0;
  found.bristle_damping = 4.0;
  return found;
}

TEST(IdentifiedCase, IsThePlantOfTheEstimate) {
  const io::Case antenna = seventy_metres();
  const auto found = estimate();
  const io::Case identified = with_identified(antenna, found);
  const auto plant = make_plant(identified);
  EXPECT_NEAR(plant::reflected_inertia(plant), found.inertia, 1e-12);
  EXPECT_NEAR(motor_inertia(identified, identified.motor->flywheel_disks), found.motor_inertia,
              1e-12);
  EXPECT_NEAR(plant.drive.oil_stiffness, found.oil_stiffness, 1e-10);
  EXPECT_NEAR(bulk_modulus(identified), found.bulk_modulus, 1e-3);
  EXPECT_EQ(plant.drive.leakage_rate, found.leakage_rate);
  EXPECT_EQ(plant::friction_torque(io::friction_curve(identified), 3.0),
            plant::friction_torque(found.friction, 3.0));
  // All of the structure in proportion to its lowest frequency.
  const double scale = 1.9 / antenna.structure->locked_rotor_frequency.value;
  ASSERT_EQ(identified.structure->modes.size(), antenna.structure->modes.size());
  for (std::size_t i = 0; i < antenna.structure->modes.size(); ++i) {
    EXPECT_NEAR(identified.structure->modes[i].frequency.value,
                scale * antenna.structure->modes[i].frequency.value, 1e-12);
  }
}

TEST(IdentifiedCase, NoLongerAssumesWhatTheRecordsSay) {
  const io::Case antenna = seventy_metres();
  const auto keys = [](const io::Case& one) {
    std::vector<std::string> list;
    for (const auto& quantity : assumed_inputs(one)) list.push_back(quantity.key);
    return list;
  };
  EXPECT_THAT(keys(antenna), testing::Contains("drive.leakage_rate"));
  const auto left = keys(with_identified(antenna, estimate()));
  EXPECT_THAT(left, testing::Not(testing::Contains("drive.leakage_rate")));
  EXPECT_THAT(left, testing::Not(testing::Contains("friction_curve.coulomb")));
  EXPECT_THAT(left, testing::Contains("drive.valve_frequency"));
}

TEST(IdentifiedCase, RefusesAnInertiaThatLeavesNoAntenna) {
  const io::Case antenna = seventy_metres();
  auto found = estimate();
  found.inertia = found.motor_inertia + 0.5 * gear_train_inertia(antenna);
  EXPECT_THROW(with_identified(antenna, found), NumericalFailure);
}

// All commands sample the ensemble from one distribution: a designed ensemble has its first
// samples.
TEST(DrawnMembers, BeginWithThoseThatAControllerIsTunedOn) {
  const io::Case antenna = seventy_metres();
  std::vector<identification::DriveEstimate> random_samples(40, estimate());
  for (std::size_t i = 0; i < random_samples.size(); ++i) {
    random_samples[i].oil_stiffness *= 1.0 + 0.001 * static_cast<double>(i);
  }
  const design::Mission mission = mission_of(with_identified(antenna, estimate()));
  const auto distribution = design::PlantDistribution::of_records(mission, random_samples);
  const auto few = io::drawn_members(mission, distribution, 1, 2);
  const auto more = io::drawn_members(mission, distribution, 1, 5);
  ASSERT_EQ(few.size(), 2U);
  ASSERT_EQ(more.size(), 5U);
  EXPECT_EQ(more[4].name, "sample 5");
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].plant.drive.oil_stiffness, more[i].plant.drive.oil_stiffness);
  }
  EXPECT_NE(more[3].plant.drive.oil_stiffness, more[4].plant.drive.oil_stiffness);
}

}  // namespace
}  // namespace boresight::app
