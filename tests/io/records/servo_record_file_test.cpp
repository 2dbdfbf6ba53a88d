#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_computer.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/records/servo_record_file.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using identification::ServoRecord;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int samples = 100;
constexpr double sample_time = 0.02;

// A file's lines: the header, then for each sample its time and what `cells` writes behind it.
std::string lines(const std::string& header, const std::function<std::string(int)>& cells) {
  std::string text = header + "\n";
  for (int i = 0; i < samples; ++i) text += fmt::format("{:.2f},{}\n", sample_time * i, cells(i));
  return text;
}

class ReadServoRecord : public testing::Test {
 protected:
  ServoRecord read(const std::string& text) {
    return read_servo_record(antenna, folder.write("night.csv", text), notes);
  }
  ServoRecord read(const std::string& header, const std::string& cells) {
    return read(lines(header, [&](int) { return cells; }));
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  }
  std::string refusal(const std::string& header, const std::string& cells) {
    return refusal(lines(header, [&](int) { return cells; }));
  }

  Case antenna = read_case(case_path("dss14-70m"));
  ScratchFolder folder;
  ServoRecordNotes notes;
};

// The pressure difference between the ports, and the torque that the computer makes of it.
TEST_F(ReadServoRecord, TakesThePressureDifferenceAsTheMotorTorque) {
  const double torque = plant::torque_per_pressure(hydraulic_drive(antenna));
  const ServoRecord pressure = read("time [s],pressure difference [MPa]", "2.5");
  ASSERT_TRUE(pressure.motor_torque.has_value());
  EXPECT_NEAR(pressure.motor_torque->values[3], 2.5e6 * torque, 1e-9);
  const ServoRecord shown = read("time [s],motor torque [N.m]", "40");
  ASSERT_TRUE(shown.motor_torque.has_value());
  EXPECT_DOUBLE_EQ(shown.motor_torque->values[3], 40.0);
  // Volts have no scale without [computer], and wind torque is none of the motors.
  const ServoRecord volts = read("time [s],torque [V],tach [V]", "1,1");
  EXPECT_FALSE(volts.motor_torque.has_value());
  EXPECT_FALSE(read("time [s],wind torque [N.m],tach [V]", "1,1").motor_torque.has_value());
}

TEST_F(ReadServoRecord, ConvertsEverySignalToSiUnits) {
  const ServoRecord record = read(
      "time [s],El Encoder [deg],El Position Command [deg],Position error [mdeg],Boresight "
      "[arcsec],Rate Command [mdeg/s],Motor rate [rpm],Valve Command [%],Wind Speed [mph],Wind "
      "Direction [deg]",
      "45.0,45.001,2.5,3.6,4,60,50,10,350");
  EXPECT_EQ(record.name, "night");
  EXPECT_NEAR(record.sample_time, sample_time, 1e-12);
  const auto value = [](const std::optional<identification::Signal>& signal) {
    EXPECT_TRUE(signal && signal->values.size() == samples && signal->valid.empty());
    return signal ? signal->values[samples / 2] : 0.0;
  };
  EXPECT_NEAR(value(record.encoder), 45.0 * degree, 1e-12);
  EXPECT_NEAR(value(record.position_command), 45.001 * degree, 1e-12);
  EXPECT_NEAR(value(record.position_error), 2.5 * millidegree, 1e-15);
  EXPECT_NEAR(value(record.boresight_error), 1.0 * millidegree, 1e-15);
  EXPECT_NEAR(value(record.rate_command), 4.0 * millidegree * gear_ratio(antenna), 1e-9);
  EXPECT_NEAR(value(record.motor_rate), two_pi, 1e-9);
  EXPECT_NEAR(value(record.valve_command), 0.5 * antenna.simulation->valve_stroke.value, 1e-9);
  EXPECT_NEAR(value(record.wind_speed), 4.4704, 1e-9);
  EXPECT_NEAR(value(record.wind_direction), 350.0 * degree, 1e-12);
  EXPECT_THAT(notes.unused_columns, IsEmpty());
  EXPECT_EQ(notes.sources.size(), 10U);
  EXPECT_EQ(notes.sha256.size(), 64U);
}

TEST_F(ReadServoRecord, ReadsWindInTheUnitsOfAnemometers) {
  const auto speed = [&](const std::string& unit) {
    return read("time [s],wind [" + unit + "]", "10").wind_speed->values[0];
  };
  EXPECT_DOUBLE_EQ(speed("m/s"), 10.0);
  EXPECT_NEAR(speed("km/h"), 10.0 / 3.6, 1e-12);
  EXPECT_NEAR(speed("knots"), 5.14444444, 1e-8);
  EXPECT_NEAR(speed("knot"), 5.14444444, 1e-8);
  EXPECT_NEAR(speed("kph"), 10.0 / 3.6, 1e-12);
}

TEST_F(ReadServoRecord, ComputesThePositionErrorAcrossFullTurns) {
  const ServoRecord record = read(lines("time [s],encoder [deg],command [deg]", [](int i) {
    const double encoder = std::fmod(359.0 + 0.05 * i, 360.0);
    const double command = std::fmod(359.01 + 0.05 * i, 360.0);
    return fmt::format("{:.6f},{:.6f}", encoder, command);
  }));
  ASSERT_TRUE(record.position_error);
  EXPECT_LT((record.position_error->values.array() - 0.01 * degree).abs().maxCoeff(), 1e-9);
  // The encoder goes on past the full turn.
  EXPECT_NEAR(record.encoder->values[samples - 1], (359.0 + 0.05 * (samples - 1)) * degree, 1e-9);
  EXPECT_THAT(notes.sources.back().remark, HasSubstr("position command less encoder"));
}

