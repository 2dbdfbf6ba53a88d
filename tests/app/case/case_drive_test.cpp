#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/identification/campaign/inertia_methods.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

// The 70-m case with one text of it replaced.
io::Case with(const std::string& old, const std::string& replacement) {
  return io::parse_case(EditedCase().replace(old, replacement).text(), "case.toml");
}

std::string refusal(const std::string& old, const std::string& replacement) {
  return refusal_of(EditedCase().replace(old, replacement).text());
}

const std::string stated_rate = "leakage_rate = { value = \"1.219 1/s\"";
const std::string by_flow =
    "leakage_pressure = { value = \"7 MPa\", uncertainty = \"3 %\" }\n"
    "leakage_flow = { value = \"1.1 L/min\", uncertainty = \"10 %\"";

TEST(CaseDrive, TurnsALeakageFlowIntoTheRate) {
  const io::Case antenna = with(stated_rate, by_flow);
  const io::OilEntry& oil = *antenna.oil;
  ASSERT_TRUE(oil.bulk_modulus);
  const double v1 = oil.volume_1.value;
  const double v2 = oil.volume_2.value;
  const auto rate = [](double beta, double one, double other, double flow, double pressure) {
    return beta * (1.0 / one + 1.0 / other) * flow / pressure;
  };
  const double beta = oil.bulk_modulus->value;
  const double flow = 1.1e-3 / 60.0;
  const io::Quantity& leakage = antenna.drive->leakage_rate;
  const double nominal = rate(beta, v1, v2, flow, 7e6);
  EXPECT_NEAR(leakage.value, nominal, 1e-12 * nominal);
  EXPECT_EQ(leakage.kind, io::Kind::rate_constant);
  EXPECT_EQ(leakage.key, "drive.leakage_flow");
  // One standard uncertainty of each of the five, small enough to be linear but for 10 %.
  const auto effect = [&](double moved) { return std::pow(moved - nominal, 2); };
  const double variance =
      effect(rate(beta + oil.bulk_modulus->standard_uncertainty, v1, v2, flow, 7e6)) +
      effect(rate(beta, v1 + oil.volume_1.standard_uncertainty, v2, flow, 7e6)) +
      effect(rate(beta, v1, v2 + oil.volume_2.standard_uncertainty, flow, 7e6)) +
      effect(1.1 * nominal) + effect(1.03 * nominal);
  EXPECT_NEAR(leakage.standard_uncertainty / std::sqrt(variance), 1.0, 0.01);
}

TEST(CaseDrive, NeedsADensityForLinesAlone) {
  EditedCase edited("dss14-64m");
  edited.replace_line("density = { value = \"850 kg/m3\"", "");
  const io::Case antenna = io::parse_case(edited.text(), "case.toml");
  EXPECT_FALSE(antenna.oil->density);
  EXPECT_EQ(oil_stiffness(antenna), oil_stiffness(io::read_case(case_path("dss14-64m"))));
  EXPECT_NO_THROW(identification::identify_inertia(make_evidence(antenna), {100, 1}));
  EXPECT_THAT(refusal_of(edited.text() + "\n[[oil.line]]\nname = \"one\"\nlength = \"13 m\"\n"),
              HasSubstr("oil.density: expected a density of the oil for the pressure waves"));
}

TEST(CaseDrive, TakesTheBulkModulusOfTheLinesForLeakage) {
  EditedCase edited;
  edited.replace("bulk_modulus = {", "# bulk_modulus = {").replace(stated_rate, by_flow);
  const io::Case antenna = io::parse_case(edited.text(), "case.toml");
  const double lines = (std::pow(2 * 13.11 * 46.3, 2) + std::pow(2 * 15.60 * 38.3, 2)) / 2 * 850.0;
  EXPECT_NEAR(antenna.drive->leakage_rate.value,
              with(stated_rate, by_flow).drive->leakage_rate.value * lines / 1229e6, 1e-9);
}

