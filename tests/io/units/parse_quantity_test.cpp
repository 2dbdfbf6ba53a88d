#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/every_kind.hpp"
#include "io/unit_refusal.hpp"
#include <boresight/io/units/units.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

Refusal refused_quantity(std::string_view text, io::Kind kind) {
  return refusal_of([text, kind] { io::parse_quantity(text, kind); });
}

double value_of(std::string_view text, io::Kind kind) {
  return io::parse_quantity(text, kind).value;
}

/// Within the rounding of a few operations.
void expect_same(double found, double expected, std::string_view text) {
  EXPECT_NEAR(found, expected, 4e-16 * std::abs(expected)) << text;
}

TEST(DescribeKind, NamesAUnitThatCountsOne) {
  for (const io::Kind kind : every_kind()) {
    const std::string text = "1 " + std::string(io::describe(kind).si_unit);
    EXPECT_EQ(value_of(text, kind), 1.0) << text;
  }
}

TEST(DescribeKind, GivesExamplesTheKindAccepts) {
  for (const io::Kind kind : every_kind()) {
    const std::string examples(io::describe(kind).examples);
    for (std::size_t begin = 0; begin < examples.size();) {
      const std::size_t end = std::min(examples.find(", ", begin), examples.size());
      const std::string example = examples.substr(begin, end - begin);
      EXPECT_NO_THROW(io::parse_quantity(kind == io::Kind::number ? example : "1 " + example, kind))
          << example;
      begin = end + 2;
    }
  }
}

TEST(DescribeKind, HasArticleAndExamplesInItsExpectation) {
  EXPECT_EQ(io::expectation(io::Kind::inertia), "an inertia (such as kg.m2, lbf.ft.s2)");
  EXPECT_EQ(io::expectation(io::Kind::length), "a length (such as m, in)");
}

TEST(ParseQuantity, ConvertsWhatThePaperPrints) {
  // Fifteen digits are published: half a unit of the last.
  EXPECT_NEAR(value_of("0.22177 lbf.ft.s2", io::Kind::inertia), 0.300679746401455, 5e-16);
  expect_same(value_of("1 psi", io::Kind::pressure), 6894.757293168361, "psi");
  expect_same(value_of("2.339 in3/rev", io::Kind::displacement), 2.339 * 1.6387064e-5 / (2.0 * pi),
              "in3/rev");
  expect_same(value_of("5.21 N.m/rpm", io::Kind::viscous_friction), 5.21 * 30.0 / pi, "N.m/rpm");
  expect_same(value_of("1219 rpm", io::Kind::angular_rate), 1219.0 * pi / 30.0, "rpm");
  expect_same(value_of("3.82166 rpm/V", io::Kind::tachometer_scale), 3.82166 * pi / 30.0, "rpm/V");
  expect_same(value_of("527 mdeg", io::Kind::angle), 0.527 * pi / 180.0, "mdeg");
  expect_same(value_of("3 %", io::Kind::number), 0.03, "percent");
  expect_same(value_of("-40.5 N.m", io::Kind::torque), -40.5, "negative");
}

TEST(ParseQuantity, GivesFrequenciesInCyclesAndBandwidthsInRadians) {
  EXPECT_EQ(value_of("0.97 Hz", io::Kind::frequency), 0.97);
  EXPECT_EQ(value_of("3 kHz", io::Kind::frequency), 3000.0);
  EXPECT_EQ(value_of("60 rpm", io::Kind::frequency), 1.0);
  expect_same(value_of("6.09 rad/s", io::Kind::frequency), 6.09 / (2.0 * pi), "rad/s");
  expect_same(value_of("0.97 Hz", io::Kind::bandwidth_frequency), 0.97 * 2.0 * pi, "bandwidth");
  EXPECT_EQ(value_of("6.09 rad/s", io::Kind::bandwidth_frequency), 6.09);
  EXPECT_EQ(refused_quantity("0.97 1/s", io::Kind::frequency).message,
            "expected a frequency (such as Hz, rad/s), found '0.97 1/s', a rate constant (it does "
            "not tell cycles from radians: write Hz or rad/s)");
  EXPECT_EQ(value_of("1.2 1/s", io::Kind::proportional_gain), 1.2);
  expect_same(value_of("1.2 (deg/s)/deg", io::Kind::proportional_gain), 1.2, "gain");
}

TEST(ParseQuantity, TellsKindsWithAngleFromThoseWithout) {
  const std::vector<std::tuple<std::string_view, io::Kind, std::string_view>> refused{
      {"5 Hz", io::Kind::rate_constant, "a frequency or angular rate (the two differ by an angle"},
      {"5 Hz", io::Kind::proportional_gain, "differ by an angle"},
      {"5 N.m/rad", io::Kind::torque, "a stiffness (the two differ by an angle"},
      {"5 N.m", io::Kind::stiffness, "a torque (the two differ by an angle"},
      {"5 in3", io::Kind::displacement, "a volume (the two differ by an angle"},
      {"5 1/s", io::Kind::bandwidth_frequency, "differ by an angle"},
      {"5 1/s", io::Kind::bandwidth_frequency,
       "an integral gain over its proportional gain, in rad/s"},
      {"5 L/min", io::Kind::rate_constant,
       "a flow (write 1/s, 1/min; leakage known as a flow is drive.leakage_flow with"},
      {"5 1/s", io::Kind::angular_rate, "differ by an angle"},
      {"5 N.m.s", io::Kind::viscous_friction, "differ by an angle"},
      {"5 kg.m2/rad", io::Kind::inertia, "differ by an angle"},
      {"5 rad", io::Kind::number, "an angle (the two differ by an angle"},
      {"5", io::Kind::angle, "which has no unit (write '5 deg')"},
      {"5 1", io::Kind::angle, "a number (the two differ by an angle"},
      {"5 lbf.ft2", io::Kind::inertia, "a force stands where a mass belongs"},
      {"5 lbm.ft", io::Kind::torque, "a mass stands where a force belongs"},
      {"5 N.m", io::Kind::inertia, "a torque (write kg.m2, lbf.ft.s2)"},
      {"5 kg.m2/s", io::Kind::inertia, "kg.m2/s (write"},
      {"5 1/(m.A2)", io::Kind::inertia, "1/(m.A2) (write"},
  };
  for (const auto& [text, kind, message] : refused) {
    EXPECT_THAT(refused_quantity(text, kind).message, HasSubstr(message)) << text;
  }
}