TEST_F(ReadServoRecord, ScalesVoltsByTachometerAndComputer) {
  antenna.computer = ComputerEntry{};
  antenna.computer->valve_voltage = Quantity{};
  antenna.computer->valve_voltage->value = 10.0;
  const ServoRecord record = read("t,tach [V],valve [mV]\ns,,", "2,500");
  EXPECT_NEAR(record.motor_rate->values[3], 2.0 * *motor_rate_per_volt(antenna), 1e-12);
  EXPECT_NEAR(record.valve_command->values[3], 0.05 * antenna.simulation->valve_stroke.value, 1e-9);
}

TEST_F(ReadServoRecord, LeavesOutWhatHasNoScaleOrUnit) {
  const ServoRecord record =
      read("time [s],encoder [deg],valve command [mA],rate command [V],position error", "45,3,1,0");
  EXPECT_FALSE(record.valve_command);
  EXPECT_FALSE(record.rate_command);
  EXPECT_FALSE(record.position_error);
  EXPECT_THAT(notes.remarks, Contains(HasSubstr("'valve command' is not used: expected")));
  EXPECT_THAT(notes.remarks, Contains(HasSubstr("'rate command' is not used: expected")));
  EXPECT_THAT(notes.remarks,
              Contains(HasSubstr("'position error' is not used: it has no known unit")));
}

TEST_F(ReadServoRecord, TakesColumnsAsTheCaseNamesThem) {
  antenna.campaign->columns.valve_command =
      ColumnEntry{"u", "", {}, "record_columns.valve_command"};
  antenna.campaign->columns.reversed = {"encoder"};
  const ServoRecord record = read("time [s],encoder [deg],u [rad/s]", "45,3");
  EXPECT_DOUBLE_EQ(record.valve_command->values[0], 3.0);
  EXPECT_NEAR(record.encoder->values[0], -45.0 * degree, 1e-12);
  EXPECT_THAT(refusal("time [s],encoder [deg],u [mA]", "45,3"),
              HasSubstr("expected instruments.valve_command_scale"));
  read("time [s],encoder [deg]", "45");
  EXPECT_THAT(notes.remarks, Contains(HasSubstr("no column 'u'")));
}

TEST_F(ReadServoRecord, PassesOverTheOtherAxis) {
  const ServoRecord record = read(
      "time [s],az_encoder [deg],el_encoder [deg],az_error [mdeg],el_error [mdeg]", "120,30,7,2");
  EXPECT_NEAR(record.encoder->values[0], 30.0 * degree, 1e-12);
  EXPECT_NEAR(record.position_error->values[0], 2.0 * millidegree, 1e-15);
  EXPECT_THAT(notes.unused_columns, testing::ElementsAre("az_encoder", "az_error"));
}

TEST_F(ReadServoRecord, BridgesSamplesWithoutNumberAndMarksThem) {
  const ServoRecord record = read(lines("time [s],position error [mdeg]", [](int i) {
    return i == 50 ? std::string("nan") : fmt::format("{}", i);
  }));
  EXPECT_FALSE(record.position_error->is_valid(50));
  EXPECT_TRUE(record.position_error->is_valid(51));
  EXPECT_NEAR(record.position_error->values[50], 50.0 * millidegree, 1e-15);
  const ServoRecord dead = read(lines("time [s],encoder [deg],position error [mdeg]",
                                      [](int i) { return i > 40 ? "45,nan" : "45,1"; }));
  EXPECT_FALSE(dead.position_error);
  EXPECT_THAT(notes.remarks, Contains(HasSubstr("59 % of its samples are not valid")));
}

TEST_F(ReadServoRecord, MasksGapsAndRefusesLongOnes) {
  const auto with_gap = [](int length) {
    std::string text = "time [s],position error [mdeg]\n";
    for (int i = 0; i < samples; ++i) {
      text += fmt::format("{:.2f},{}\n", sample_time * (i < 50 ? i : i + length), i % 7);
    }
    return text;
  };
  const ServoRecord record = read(with_gap(10));
  EXPECT_EQ(record.position_error->values.size(), samples + 10);
  EXPECT_FALSE(record.position_error->is_valid(55));
  EXPECT_THAT(refusal(with_gap(60)),
              HasSubstr("night.csv: column 'time': expected samples through at least 80 % of the "
                        "time, found 62 %"));
}

TEST_F(ReadServoRecord, RefusesFilesThatAreNoRecord) {
  EXPECT_THAT(refusal("encoder [deg],error [deg]\n1,2\n3,4\n"),
              HasSubstr("expected a column for the time"));
  EXPECT_THAT(refusal("time [s],pressure [psi]", "100"),
              HasSubstr("expected a column of position error, boresight error, encoder"));
  EXPECT_THAT(refusal("time [s],error [mdeg]\n0,1\n0.02,2\n0.04,1\n"),
              HasSubstr("column 'time': expected at least 64 samples, found 3"));
  EXPECT_THROW(read_servo_record(antenna, folder.file("none.csv"), notes), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
