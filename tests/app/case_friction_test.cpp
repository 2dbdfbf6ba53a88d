#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edited_case.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/identify/first_tests.hpp>
#include <boresight/app/io/drive_numbers.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

// The 70-m case without its curve, and with tests behind it.
std::string tested(const std::string& tests) {
  EditedCase edited;
  for (const char* key : {"coulomb = {", "breakaway = {", "stribeck_rate = {", "saturating = {",
                          "saturating_rate = {", "viscous = {"}) {
    edited.replace_line(key, "");
  }
  return edited.text() + tests;
}

std::string test(const std::string& rate, const std::string& what) {
  return fmt::format("\n[[friction_curve.test]]\nrate = \"{}\"\n{}\n", rate, what);
}

TEST(CaseFriction, GoesThroughTestsAtSteadyRates) {
  // A line of 60 N.m and 0.1 N.m.s/rad, and 90 N.m at rest.
  const Case reference = read_case(case_path("dss14-70m"));
  const double ratio = gear_ratio(reference);
  std::string tests = test("0 deg/s", "torque = { value = \"90 N.m\", uncertainty = \"5 %\" }");
  for (const double motor_rate : {20.0, 40.0}) {
    tests += test(fmt::format("{:.12g} rad/s", motor_rate / ratio),
                  fmt::format("torque = {{ value = \"{} N.m\", uncertainty = \"5 %\" }}",
                              60.0 + 0.1 * motor_rate));
  }
  const Case antenna = parse_case(tested(tests), "case.toml");
  const FrictionCurveEntry& curve = antenna.friction_curve;
  // Three tests and three numbers: it goes through all of them.
  EXPECT_NEAR(curve.breakaway.value, 90.0, 1e-9);
  EXPECT_NEAR(plant::friction_torque(friction_curve(antenna), 20.0), 62.0, 1e-9);
  EXPECT_NEAR(plant::friction_torque(friction_curve(antenna), 40.0), 64.0, 1e-9);
  EXPECT_NEAR(curve.stribeck_rate.value, 20.0 / 3.0, 1e-9);
  EXPECT_EQ(curve.saturating.value, 0.0);
  EXPECT_NEAR(relative_uncertainty(curve.coulomb), 0.05, 1e-9);
  EXPECT_EQ(curve.coulomb.kind, Kind::torque);
  EXPECT_EQ(curve.viscous.kind, Kind::viscous_friction);
}

TEST(CaseFriction, CountsTestsAsMeasuredAndKeepsWhatTheCurveLeavesOfThem) {
  std::string tests = test("0 deg/s", "torque = \"90 N.m\"");
  for (const auto* two : {"0.005 deg/s|70 N.m", "0.05 deg/s|60 N.m", "0.2 deg/s|75 N.m"}) {
    const std::string both = two;
    const std::size_t bar = both.find('|');
    tests += test(both.substr(0, bar), "torque = \"" + both.substr(bar + 1) + "\"");
  }
  const Case antenna = parse_case(tested(tests), "case.toml");
  const FrictionCurveEntry& curve = antenna.friction_curve;
  for (const Quantity* quantity : {&curve.coulomb, &curve.breakaway, &curve.stribeck_rate}) {
    EXPECT_EQ(quantity->basis, Basis::measured) << quantity->key;
  }
  ASSERT_EQ(curve.tests.size(), 4U);
  EXPECT_NEAR(curve.tests[0].residual, 90.0 - curve.breakaway.value, 1e-9);
  EXPECT_NEAR(curve.tests[3].residual,
              75.0 - plant::friction_torque(friction_curve(antenna), curve.tests[3].rate), 1e-9);
  EXPECT_TRUE(read_case(case_path("dss14-70m")).friction_curve.tests.empty());
  EXPECT_THAT(first_tests(antenna), Contains(HasSubstr("which the case has as measured")));
  EXPECT_THAT(to_text(document_of(describe_plant(antenna))),
              AllOf(HasSubstr("Friction curve through 4 tests at steady rates: Coulomb "),
                    HasSubstr("test less curve N.m")));

  const Case guessed =
      parse_case(tested(test("0.1 deg/s", "torque = { value = \"60 N.m\", basis = \"assumed\" }")),
                 "case.toml");
  EXPECT_EQ(guessed.friction_curve.coulomb.basis, Basis::assumed);
  const Case one = parse_case(tested(test("0.1 deg/s", "torque = \"60 N.m\"")), "case.toml");
  EXPECT_EQ(one.friction_curve.coulomb.basis, Basis::measured);
  EXPECT_EQ(one.friction_curve.stribeck_rate.basis, Basis::inferred) << "one test shows none";
}

TEST(CaseFriction, TakesPressuresOverTheMotors) {
  const Case by_torque = parse_case(tested(test("0.1 deg/s", "torque = \"60 N.m\"")), "case.toml");
  const double pressure = 60.0 / plant::torque_per_pressure(hydraulic_drive(by_torque));
  const Case by_pressure = parse_case(
      tested(test("0.1 deg/s", fmt::format("pressure = \"{:.12g} Pa\"", pressure))), "case.toml");
  EXPECT_NEAR(by_pressure.friction_curve.coulomb.value, 60.0, 1e-9);
}

TEST(CaseFriction, RefusesTestsThatSayTooLittleOrTwice) {
  EXPECT_THAT(refusal_of(EditedCase().text() + test("0.1 deg/s", "torque = \"60 N.m\"")),
              HasSubstr("friction_curve.coulomb: expected either coulomb or tests, found both"));
  EXPECT_THAT(refusal_of(tested("")), HasSubstr("friction_curve.coulomb"));
  EXPECT_THAT(refusal_of(tested(test("0.1 deg/s", ""))),
              HasSubstr("friction_curve.test[0].torque: expected either torque or pressure, found "
                        "neither"));
  EXPECT_THAT(refusal_of(tested(test("0.1 deg/s", "torque = \"60 N.m\"\npressure = \"1 MPa\""))),
              HasSubstr("found both"));
  EXPECT_THAT(refusal_of(tested(test("0 deg/s", "torque = \"60 N.m\""))),
              HasSubstr("expected a test at a rate above 0, found only one at rest"));
  EXPECT_THAT(refusal_of(tested(test("0.1 deg/s", "torque = \"60 N.m\"") +
                                test("0.1 deg/s", "torque = \"61 N.m\""))),
              HasSubstr("friction_curve.test[1].rate: expected one test a rate"));
}

}  // namespace
}  // namespace boresight::app
