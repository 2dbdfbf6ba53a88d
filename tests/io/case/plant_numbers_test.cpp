#include <cmath>

#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>

namespace boresight::io {
namespace {

Case reference() {
  return read_case(case_path("dss14-70m"));
}

TEST(PlantNumbers, MotorsAndLoadAreEqualAtTheDisksOfUnitRatio) {
  const Case stated = reference();
  const double load = gear_train_inertia(stated) + antenna_inertia(stated);
  const auto disks = disks_at_unit_ratio(stated, load);
  ASSERT_TRUE(disks.has_value());
  EXPECT_NEAR(motor_inertia(stated, *disks), load, 1e-12);
  EXPECT_FALSE(disks_at_unit_ratio(stated, 0.0).has_value());
}

TEST(PlantNumbers, AlternativeOnTheSameSpringsKeepsThem) {
  const Case stated = reference();
  AntennaAlternative other = stated.antenna->alternatives.front();
  other.keeps_springs = true;
  const auto own = make_plant(stated).structure;
  const auto kept = make_plant(stated, changes_of(stated, other)).structure;
  EXPECT_NEAR(plant::antenna_inertia(kept), antenna_inertia(stated, other), 1e-12);
  EXPECT_NEAR(kept.gear_stiffness / own.gear_stiffness, 1.0, 1e-12);
  other.keeps_springs = false;
  const auto moved = make_plant(stated, changes_of(stated, other)).structure;
  EXPECT_NEAR(moved.gear_stiffness / own.gear_stiffness,
              antenna_inertia(stated, other) / antenna_inertia(stated), 1e-12);
}

TEST(PlantNumbers, BulkModulusMovesALeakageThatIsAFlow) {
  Case stated = reference();
  const double own = stated.drive->leakage_rate.value;
  EXPECT_EQ(make_plant(stated, bulk_modulus_times(stated, 1.5)).drive.leakage_rate, own);
  stated.drive->leakage_by_flow = true;
  const auto drive = make_plant(stated, bulk_modulus_times(stated, 1.5)).drive;
  EXPECT_EQ(drive.leakage_rate, 1.5 * own);
  EXPECT_EQ(drive.oil_stiffness, 1.5 * oil_stiffness(stated));
}

TEST(PlantNumbers, LinesHaveTheirMeanBulkModulus) {
  Case stated = reference();
  stated.oil->bulk_modulus.reset();
  double mean = 0.0;
  for (const auto& line : stated.oil->lines) {
    mean += std::pow(2.0 * line.length.value * line.slosh_frequency.value, 2) *
            stated.oil->density->value / static_cast<double>(stated.oil->lines.size());
  }
  EXPECT_NEAR(bulk_modulus(stated) / mean, 1.0, 1e-12);
}

TEST(PlantNumbers, LargestFrictionIsThatAboutTheTrackingRateOrTheLinearPlants) {
  Case stated = reference();
  EXPECT_EQ(largest_viscous_friction(stated), tracking_friction(stated));
  stated.drive->viscous_friction.value = 1e3;
  EXPECT_EQ(largest_viscous_friction(stated), 1e3);
}

}  // namespace
}  // namespace boresight::io
