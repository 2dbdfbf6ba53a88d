#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/identify/first_tests.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/friction_leeway.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

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
  const io::Case reference = io::read_case(case_path("dss14-70m"));
  const double ratio = io::gear_ratio(reference);
  std::string tests = test("0 deg/s", "torque = { value = \"90 N.m\", uncertainty = \"5 %\" }");
  for (const double motor_rate : {20.0, 40.0}) {
    tests += test(fmt::format("{:.12g} rad/s", motor_rate / ratio),
                  fmt::format("torque = {{ value = \"{} N.m\", uncertainty = \"5 %\" }}",
                              60.0 + 0.1 * motor_rate));
  }
  const io::Case antenna = io::parse_case(tested(tests), "case.toml");
  const io::FrictionCurveEntry& curve = *antenna.friction_curve;
  // Three tests and three numbers: it goes through all of them.
  EXPECT_NEAR(curve.breakaway.value, 90.0, 1e-9);
  EXPECT_NEAR(plant::friction_torque(io::friction_curve(antenna), 20.0), 62.0, 1e-9);
  EXPECT_NEAR(plant::friction_torque(io::friction_curve(antenna), 40.0), 64.0, 1e-9);
  EXPECT_NEAR(curve.stribeck_rate.value, 20.0 / 3.0, 1e-9);
  EXPECT_EQ(curve.saturating.value, 0.0);
  EXPECT_NEAR(io::relative_uncertainty(curve.coulomb), 0.05, 1e-9);
  EXPECT_EQ(curve.coulomb.kind, io::Kind::torque);
  EXPECT_EQ(curve.viscous.kind, io::Kind::viscous_friction);
}

TEST(CaseFriction, CountsTestsAsMeasuredAndKeepsWhatTheCurveLeavesOfThem) {
  std::string tests = test("0 deg/s", "torque = \"90 N.m\"");
  for (const auto* two : {"0.005 deg/s|70 N.m", "0.05 deg/s|60 N.m", "0.2 deg/s|75 N.m"}) {
    const std::string both = two;
    const std::size_t bar = both.find('|');
    tests += test(both.substr(0, bar), "torque = \"" + both.substr(bar + 1) + "\"");
  }
  const io::Case antenna = io::parse_case(tested(tests), "case.toml");
  const io::FrictionCurveEntry& curve = *antenna.friction_curve;
  for (const io::Quantity* quantity : {&curve.coulomb, &curve.breakaway, &curve.stribeck_rate}) {
    EXPECT_EQ(quantity->basis, io::Basis::measured) << quantity->key;
  }
  ASSERT_EQ(curve.tests.size(), 4U);
  EXPECT_NEAR(curve.tests[0].residual, 90.0 - curve.breakaway.value, 1e-9);
  EXPECT_NEAR(curve.tests[3].residual,
              75.0 - plant::friction_torque(io::friction_curve(antenna), curve.tests[3].rate),
              1e-9);
  EXPECT_TRUE(io::read_case(case_path("dss14-70m")).friction_curve->tests.empty());
  EXPECT_THAT(first_tests(antenna), Contains(HasSubstr("they check the measured friction curve")));
  EXPECT_THAT(to_text(document_of(describe_plant(antenna))),
              AllOf(HasSubstr("Friction curve through 4 tests at steady rates: Coulomb "),
                    HasSubstr("test - curve N.m")));

  const io::Case guessed = io::parse_case(
      tested(test("0.1 deg/s", "torque = { value = \"60 N.m\", basis = \"assumed\" }")),
      "case.toml");
  EXPECT_EQ(guessed.friction_curve->coulomb.basis, io::Basis::assumed);
  const io::Case one =
      io::parse_case(tested(test("0.1 deg/s", "torque = \"60 N.m\"")), "case.toml");
  EXPECT_EQ(one.friction_curve->coulomb.basis, io::Basis::measured);
  EXPECT_EQ(one.friction_curve->stribeck_rate.basis, io::Basis::inferred) << "one test shows none";
}

// Tests at 0, 5.236, 62.83 and 209.4 rad/s of the motors, and further ones.
std::string case_of_torques(const std::vector<std::string>& torques,
                            const std::vector<double>& further = {}) {
  std::vector<double> rates{0.0, 5.236, 62.83, 209.4};
  rates.insert(rates.end(), further.begin(), further.end());
  const double ratio = io::gear_ratio(io::read_case(case_path("dss14-70m")));
  std::string tests;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    tests += test(fmt::format("{:.12g} rad/s", rates[i] / ratio), "torque = " + torques[i]);
  }
  return tested(tests);
}

