#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/gear_train.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double steel = 7832.0;  // kg/m3

TEST(DiskInertia, IsTheIntegralOfMassTimesSquaredRadius) {
  const double radius = 0.37, length = 0.21;
  // 2 pi rho H r^3 is a cubic: Simpson's rule is exact.
  const auto ring = [&](double r) { return two_pi * steel * length * r * r * r; };
  const double integral = radius / 6.0 * (ring(0.0) + 4.0 * ring(0.5 * radius) + ring(radius));
  EXPECT_NEAR(disk_inertia(radius, length, steel), integral, 1e-12 * integral);
}

TEST(DiskInertia, GivesTheRowsOfTable1) {
  struct Row {
    double radius_cm, length_cm, inertia, tolerance;
  };
  // Those that follow from the printed dimensions: J11, J12, J32, J41, J42.
  for (const auto& [radius, length, inertia, tolerance] :
       {Row{3.81, 38.1, 0.0099, 5e-5}, Row{22.42, 5.08, 1.5777, 2e-3},
        Row{36.4998, 13.97, 30.525, 0.03}, Row{26.162, 68.58, 39.49798, 0.03},
        Row{49.53, 20.955, 155.0439, 0.15}}) {
    EXPECT_NEAR(disk_inertia(0.01 * radius, 0.01 * length, steel), inertia, tolerance)
        << radius << " cm";
  }
}

TEST(DiskInertia, RefusesWhatNoDiskHas) {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(reference::Call([&] { disk_inertia(bad, 1.0, steel); }),
                ThrowsMessage<InvalidInput>(HasSubstr("disk_inertia: expected positive")));
    EXPECT_THROW(disk_inertia(1.0, bad, steel), InvalidInput);
    EXPECT_THROW(disk_inertia(1.0, 1.0, bad), InvalidInput);
  }
}

TEST(GearRatio, IsTheProductOfTheStages) {
  const auto stages = reference::gear_stages();
  EXPECT_EQ(gear_ratio(stages, 0), 1.0);
  EXPECT_DOUBLE_EQ(gear_ratio(stages, 1), 6.7);
  EXPECT_DOUBLE_EQ(gear_ratio(stages, 2), 134.0 * 101.0 / (20.0 * 21.0));
  EXPECT_NEAR(gear_ratio(stages), 28723.647, 1e-3);
  EXPECT_NEAR(std::pow(gear_ratio(stages), 2), 8.250479e8, 100.0);
  EXPECT_NEAR(reference::mdeg * gear_ratio(stages), 0.50132, 1e-5);  // motor rad per mdeg
}

TEST(GearRatio, NamesTheStageItRefuses) {
  EXPECT_THAT(reference::Call([] {
                gear_ratio({{10, 1}, {10, 0}});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("stage 2, found 10/0")));
  EXPECT_THROW(gear_ratio({{-10, 1}}), InvalidInput);
  EXPECT_THROW(gear_ratio({{std::nan(""), 1}}), InvalidInput);
  EXPECT_THAT(reference::Call([] {
                gear_ratio({{10, 1}}, 2);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("at most 1 stages, found 2")));
}

TEST(ReflectedInertia, GivesTheRowsOfTable3) {
  const auto stages = reference::gear_stages();
  const double lbf[] = {1.1710, 3.8779, 23.0816, 143.4886};
  const double lbf_row[] = {0.10434, 0.01494, 0.00368, 0.00154};
  const double si[] = {1.5876, 5.2576, 31.294, 194.5418};
  const double si_row[] = {0.14146, 0.02025, 0.004989, 0.002088};
  for (std::size_t i = 0; i < 4; ++i) {
    const double ratio = gear_ratio(stages, i + 1);
    EXPECT_NEAR(reflected_inertia(lbf[i], ratio, 4.0), lbf_row[i], 1e-5) << "row " << i + 1;
    EXPECT_NEAR(reflected_inertia(si[i], ratio, 4.0), si_row[i], 1e-5) << "row " << i + 1;
  }
  EXPECT_NEAR(reflected_inertia(0.0089, 1.0, 4.0), 0.03570, 2e-4);
  // Row 6 of Table 2, the 64-m antenna.
  EXPECT_NEAR(reflected_inertia(1e8, gear_ratio(stages)), 0.12120, 1e-5);
  EXPECT_NEAR(reference::antenna_inertia(), 0.39714, 1e-5);
}

TEST(ReflectedInertia, KeepsTheKineticEnergy) {
  const double motor_rate = 17.0, ratio = 6.7, inertia = 1.6;
  const double of_gears = 4.0 * 0.5 * inertia * std::pow(motor_rate / ratio, 2);
  EXPECT_NEAR(0.5 * reflected_inertia(inertia, ratio, 4.0) * motor_rate * motor_rate, of_gears,
              1e-12 * of_gears);
}

TEST(MotorToLoadRatio, GivesThePublishedRatios) {
  EXPECT_NEAR(motor_to_load_ratio(4 * 0.17712, 4 * 0.17712 + 0.3815), 1.8568, 5e-4);
  EXPECT_NEAR(motor_to_load_ratio(4 * 0.22177, 4 * 0.22177 + 0.42282), 2.09799, 5e-5);
}

TEST(MotorToLoadRatio, IsTheInverseOfLoadToMotor) {
  for (const double inertia : {0.5, 1.2, 1.2029, 1.45, 30.0}) {
    const double motor = 1.2028;
    EXPECT_NEAR(motor_to_load_ratio(motor, inertia) * load_to_motor_ratio(motor, inertia), 1.0,
                1e-12);
  }
  EXPECT_TRUE(std::isinf(motor_to_load_ratio(1.2, 1.2)));
  EXPECT_EQ(load_to_motor_ratio(1.2, 1.2), 0.0);
  EXPECT_LT(motor_to_load_ratio(1.2, 1.1), 0.0);
}

}  // namespace
}  // namespace boresight::plant