TEST(CaseDrive, TakesLeakageInOneWayOnly) {
  EXPECT_THAT(refusal(stated_rate, by_flow + "}\n" + stated_rate),
              HasSubstr("drive.leakage_rate: expected either leakage_rate, or leakage_flow with "
                        "leakage_pressure, found both"));
  EXPECT_THAT(refusal(stated_rate, "# " + stated_rate), HasSubstr("found neither"));
  EXPECT_THAT(refusal(stated_rate, "leakage_flow = { value = \"1.1 L/min\""),
              HasSubstr("drive.leakage_pressure: expected leakage_flow and leakage_pressure "
                        "together, found leakage_flow alone"));
  EXPECT_THAT(refusal(stated_rate,
                      "leakage_pressure = \"7 Pa\"\n"
                      "leakage_flow = { value = \"1.1 L/min\""),
              HasSubstr("drive.leakage_flow: expected a leakage rate of at most 1000 1/s"));
}

const std::string stated_stroke = "\nvalve_stroke = {";
const std::string damping = "valve_damping = {";
const std::string rated =
    "valve_rated_flow = { value = \"57 L/min\", uncertainty = \"10 %\" }\n"
    "valve_rated_pressure_drop = { value = \"7 MPa\", uncertainty = \"0.1 %\" }\n"
    "valve_damping = {";

TEST(CaseDrive, FindsTheStrokeByTheRatedFlow) {
  EditedCase edited;
  edited.replace(stated_stroke, "\n# valve_stroke = {").replace(damping, rated);
  const io::Case antenna = io::parse_case(edited.text(), "case.toml");
  const double driving =
      antenna.drive->supply_pressure.value - antenna.simulation->return_pressure.value;
  const double stroke = 57e-3 / 60.0 * std::sqrt(driving / 7e6) / (4.0 * 38.329e-6 / (2.0 * pi));
  const auto no_load_rate = io::rated_stroke(antenna);
  ASSERT_TRUE(no_load_rate);
  EXPECT_NEAR(no_load_rate->value, stroke, 1e-9 * stroke);
  EXPECT_EQ(antenna.simulation->valve_stroke.value, no_load_rate->value);
  EXPECT_FALSE(antenna.simulation->valve_stroke_stated);
  EXPECT_NEAR(no_load_rate->standard_uncertainty / stroke, 0.1, 0.005);
  // What is stated counts.
  const io::Case both = with(damping, rated);
  EXPECT_DOUBLE_EQ(both.simulation->valve_stroke.value, 150.0);
  EXPECT_TRUE(io::rated_stroke(both));
  EXPECT_DOUBLE_EQ(io::largest_demand(both), 150.0);
  // Without a simulation the flow is all there is, and without it the slew rate.
  io::Case linear = both;
  linear.simulation.reset();
  const auto alone = io::rated_stroke(linear);
  ASSERT_TRUE(alone);
  EXPECT_EQ(io::largest_demand(linear), alone->value);
  linear.drive->valve_rated_flow.reset();
  EXPECT_EQ(io::largest_demand(linear), linear.drive->slew_rate.value * gear_ratio(linear));
  EXPECT_THAT(refusal(damping, "valve_rated_flow = \"57 L/min\"\n" + damping),
              HasSubstr("drive.valve_rated_pressure_drop: expected valve_rated_flow and "
                        "valve_rated_pressure_drop together"));
}

TEST(CaseDrive, AssumesWhatSimulationLeavesOut) {
  EditedCase edited;
  edited.replace(stated_stroke, "\n# valve_stroke = {")
      .replace("preload_torque = {", "# preload_torque = {");
  const io::Case antenna = io::parse_case(edited.text(), "case.toml");
  EXPECT_NEAR(antenna.simulation->valve_stroke.value, 1.2 * 0.25 * pi / 180.0 * 28723.647, 1e-4);
  EXPECT_NEAR(antenna.simulation->preload_torque.value, 31.57, 0.01);
  for (const auto* key : {"simulation.valve_stroke", "simulation.preload_torque"}) {
    EXPECT_EQ(std::ranges::count_if(antenna.quantities,
                                    [&](const io::Quantity& one) {
                                      return one.key == key && one.basis == io::Basis::assumed;
                                    }),
              1)
        << key;
  }
}

