// What of valve, pressures and recorder an audit holds against the slew rate and one another.
#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::io {
namespace {

using testing::IsEmpty;

const std::string viscous = "viscous = { value = \"2.075 N.m.s/rad\"";
const std::string supply_pressure = "supply_pressure = { value = \"2000 psi\"";

// The 70-m case with a return pressure for records beside that of its simulation, 60 psi.
Checks return_pressures(const std::string& recorded) {
  EditedCase edited;
  edited.replace(supply_pressure, "return_pressure = " + recorded + "\n" + supply_pressure);
  return failed(edited, "return_pressure");
}

TEST(ReturnPressures, OfRecordsAndSimulationAreOne) {
  EXPECT_THAT(failed(EditedCase(), "return_pressure"), IsEmpty());
  EXPECT_THAT(return_pressures("\"62 psi\""), IsEmpty());
  EXPECT_THAT(return_pressures("{ value = \"80 psi\", uncertainty = \"15 psi\" }"), IsEmpty());
  const auto found = return_pressures("\"600 psi\"");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "simulation.return_pressure");
  const Case campaign = read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/campaign.toml");
  EXPECT_THAT(failed(campaign, "return_pressure"), IsEmpty());
}

const std::string slower = "viscous = { value = \"0.20 N.m.s/rad\"";

TEST(ValveStroke, GoesAgainstFrictionAndOffset) {
  // 150 rad/s without load: 125 rad/s against the 99 N.m of friction and 6 N.m of offset are not
  // within reach.
  EditedCase edited;
  edited.replace(viscous, slower);
  const auto found = failed(edited, "slew_rate_under_load");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "drive.slew_rate");
  EXPECT_EQ(found[0].explanation, "friction_and_offset");
  EXPECT_THAT(failed(edited, "slew_rate_without_load"), IsEmpty());
  ASSERT_EQ(found[0].numbers.size(), 5U);
  EXPECT_NEAR(found[0].numbers[1].value, 150.0, 1e-9);
  const Case antenna = parse_case(edited.text(), "case.toml");
  const double slewing = 0.25 * std::numbers::pi / 180.0 * gear_ratio(antenna);
  EXPECT_NEAR(found[0].numbers[2].value, 10.33 + 63.29 + 0.2 * slewing + 5.65, 1e-3);
  EXPECT_NEAR(found[0].numbers[3].value, supply_torque(antenna) * (1.0 - 60.0 / 2000.0), 1e-9);
  // Studies find the same, but for the valve's overlap.
  const double studies =
      design::attainable_rate(plant::nonlinear_antenna(antenna_of(antenna)), slewing);
  EXPECT_LT(found[0].numbers[4].value, slewing);
  EXPECT_GE(found[0].numbers[4].value, studies);
  EXPECT_NEAR(found[0].numbers[4].value, studies, 0.03 * slewing);
}

TEST(ValveStroke, IsEnoughWhereTheValveIsLarger) {
  EditedCase edited;
  edited.replace(viscous, slower);
  edited.replace("valve_stroke = { value = \"150 rad/s\"",
                 "valve_stroke = { value = \"170 rad/s\"");
  EXPECT_THAT(failed(edited, "slew_rate_under_load"), IsEmpty());
  // That no valve does is said of the friction.
  EXPECT_THAT(failed(EditedCase(), "slew_rate_under_load"), IsEmpty());
}

// The 70-m case with a rated flow of the valve, at 7 MPa over both edges.
EditedCase of_rated_flow(const std::string& flow) {
  return EditedCase().replace("valve_damping = {", "valve_rated_flow = \"" + flow +
                                                       "\"\nvalve_rated_pressure_drop = "
                                                       "\"7 MPa\"\nvalve_damping = {");
}

TEST(ValveStroke, OfTheRatedFlowIsComparedToo) {
  // 150 rad/s are stated, the slew rate of 0.25 deg/s takes 125 rad/s.
  EXPECT_THAT(failed(of_rated_flow("160 L/min"), "slew_rate_without_load"), IsEmpty());
  EXPECT_THAT(failed(of_rated_flow("160 L/min"), "valve_strokes"), IsEmpty());
  const auto found = failed(of_rated_flow("57 L/min"), "slew_rate_without_load");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "drive.slew_rate");
  ASSERT_EQ(found[0].numbers.size(), 2U);
  EXPECT_NEAR(found[0].numbers[0].value,
              0.25 * std::numbers::pi / 180.0 * gear_ratio(read_case(case_path("dss14-70m"))),
              1e-9);
  const double psi = 4.4482216152605 / (0.0254 * 0.0254);
  const double rated = 57e-3 / 60.0 * std::sqrt((2000.0 - 60.0) * psi / 7e6) /
                       (4.0 * 38.329e-6 / (2.0 * std::numbers::pi));
  EXPECT_NEAR(found[0].numbers[1].value, rated, 1e-9 * rated);
  ASSERT_EQ(found[0].entries.size(), 2U);
  EXPECT_EQ(found[0].entries[0].text, "57 L/min");
  EXPECT_EQ(found[0].entries[1].text, "7 MPa");
  const auto apart = failed(of_rated_flow("57 L/min"), "valve_strokes");
  ASSERT_EQ(apart.size(), 1U);
  EXPECT_EQ(apart[0].quantity, "simulation.valve_stroke");
  EXPECT_EQ(apart[0].entries.at(0).text, "150 rad/s");
}

TEST(RecorderLimit, IsReachedByTheTachometerAtSlewRate) {
  Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "recorder_limit");
  ASSERT_EQ(found.size(), 1U);
  const auto& volts = found[0].number("voltage at slew rate");
  const double slewing = 0.25 * std::numbers::pi / 180.0 * gear_ratio(antenna);
  EXPECT_NEAR(volts.value, slewing * 60.0 / (2.0 * std::numbers::pi) * 23.0 / 130.0 * 157.0 / 600.0,
              1e-9);
  EXPECT_EQ(volts.upper, antenna.tachometer->recorder_limit.value);
  antenna.tachometer->recorder_limit.value = 1.01 * volts.value;
  EXPECT_THAT(failed(antenna, "recorder_limit"), IsEmpty());
}

}  // namespace
}  // namespace boresight::io