// As one line.
std::string model_of(const io::Case& antenna) {
  std::istringstream words(to_text(document_of(describe_plant(antenna))));
  std::string line, word;
  while (words >> word) line += word + " ";
  return line;
}

std::vector<Implausibility> of_the_curve(const io::Case& antenna) {
  std::vector<Implausibility> found;
  for (const auto& one : audit_report(antenna).implausible) {
    if (one.id == "friction_curve.test") found.push_back(one);
  }
  return found;
}

TEST(CaseFriction, SaysThatACurveHangsOnTheLastDigitOfATorque) {
  const io::Case antenna = io::parse_case(
      case_of_torques({"\"19 N.m\"", "\"12 N.m\"", "\"15 N.m\"", "\"23 N.m\""}), "case.toml");
  ASSERT_EQ(antenna.friction_curve->tests.size(), 4U);
  EXPECT_NEAR(antenna.friction_curve->tests[1].leeway, 0.5, 1e-12);
  // With 14.5 N.m the line begins at 10.856 N.m, and 12 N.m stand 0.839 N.m above it.
  EXPECT_THAT(model_of(antenna),
              AllOf(HasSubstr("the Stribeck rate is 1.75 (its bound) to 3.47 rad/s, breakaway is "
                              "18.5 to 19.5 N.m, Coulomb is 10.9 to 11.9 N.m."),
                    HasSubstr("no degree of freedom is left, so the residuals do not check"),
                    HasSubstr("test more low rates")));
  const auto found = of_the_curve(antenna);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].check, "friction tests");
  EXPECT_THAT(
      found[0].reasoning,
      AllOf(HasSubstr("as many unknowns as its 4 tests"),
            HasSubstr("rad/s by the torques as stated, is 1.75 (its bound) to 3.47 rad/s, moved"),
            HasSubstr("moved most by friction_curve.test[2] of 15 N.m at 62.83 rad/s")));
  EXPECT_THAT(
      io::loose_stribeck_text(*antenna.friction_curve),
      HasSubstr(
          "rate of 2.64 rad/s, which the 4 tests, as many as the curve has unknowns, "
          "leave at 1.75 (its bound) to 3.47 rad/s as one torque is moved by its uncertainty"));
  ASSERT_EQ(found[0].numbers.size(), 3U);
  EXPECT_NEAR(found[0].numbers[1].value, 5.236 / 3.0, 1e-9);
  EXPECT_NEAR(found[0].numbers[2].value, 3.474, 1e-3);

  // Where the curve does not go through the tests, a number of it is at its bound.
  const io::Case below = io::parse_case(
      case_of_torques({"\"19 N.m\"", "\"11 N.m\"", "\"15 N.m\"", "\"23 N.m\""}), "case.toml");
  EXPECT_THAT(model_of(below),
              AllOf(HasSubstr("the Stribeck rate is 1.75 rad/s (its bound) or less, "),
                    HasSubstr("a parameter at its bound")));
  EXPECT_EQ(of_the_curve(below).size(), 1U);
}

TEST(CaseFriction, DoubtsNoCurveThatItsTestsCheckOrTell) {
  const io::Case told = io::parse_case(
      case_of_torques({"\"19.00 N.m\"", "{ value = \"12 N.m\", uncertainty = \"0.01 N.m\" }",
                       "\"15.00 N.m\"", "\"23.00 N.m\""}),
      "case.toml");
  EXPECT_NEAR(told.friction_curve->tests[0].leeway, 0.005, 1e-12);
  EXPECT_NEAR(told.friction_curve->tests[1].leeway, 0.01, 1e-12);
  EXPECT_THAT(of_the_curve(told), IsEmpty());
  EXPECT_EQ(io::loose_stribeck_text(*told.friction_curve), "");
  EXPECT_THAT(model_of(told),
              AllOf(HasSubstr("no degree of freedom is left"), HasSubstr("the Stribeck rate is 2."),
                    Not(HasSubstr("bound)")), Not(HasSubstr("breakaway is"))));
  // Of 11.571 + 7.429 exp(-(w/2.634)^2) + 0.05457 w, to 1 N.m.
  const io::Case checked = io::parse_case(
      case_of_torques({"\"19 N.m\"", "\"12 N.m\"", "\"15 N.m\"", "\"23 N.m\"", "\"18 N.m\""},
                      {1.0}),
      "case.toml");
  EXPECT_THAT(of_the_curve(checked), IsEmpty());
  EXPECT_THAT(model_of(checked),
              AllOf(HasSubstr("the Stribeck rate is "), Not(HasSubstr("degree of freedom"))));
  // Three tests tell no Stribeck rate.
  const io::Case three = io::parse_case(
      tested(test("0 deg/s", "torque = \"90 N.m\"") + test("0.1 deg/s", "torque = \"60 N.m\"") +
             test("0.2 deg/s", "torque = \"65 N.m\"")),
      "case.toml");
  EXPECT_THAT(of_the_curve(three), IsEmpty());
  EXPECT_THAT(model_of(three), AllOf(HasSubstr("no degree of freedom is left"),
                                     HasSubstr("Stribeck rate, which these tests do not determine"),
                                     Not(HasSubstr("the Stribeck rate is "))));
  EXPECT_THAT(of_the_curve(io::read_case(case_path("dss14-70m"))), IsEmpty());
}