TEST(ParseQuantity, TakesHalfAUnitOfTheLastPrintedDigit) {
  const std::vector<std::pair<std::string_view, double>> half_units{
      {"0.97", 0.005},     {"24", 0.5},     {"2.41667e8", 500.0}, {"100e6", 0.5e6},
      {"1.50", 0.005},     {"-3.0", 0.05},  {"+7", 0.5},          {"5 %", 0.005},
      {"1.5E-3", 0.00005}, {"2e+3", 500.0}, {"0", 0.5},           {"0.000", 0.0005},
  };
  for (const auto& [text, half_unit] : half_units) {
    EXPECT_DOUBLE_EQ(io::parse_quantity(text, io::Kind::number).half_unit, half_unit) << text;
  }
  EXPECT_DOUBLE_EQ(io::parse_quantity("12.5 in", io::Kind::length).half_unit, 0.05 * 0.0254);
  EXPECT_DOUBLE_EQ(io::parse_quantity("6.09 rad/s", io::Kind::frequency).half_unit,
                   0.005 / (2.0 * pi));
}

TEST(ParseQuantity, AcceptsNumbersWithoutABlankBeforeTheUnit) {
  EXPECT_EQ(value_of("5%", io::Kind::number), 0.05);
  EXPECT_EQ(value_of("0.97Hz", io::Kind::frequency), 0.97);
  EXPECT_EQ(value_of("5e3m", io::Kind::length), 5e3);
  EXPECT_EQ(value_of("  5   m ", io::Kind::length), 5.0);
  EXPECT_EQ(io::parse_quantity("  5   m ", io::Kind::length).text, "5   m");
  EXPECT_THAT(refused_quantity("5e m", io::Kind::length).message, HasSubstr("found 'e' in '5e m'"));
}

TEST(ParseQuantity, RefusesNumbersThatReadTwoWays) {
  const std::vector<std::pair<std::string_view, std::string_view>> refused{
      {"1,5 m", "found '1,5' in '1,5 m' (the decimal sign is a point: write 1.5)"},
      {"1,500 m", "write 1.500, or 1500 if it is thousands"},
      {"1,500,000 m", "without separators"},
      {"1.500.000 m", "without separators"},
      {"1,500.5 m", "without separators"},
      {"1'500 m", "without separators"},
      {"1_500 m", "without separators"},
      {"1 500 m", "a number is written without gaps"},
      {"0x1F m", "write a decimal number"},
      {"nan m", "a number must be finite"},
      {"-inf m", "a number must be finite"},
      {"Infinity m", "a number must be finite"},
      {".5 m", "write the zero before the point"},
      {"5. m", "digits must follow the point"},
      {"5.m", "digits must follow the point"},
      {"1e400 m", "must fit double precision"},
      {"1e-400 m", "must fit double precision"},
      {"0e99999999999 m", "must fit double precision"},
      {"1e308 km", "must fit double precision in SI units"},
      {"1e-307 um", "must fit double precision in SI units"},
      {"m", "a number comes first"},
      {"--5 m", "a number comes first"},
      {"-", "a number comes first"},
      {"", "found nothing (write a number and its unit)"},
      {"   ", "write a number and its unit"},
      {"1/2 m", "a fraction as its value"},
      {"−5 m", "a number comes first"},
      {"5 ± 1 m", "an uncertainty has a key of its own"},
  };
  for (const auto& [text, message] : refused) {
    EXPECT_THAT(refused_quantity(text, io::Kind::length).message, HasSubstr(message)) << text;
    EXPECT_THAT(refused_quantity(text, io::Kind::length).message,
                HasSubstr("expected a length (such as m, in), found "))
        << text;
  }
}

TEST(ParseQuantity, PointsAtTheTokenWithinTheWholeText) {
  EXPECT_EQ(refused_quantity("5 lbf.fot", io::Kind::torque).column, 7);
  EXPECT_EQ(refused_quantity("5 lbf.ft2", io::Kind::torque).column, 3);
  EXPECT_EQ(refused_quantity(" 1,5 m", io::Kind::length).column, 2);
  EXPECT_EQ(refused_quantity("5 lbf.fot", io::Kind::torque).message,
            "expected a torque (such as N.m, lbf.ft), found 'fot' in '5 lbf.fot' (unknown unit, "
            "did you mean 'ft'?)");
}

TEST(ParseQuantity, ReadsBackEveryNumberItIsGiven) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  std::uniform_int_distribution<int> exponent(-200, 200);
  for (int round = 0; round < 2000; ++round) {
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.17g kg.m2", value);
    EXPECT_EQ(value_of(text.data(), io::Kind::inertia), value) << text.data();
  }
}

}  // namespace
}  // namespace boresight::io
