// The words of physical checks that fail, and the report they stand in.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::string viscous = "viscous = { value = \"2.075 N.m.s/rad\"";

// What is said of a quantity by a check; empty if nothing is.
std::string said_of(const io::Case& antenna, const std::string& check, const std::string& id) {
  for (const Implausibility& one : audit_report(antenna).implausible) {
    if (one.check == check && one.id == id) return one.reasoning;
  }
  return "";
}

std::string said_of(const EditedCase& edited, const std::string& check, const std::string& id) {
  return said_of(io::parse_case(edited.text(), "case.toml"), check, id);
}

TEST(AuditReport, WritesAReportOfReadableWidthWithASummary) {
  const std::string text =
      to_text(document_of(audit_report(io::read_case(case_path("dss14-70m")))));
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_LE(end - begin, 108U) << text.substr(begin, end - begin);
    begin = end + 1;
  }
  EXPECT_THAT(text, HasSubstr("Physically implausible"));
  EXPECT_THAT(text, HasSubstr("Remarks by the case's writer"));
  EXPECT_THAT(text.substr(text.find("Summary")), HasSubstr("load_inertia.antenna"));
}

TEST(AuditReport, NamesEveryCheckThatFails) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const AuditReport report = audit_report(antenna);
  const auto found = io::audit(antenna);
  EXPECT_EQ(report.checked, found.checked);
  EXPECT_EQ(report.findings.size(), found.findings.size());
  EXPECT_EQ(report.implausible.size(),
            std::ranges::count(found.physics.checks, false, &design::PhysicalCheck::holds));
  for (const Implausibility& one : report.implausible) {
    EXPECT_THAT(one.reasoning, testing::EndsWith(".")) << one.check;
  }
  // Printed in sections III.D and V, but one coincidence.
  EXPECT_THAT(report.implausible,
              Contains(testing::Field(&Implausibility::check, "coincidence")).Times(1));
}

TEST(CheckSentences, SayWhatFrictionTakesOfTheSupply) {
  const std::string check = "friction against the supply";
  EXPECT_THAT(said_of(EditedCase(), check, "friction_curve.viscous"),
              AllOf(HasSubstr("The supply cannot slew the antenna against its friction"),
                    HasSubstr("'0.25 deg/s'"), HasSubstr("'2.075 N.m.s/rad' (assumed)"),
                    HasSubstr("'2000 psi' (assumed)"), HasSubstr("the slew rate is out of reach")));
  EXPECT_THAT(said_of(EditedCase().replace(viscous, "viscous = { value = \"0.6 N.m.s/rad\""), check,
                      "friction_curve.viscous"),
              AllOf(HasSubstr("Friction takes 47 % of the supply's torque"),
                    HasSubstr("wind and acceleration"), Not(HasSubstr("cannot"))));
  EXPECT_THAT(said_of(EditedCase().replace("breakaway = { value = \"16.83 N.m\"",
                                           "breakaway = { value = \"400 N.m\""),
                      check, "friction_curve.breakaway"),
              AllOf(HasSubstr("The supply cannot move the antenna against its friction"),
                    HasSubstr("'400 N.m'"), Not(HasSubstr("slew"))));
}

TEST(CheckSentences, SayWhatTheFrictionTestsContradict) {
  const auto edited = EditedCase().replace("saturating = { value = \"63.29 N.m\"",
                                           "saturating = { value = \"0 N.m\"");
  EXPECT_THAT(said_of(edited, "friction tests", "friction_tests.constant_speed_coulomb"),
              AllOf(HasSubstr("has the intercept '69.49 N.m'"), HasSubstr("10.3 to 18.2 N.m")));
  EXPECT_THAT(said_of(edited, "friction tests", "friction_tests.constant_speed_slope"),
              AllOf(HasSubstr("has the slope '5.21 N.m/rpm'"), HasSubstr("2.08 N.m.s/rad")));
}

TEST(CheckSentences, SayWhatTheValveLetsTheMotorsDo) {
  EXPECT_THAT(said_of(EditedCase().replace(viscous, "viscous = { value = \"0.20 N.m.s/rad\""),
                      "valve stroke", "drive.slew_rate"),
              AllOf(HasSubstr("friction and offset"),
                    HasSubstr("150 rad/s without load by simulation.valve_stroke '150 rad/s'"),
                    HasSubstr("out of reach")));
  const auto rated = EditedCase().replace("valve_damping = {",
                                          "valve_rated_flow = \"57 L/min\"\n"
                                          "valve_rated_pressure_drop = \"7 MPa\"\n"
                                          "valve_damping = {");
  EXPECT_THAT(said_of(rated, "valve stroke", "drive.slew_rate"),
              HasSubstr("by its rated flow of '57 L/min' at '7 MPa'"));
  EXPECT_THAT(said_of(rated, "valve stroke", "simulation.valve_stroke"),
              AllOf(HasSubstr("'150 rad/s'"), HasSubstr("'57 L/min'")));
  const std::string supply = "supply_pressure = { value = \"2000 psi\"";
  EXPECT_THAT(said_of(EditedCase().replace(supply, "return_pressure = \"600 psi\"\n" + supply),
                      "return pressure", "simulation.return_pressure"),
              AllOf(HasSubstr("'600 psi' by drive.return_pressure"), HasSubstr("'60 psi'"),
                    HasSubstr("one of the two is wrong")));
}