std::string motor_test(const std::string& rate, const std::string& what) {
  return fmt::format("\n[[friction_curve.test]]\nmotor_rate = \"{}\"\n{}\n", rate, what);
}

TEST(CaseFriction, TakesRatesOfTheMotors) {
  const double ratio = io::gear_ratio(io::read_case(case_path("dss14-70m")));
  const std::string torque = "torque = \"60 N.m\"";
  const io::Case by_motor = io::parse_case(
      tested(motor_test("0 rpm", "torque = \"90 N.m\"") + motor_test("100 rpm", torque)),
      "case.toml");
  const auto& tests = by_motor.friction_curve->tests;
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].rate, 0.0);
  EXPECT_NEAR(tests[1].rate, 10.0 * std::numbers::pi / 3.0, 1e-12);
  // The same as by the axis, and beside tests by the axis.
  const std::string at_axis = fmt::format("{:.15g} rpm", 100.0 / ratio);
  const io::Case by_axis = io::parse_case(
      tested(motor_test("0 rpm", "torque = \"90 N.m\"") + test(at_axis, torque)), "case.toml");
  const auto curve = io::friction_curve(by_motor), other = io::friction_curve(by_axis);
  for (const double rate : {0.1, 3.0, 100.0}) {
    EXPECT_NEAR(plant::friction_torque(curve, rate), plant::friction_torque(other, rate), 1e-9);
  }
  EXPECT_EQ(by_motor.friction_curve->coulomb.basis, io::Basis::measured);
}

TEST(CaseFriction, RefusesARateOfNeitherShaftOrOfBoth) {
  const std::string torque = "torque = \"60 N.m\"";
  const std::string wanted =
      "friction_curve.test[0].rate: expected either rate (of the axis) or motor_rate, found ";
  EXPECT_THAT(refusal_of(tested(test("0.1 deg/s", torque + "\nmotor_rate = \"100 rpm\""))),
              HasSubstr(wanted + "both"));
  EXPECT_THAT(refusal_of(tested("\n[[friction_curve.test]]\n" + torque + "\n")),
              HasSubstr(wanted + "neither"));
  EXPECT_THAT(refusal_of(tested(test("100 rpm", torque))),
              HasSubstr("friction_curve.test[0].rate: expected a rate of the antenna's axis, at "
                        "most 10 rad/s, found '100 rpm' (a rate of the motors is motor_rate)"));
  EXPECT_THAT(refusal_of(tested(motor_test("1e6 rad/s", torque))),
              HasSubstr("friction_curve.test[0].motor_rate: expected an angular rate from 0"));
  EXPECT_THAT(refusal_of(tested(motor_test("100 rpm", torque) + motor_test("100 rpm", torque))),
              HasSubstr("friction_curve.test[1].motor_rate: expected one test a rate"));
}

TEST(CaseFriction, TakesPressuresOverTheMotors) {
  const io::Case by_torque =
      io::parse_case(tested(test("0.1 deg/s", "torque = \"60 N.m\"")), "case.toml");
  const double pressure = 60.0 / plant::torque_per_pressure(io::hydraulic_drive(by_torque));
  const io::Case by_pressure = io::parse_case(
      tested(test("0.1 deg/s", fmt::format("pressure = \"{:.12g} Pa\"", pressure))), "case.toml");
  EXPECT_NEAR(by_pressure.friction_curve->coulomb.value, 60.0, 1e-9);
  // What all tests share, displacement and efficiency, moves none against another.
  const io::Case coarse =
      io::parse_case(tested(test("0.1 deg/s", "pressure = \"1.0 MPa\"")), "case.toml");
  const io::SteadyFrictionTest& one = coarse.friction_curve->tests.front();
  EXPECT_NEAR(one.leeway / one.torque, 0.05, 1e-9);
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