TEST(CaseDrive, FindsByTheRestWhatFewEngineersKnow) {
  const io::Case antenna =
      io::parse_case(EditedCase()
                         .replace_line("viscous_friction = {", "")
                         .replace_line("tachometer_noise = { value = \"0.02 rad/s\"", "")
                         .replace_line("tachometer_frequency = {", "")
                         .replace_line("encoder_noise = {", "encoder_bits = 20")
                         .replace_line("valve_effort = {", "")
                         .text(),
                     "case.toml");
  const double motors_at_slew = antenna.drive->slew_rate.value * gear_ratio(antenna);
  EXPECT_EQ(antenna.drive->viscous_friction.value, io::tracking_friction(antenna));
  EXPECT_GT(antenna.drive->viscous_friction.value, 0.0);
  EXPECT_DOUBLE_EQ(antenna.sensors->tachometer_noise.value, 0.02 / 125.0 * motors_at_slew);
  EXPECT_DOUBLE_EQ(antenna.sensors->tachometer_frequency.value,
                   10.0 * antenna.structure->locked_rotor_frequency.value);
  EXPECT_DOUBLE_EQ(antenna.sensors->encoder_noise.value, 2.0 * pi / 1048576.0 / std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(antenna.goals->control_effort.value, 0.6 / 125.0 * motors_at_slew);
  const auto assumed = assumed_inputs(antenna);
  for (const auto* key :
       {"drive.viscous_friction", "sensors.tachometer_noise", "sensors.tachometer_frequency",
        "sensors.encoder_bits", "goals.valve_effort"}) {
    EXPECT_TRUE(std::ranges::any_of(assumed, [&](const io::Quantity& one) {
      return one.key == key;
    })) << key;
  }
  // A curve that falls there gives none.
  const io::Case falling =
      io::parse_case(EditedCase()
                         .replace_line("viscous_friction = {", "")
                         .replace_line("stribeck_rate = {", "stribeck_rate = \"2 rad/s\"")
                         .replace_line("breakaway = {", "breakaway = \"300 N.m\"")
                         .text(),
                     "case.toml");
  ASSERT_LT(io::tracking_slope(falling), 0.0);
  EXPECT_EQ(falling.drive->viscous_friction.value, 0.0);
  EXPECT_THAT(refusal_of(EditedCase().replace_line("encoder_noise = {", "").text()),
              HasSubstr("sensors.encoder_noise: expected either encoder_noise or encoder_bits"));
  EXPECT_THAT(refusal("encoder_noise = {", "encoder_bits = 20\nencoder_noise = {"),
              HasSubstr("sensors.encoder_bits: expected either"));
}

TEST(CaseDrive, RefusesAReturnAboveTheSupply) {
  EXPECT_THAT(refusal("\nslew_rate = {", "\nreturn_pressure = \"15 MPa\"\nslew_rate = {"),
              HasSubstr("drive.return_pressure: expected a pressure below supply_pressure"));
}

TEST(CaseGoals, CountsFlywheelsByWhatTheAntennaHas) {
  EXPECT_EQ(with("most_disks = 24\nstep = 3\n", "").matching->disks.back(), 48.0);
  EXPECT_EQ(with("most_disks = 24\nstep = 3\n", "").matching->disks.size(), 7U);
  EXPECT_EQ(with("[matching]\nmost_disks = 24\nstep = 3\n", "").matching->disks.size(), 7U);
  EXPECT_EQ(with("step = 3\n", "").matching->disks[1], 4.0);
}

}  // namespace
}  // namespace boresight::app
