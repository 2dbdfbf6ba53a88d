#include <cmath>

#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/loaded_drive.hpp>
#include <boresight/io/case/plant_numbers.hpp>

namespace boresight::io {
namespace {

TEST(LoadedDrive, TakesUpItsWholeTorqueAtTheAttainableRate) {
  const Case stated = read_case(case_path("dss14-70m"));
  const LoadedDrive drive(stated, oil_stiffness(stated), supply_torque(stated));
  const double stroke = largest_demand(stated);
  const double rate = drive.attainable_rate(stroke);
  EXPECT_GT(rate, 0.0);
  EXPECT_LT(rate, stroke);
  EXPECT_NEAR(drive.excess(rate, stroke), 0.0, 1e-6 * drive.available());
  EXPECT_LT(drive.attainable_rate(0.9 * stroke), rate);
}

TEST(LoadedDrive, HoldsFrictionAndTheOffsetThatResists) {
  Case stated = read_case(case_path("dss14-70m"));
  const double rate = 2.0;
  const double friction = plant::friction_torque(friction_curve(stated), rate);
  const auto load = [&] {
    return LoadedDrive(stated, oil_stiffness(stated), supply_torque(stated)).load(rate);
  };
  EXPECT_NEAR(load(), friction + std::abs(stated.simulation->offset_torque.value), 1e-12);
  stated.simulation->offset_torque.value *= -1.0;
  EXPECT_NEAR(load(), friction + std::abs(stated.simulation->offset_torque.value), 1e-12);
}

TEST(LoadedDrive, MarginIsOverWhatSlewingTakes) {
  Case stated = read_case(case_path("dss14-70m"));
  const auto own = slew_rate_margin(stated);
  ASSERT_TRUE(own.has_value());
  stated.drive.slew_rate.value *= 2.0;
  EXPECT_NEAR(*slew_rate_margin(stated) / *own, 0.5, 1e-12);
  stated.simulation.reset();
  EXPECT_FALSE(slew_rate_margin(stated).has_value());
}

}  // namespace
}  // namespace boresight::io