TEST(CheckSentences, SayWhatTheResonanceIsExpectedToBe) {
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  EXPECT_THAT(said_of(antenna, "resonance expected", "resonance.frequency"),
              AllOf(HasSubstr("0.848 Hz of the case's flexible antenna"),
                    HasSubstr("A rigid antenna would have 0.856 Hz"),
                    HasSubstr("raising the bulk modulus from")));
  antenna = io::parse_case(
      EditedCase().replace("[resonance]\n", "[resonance]\ndamping_ratio = \"0.3\"\n").text(),
      "case.toml");
  const auto of_damping = [&](double measured) {
    antenna.resonance->damping->value = measured;
    return said_of(antenna, "resonance damping", "resonance.damping_ratio");
  };
  EXPECT_THAT(of_damping(0.07),
              AllOf(HasSubstr("damping ratio 0.152"),
                    HasSubstr("Measured is 0.07, more than a factor of 2 below: leakage or "
                              "friction is smaller than stated."),
                    Not(HasSubstr("dry friction")), Not(HasSubstr("elastic energy"))));
  EXPECT_THAT(of_damping(0.31),
              HasSubstr("larger than stated, or a nonlinear effect damped that test"));
  antenna.structure->locked_rotor_frequency.value = 0.2;
  EXPECT_THAT(of_damping(0.3), AllOf(HasSubstr("The hydraulic mode of the case has"),
                                     HasSubstr("% of that mode's elastic energy is in the oil")));
  antenna.resonance->of_oil = true;
  EXPECT_THAT(of_damping(1.0), HasSubstr("The mode with most energy in the oil of the case has"));
}

TEST(CheckSentences, SayWhatASoftPartUnderTheWindMeans) {
  const io::Case antenna = io::parse_case(
      EditedCase()
          .replace("inertia_fraction = { value = \"0.62\"", "inertia_fraction = { value = \"0.18\"")
          .text(),
      "case.toml");
  EXPECT_THAT(said_of(antenna, "structural fractions", "structure.mode[0].wind_fraction"),
              AllOf(HasSubstr("a wind_fraction of 0.75 on an inertia fraction of 0.18 and a "
                              "beam_weight of 0.8 on an inertia fraction of 0.18"),
                    HasSubstr("mean wind of 10 m/s")));
  for (const Implausibility& one : audit_report(antenna).implausible) {
    if (one.check != "structural fractions") continue;
    EXPECT_EQ(one.numbers.at(0).unit, "mdeg");
    EXPECT_NEAR(one.numbers[0].value,
                std::abs(static_bending(make_problem(antenna))) * 180e3 / std::numbers::pi, 1e-9);
  }
}

TEST(CheckSentences, SayWhatWouldMakeTheGearTrainAsStiffAsStated) {
  const auto said = [](const std::string& stiffness) {
    return said_of(
        EditedCase().replace("\ngear_damping_ratio =",
                             "\ngear_stiffness = \"" + stiffness + "\"\ngear_damping_ratio ="),
        "gear stiffness", "structure.gear_stiffness");
  };
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const double axis =
      make_plant(antenna).structure.gear_stiffness * std::pow(gear_ratio(antenna), 2);
  EXPECT_THAT(said(fmt::format("{:.17g} N.m/rad", 2.0 * axis)),
              AllOf(HasSubstr("is 2 times as soft"),
                    HasSubstr("The mode of largest inertia (structure.mode[0].frequency) at"),
                    HasSubstr("instead of 2.4 Hz would reproduce the stated value.")));
  EXPECT_THAT(said(fmt::format("{:.17g} N.m/rad", 0.4 * axis)),
              HasSubstr("No frequency of the mode of largest inertia"));
}

TEST(CheckSentences, SayWhatIsOutOfSize) {
  EXPECT_THAT(said_of(EditedCase().replace("2.41667e8 lbf.ft.s2", "2.41667e8 lbm.ft2"),
                      "inertia against the dish", "antenna.inertia"),
              AllOf(HasSubstr("'2.41667e8 lbm.ft2'"), HasSubstr("0.0061 kg/m3"),
                    HasSubstr("Sommerville"), HasSubstr("or the inertia is that of a part")));
  EXPECT_THAT(said_of(EditedCase().replace("{ value = \"70 m\"", "{ value = \"35 m\""),
                      "inertia against the dish", "antenna.inertia"),
              HasSubstr("or the diameter is a radius"));
  EXPECT_THAT(
      said_of(
          io::parse_case(
              EditedCase()
                      .replace("\nlocked_rotor_frequency = { value = \"2.0 Hz\"",
                               "\nlocked_rotor_frequency = { value = \"2.0 Hz\", "
                               "uncertainty = \"10 %\"")
                      .text() +
                  "\n[ensemble]\nstructure_frequency = { lower = \"0.95\", upper = \"1.05\" }\n",
              "case.toml"),
          "ensemble range", "ensemble.structure_frequency"),
      AllOf(HasSubstr("ensemble.structure_frequency of 0.95 to 1.05"),
            HasSubstr("structure.locked_rotor_frequency leaves 0.827 to 1.17")));
}

}  // namespace
}  // namespace boresight::app
