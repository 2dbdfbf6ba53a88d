#include <numbers>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/case_computer.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double degree = std::numbers::pi / 180.0;

// The 70-m antenna's case with a section [computer] of these lines; '^' marks a place.
EditedCase with_computer(const std::string& lines) {
  EditedCase text;
  text.replace("[controller]\n", "[computer]\n" + lines + "\n[controller]\n");
  return text;
}

Case parsed(const std::string& lines) {
  return parse_case(with_computer(lines).text(), "case.toml");
}

std::string refusal(const std::string& lines) {
  return refusal_of(with_computer(lines).text());
}

TEST(ComputerSection, MayBeLeftOutAndSoMayEachOfItsKeys) {
  EXPECT_FALSE(parse_case(EditedCase().text(), "case.toml").computer);
  const Case antenna = parsed("");
  ASSERT_TRUE(antenna.computer);
  EXPECT_FALSE(antenna.computer->valve_voltage);
  EXPECT_FALSE(antenna.computer->valve_current);
  EXPECT_FALSE(antenna.computer->transducer_pressure);
  EXPECT_FALSE(antenna.computer->transducer_voltage);
  EXPECT_FALSE(antenna.computer->encoder_counts);
  EXPECT_FALSE(antenna.computer->encoder_zero);
  EXPECT_FALSE(antenna.computer->encoder_centre);
}

TEST(ComputerSection, GivesEachKeyInSi) {
  const Case antenna = parsed(
      "valve_voltage = \"9500 mV\"\n"
      "transducer_pressure = \"200 bar\"\n"
      "transducer_voltage = \"5 V\"\n"
      "encoder_counts = 1048576\n"
      "encoder_zero = \"-90 deg\"\n"
      "encoder_centre = \"45 deg\"\n");
  ASSERT_TRUE(antenna.computer);
  const ComputerEntry& computer = *antenna.computer;
  ASSERT_TRUE(computer.valve_voltage && computer.transducer_pressure &&
              computer.transducer_voltage && computer.encoder_counts && computer.encoder_zero &&
              computer.encoder_centre);
  EXPECT_DOUBLE_EQ(computer.valve_voltage->value, 9.5);
  EXPECT_FALSE(computer.valve_current);
  EXPECT_DOUBLE_EQ(computer.transducer_pressure->value, 2e7);
  EXPECT_DOUBLE_EQ(computer.transducer_voltage->value, 5.0);
  EXPECT_EQ(*computer.encoder_counts, 1048576);
  EXPECT_DOUBLE_EQ(computer.encoder_zero->value, -90.0 * degree);
  EXPECT_DOUBLE_EQ(computer.encoder_centre->value, 45.0 * degree);
}

TEST(ComputerSection, TakesACurrentForTheValve) {
  for (const std::string current : {"40 mA", "0.04 A"}) {
    const Case antenna = parsed("valve_current = \"" + current + "\"\n");
    ASSERT_TRUE(antenna.computer && antenna.computer->valve_current) << current;
    EXPECT_DOUBLE_EQ(antenna.computer->valve_current->value, 0.04);
    EXPECT_FALSE(antenna.computer->valve_voltage);
  }
  EXPECT_THAT(refusal("valve_current = \"10 V\"\n"),
              HasSubstr("computer.valve_current: expected a current (such as A, mA), found '10 V', "
                        "a voltage"));
}

TEST(ComputerSection, RefusesBothValveSignalsAtTheSecondKey) {
  const std::string voltage = "valve_voltage = ", current = "valve_current = ";
  for (const auto& [lines, key] :
       {std::pair(voltage + "\"10 V\"\n" + current + "^\"40 mA\"\n", "valve_current"),
        std::pair(current + "\"40 mA\"\n" + voltage + "^\"10 V\"\n", "valve_voltage")}) {
    const EditedCase text = with_computer(lines);
    EXPECT_EQ(refusal_of(text.text()),
              "case.toml:" + std::to_string(text.line()) + ":" + std::to_string(text.column()) +
                  ": computer." + key +
                  ": expected either valve_voltage or valve_current, found both");
  }
}

TEST(ComputerSection, RefusesOneKeyOfTheTransducersAlone) {
  const std::string both =
      ": expected transducer_pressure and transducer_voltage together, found one alone";
  EXPECT_THAT(refusal("transducer_pressure = \"20 MPa\"\n"),
              HasSubstr("computer.transducer_voltage" + both));
  EXPECT_THAT(refusal("transducer_voltage = \"10 V\"\n"),
              HasSubstr("computer.transducer_pressure" + both));
}

TEST(ComputerSection, RefusesNumbersThatAreNoScale) {
  const EditedCase none = with_computer("encoder_counts = ^0\n");
  EXPECT_THAT(refusal_of(none.text()),
              StartsWith("case.toml:" + std::to_string(none.line()) + ":" +
                         std::to_string(none.column()) + ": computer.encoder_counts: expected "));
  EXPECT_THAT(refusal("encoder_counts = 255\n"), HasSubstr("computer.encoder_counts: expected "));
  EXPECT_THAT(refusal("encoder_counts = 2147483648\n"),
              HasSubstr("computer.encoder_counts: expected "));
  EXPECT_EQ(refusal("encoder_counts = 2147483647\n"), "taken");
  EXPECT_THAT(refusal("valve_voltage = \"0 V\"\n"), HasSubstr("computer.valve_voltage: expected "));
  EXPECT_THAT(refusal("transducer_pressure = \"-1 MPa\"\ntransducer_voltage = \"10 V\"\n"),
              HasSubstr("computer.transducer_pressure: expected "));
  EXPECT_THAT(refusal("encoder_zero = \"400 deg\"\n"),
              HasSubstr("computer.encoder_zero: expected "));
}

TEST(ComputerSection, NamesTheKeyNearestToAMisspeltOne) {
  EXPECT_THAT(refusal("encoder_center = \"0 deg\"\n"),
              HasSubstr("(did you mean 'encoder_centre'?)"));
}

}  // namespace
}  // namespace boresight::io
