#include <algorithm>
#include <functional>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/one_record.hpp"
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_tests.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

TEST(MakeCampaign, TakesUnitsInAnyCaseAndFromTheCase) {
  OneRecord record("full", "slow_ramp");
  const auto before = record.make().records.at(0);
  record.replace("p1_in [psi]", "P1_IN [PSIG]");
  record.replace("tach [V]", "Tach");
  record.replace("time [s]", "TIME [sec]");
  record.antenna.campaign->columns.tachometer->unit = "V";
  const auto after = record.make().records.at(0);
  EXPECT_EQ(after.motor_rate.values, before.motor_rate.values);
  EXPECT_EQ(after.inlet_pressure[0].values, before.inlet_pressure[0].values);
  record.antenna.campaign->columns.tachometer->unit.clear();
  EXPECT_THAT(record.refusal(),
              HasSubstr("expected a unit of column 'Tach', found none in the file or the case (say "
                        "it in the case: record_columns.tachometer = \"Tach [unit]\")"));
  record.replace("Tach", "Tach [mV]");
  record.antenna.campaign->columns.tachometer->unit = "V";
  EXPECT_THAT(record.refusal(), HasSubstr("Case.csv states, 'mV', or none, found 'V'"));
}

TEST(MakeCampaign, RefusesColumnsAndUnitsThatDoNotFit) {
  const auto refused = [](const std::function<void(OneRecord&)>& edit) {
    OneRecord record("full", "slow_ramp");
    edit(record);
    return record.refusal();
  };
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign->columns.tachometer->name = "tacho"; }),
              HasSubstr("record_columns.tachometer: expected a column of "));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign->columns.tachometer->name = "tacho"; }),
              HasSubstr("found 'tacho' (did you mean 'tach'?)"));
  EXPECT_THAT(refused([](auto& r) { r.replace("p2_in", "p1_in"); }),
              HasSubstr("found 2 named 'p1_in'"));
  EXPECT_THAT(refused([](auto& r) { r.replace("p1_in [psi]", "p1_in [V]"); }),
              HasSubstr("expected a pressure in column 'p1_in', found 'V', a voltage"));
  EXPECT_THAT(refused([](auto& r) { r.replace("tach [V]", "tach [psi]"); }),
              HasSubstr("expected a voltage or an angular rate in column 'tach'"));
  EXPECT_THAT(refused([](auto& r) { r.replace("time [s]", "time [V]"); }),
              HasSubstr("expected a time in column 'time'"));
  EXPECT_THAT(refused([](auto& r) { r.replace("rate_command [V]", "rate_command [mA]"); }),
              HasSubstr("instruments.rate_command_scale: expected a rate per 'mA'"));
  EXPECT_THAT(
      refused([](auto& r) { r.antenna.campaign->instruments->valve_command_scale.reset(); }),
      HasSubstr("instruments.valve_command_scale: expected a rate per recorded unit, 'V', "
                "for 'valve_command'"));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign->instruments->rate_command_shaft.clear(); }),
              HasSubstr("instruments.rate_command_shaft: expected whose rate it is"));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign->tachometer.reset(); }),
              HasSubstr("tachometer: expected voltage and shaft_speed of the tachometer"));
  EXPECT_THAT(refused([](auto& r) {
                r.antenna.campaign->columns.rate_command = r.antenna.campaign->columns.tachometer;
              }),
              HasSubstr("expected a column for each signal, found 'tach' taken for two"));
  EXPECT_THAT(refused([](auto& r) {
                r.antenna.campaign->columns = {};
                r.replace("p3_out", "q3_nobody");
              }),
              HasSubstr("expected a column for the outlet pressure of motor 3, found none or "
                        "several that could be it among 'time', 'p1_in'"));
  EXPECT_THAT(refused([](auto& r) {
                r.antenna.campaign->instruments.reset();
                r.antenna.recorder.reset();
              }),
              HasSubstr("instruments: expected the uncertainties"));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign->records.clear(); }),
              HasSubstr("record: expected a list of tables [[record]], found none"));
  EXPECT_THAT(refused([](auto& r) { r.text.resize(3000); }),
              HasSubstr("expected most of 1 records to be of use, found 1 that are not; slow_ramp: "
                        "expected at least 200 samples"));
}

TEST(MakeCampaign, RefusesAMappedColumnThatNoRecordHas) {
  for (const std::string key : {"rate_command", "valve_command"}) {
    OneRecord record("full", "slow_ramp");
    auto& columns = record.antenna.campaign->columns;
    auto& entry = key == "rate_command" ? columns.rate_command : columns.valve_command;
    entry->name = key + "s";
    EXPECT_THAT(record.refusal(), HasSubstr("record_columns." + key +
                                            ": expected a column of one record at least, "
                                            "found '" +
                                            key + "s' (did you mean '" + key +
                                            "'?) where they have "
                                            "'time', 'p1_in'"));
  }
  OneRecord record("full", "slow_ramp");
  record.antenna.campaign->columns.reversed = {"tach", "p1_inn"};
  EXPECT_THAT(record.refusal(),
              HasSubstr("record_columns.reversed: expected a column of one record at least, found "
                        "'p1_inn' (did you mean 'p1_in'?)"));
}

TEST(MakeCampaign, SaysWhichRecordsLackAMappedColumn) {
  OneRecord record("full", "slow_ramp");
  record.antenna.campaign->records.push_back(record.antenna.campaign->records[0]);
  RecordEntry& whole = record.antenna.campaign->records[1];
  whole.name = "whole";
  whole.file = folder_of("full") + "/slow_ramp.csv";
  record.replace("rate_command", "rate_commnd");
  const auto made = record.make();
  EXPECT_FALSE(made.records[0].rate_command);
  EXPECT_TRUE(made.records[1].rate_command);
  EXPECT_THAT(record.notes.records[0].remarks,
              testing::ElementsAre("no column 'rate_command', which record_columns.rate_command "
                                   "names (did you mean 'rate_commnd'?): taken as not recorded"));
  EXPECT_TRUE(record.notes.records[1].remarks.empty());
}

TEST(MakeCampaign, GuessesNamesInOtherStyles) {
  OneRecord record("small-dish", "slow_ramp");
  const auto before = record.make().records.at(0);
  record.antenna.campaign->columns = {};
  for (const std::string header :
       {"Time,P1 IN,P1 OUT,P2 IN,P2 OUT,Motor Speed,Speed Cmd,Valve\n"
        "s,bar,bar,bar,bar,rpm,deg/s,V",
        "t [sec];press_in_1 [BAR];press_out_1 [BAR];press_in_2 [BAR];press_out_2 [BAR];Tacho [RPM];"
        "RateRef [deg/sec];ServoValve [volts]",
        "timestamp (s)\tPressureInlet1 (bar)\tPressureOutlet1 (bar)\tPressureInlet2 "
        "(bar)\tPressureOutlet2 (bar)\tMotorSpeed (rpm)\tRateCommand (deg/s)\tvalve cmd (V)",
        "TIME [s],Motor 1 A [bar],Motor 1 B [bar],Motor 2 A [bar],Motor 2 B [bar],TACH [rpm],"
        "rate setpoint [deg/s],valve [V]"}) {
    OneRecord styled("small-dish", "slow_ramp");
    styled.antenna.campaign->columns = {};
    const std::size_t end = styled.text.find('\n');
    std::string rows = styled.text.substr(end);
    const char separator = header.find('\t') != std::string::npos  ? '\t'
                           : header.find(';') != std::string::npos ? ';'
                                                                   : ',';
    std::replace(rows.begin(), rows.end(), ',', separator);
    styled.text = header + rows;
    const auto after = styled.make().records.at(0);
    EXPECT_EQ(after.inlet_pressure[1].values, before.inlet_pressure[1].values) << header;
    EXPECT_EQ(after.outlet_pressure[0].values, before.outlet_pressure[0].values) << header;
    EXPECT_EQ(after.motor_rate.values, before.motor_rate.values) << header;
    ASSERT_TRUE(after.rate_command && after.valve_command) << header;
    EXPECT_EQ(after.rate_command->values, before.rate_command->values) << header;
    EXPECT_EQ(after.valve_command->values, before.valve_command->values) << header;
    for (const auto& source : styled.notes.records[0].sources) EXPECT_TRUE(source.guessed);
  }
}

TEST(MakeCampaign, TakesTimesInMillisecondsAndMinutes) {
  const auto with_times = [](double per_second, const std::string& unit) {
    OneRecord record("small-dish", "slow_ramp");
    std::stringstream lines(record.text);
    std::string line;
    std::getline(lines, line);
    std::string edited = "time [" + unit + line.substr(line.find(']')) + "\n";
    while (std::getline(lines, line)) {
      const std::size_t comma = line.find(',');
      std::ostringstream time;
      time.precision(12);
      time << per_second * std::stod(line.substr(0, comma));
      edited += time.str() + line.substr(comma) + "\n";
    }
    record.text = edited;
    return record.make().records.at(0);
  };
  OneRecord record("small-dish", "slow_ramp");
  const auto before = record.make().records.at(0);
  for (const auto& after : {with_times(1e3, "ms"), with_times(1.0 / 60.0, "min")}) {
    EXPECT_NEAR(after.sample_time, before.sample_time, 1e-9 * before.sample_time);
    EXPECT_EQ(after.motor_rate.values, before.motor_rate.values);
  }
}

TEST(MakeCampaign, DoesNotGuessAColumnOfAnotherKind) {
  OneRecord record("full", "slow_ramp");
  record.antenna.campaign->columns = {};
  record.replace("valve_command [V]", "p1_in_sensor [mA]");
  record.replace("rate_command [V]", "p1_in_temperature [K]");
  record.make();
  EXPECT_EQ(record.notes.records[0].unused_columns,
            (std::vector<std::string>{"p1_in_temperature", "p1_in_sensor"}));
}

TEST(MakeCampaign, LeavesAGuessedCommandItCannotScaleOutAndSaysSo) {
  OneRecord record("full", "slow_ramp");
  record.antenna.campaign->columns = {};
  record.antenna.campaign->instruments->valve_command_scale.reset();
  record.replace("rate_command [V]", "rate_command");
  const auto made = record.make().records.at(0);
  EXPECT_FALSE(made.valve_command);
  EXPECT_FALSE(made.rate_command);
  ASSERT_EQ(record.notes.records[0].remarks.size(), 2U);
  EXPECT_THAT(record.notes.records[0].remarks[0], HasSubstr("it has no known unit"));
  EXPECT_THAT(record.notes.records[0].remarks[1], HasSubstr("instruments.valve_command_scale"));
}

TEST(MakeCampaign, TakesASampleRateWhereTheFileHasNoTimes) {
  OneRecord record("full", "slow_ramp");
  const auto before = record.make().records.at(0);
  record.antenna.campaign->columns.time.reset();
  Quantity rate;
  rate.value = 200.0;
  rate.text = "200 Hz";
  record.antenna.campaign->columns.sample_rate = rate;
  record.replace("time [s]", "counter");
  const auto after = record.make().records.at(0);
  EXPECT_NEAR(after.sample_time, 0.005, 1e-15);
  EXPECT_EQ(after.motor_rate.values, before.motor_rate.values);
  EXPECT_EQ(record.notes.records[0].unused_columns, std::vector<std::string>{"counter"});
}

TEST(MakeCampaign, ReadsTheSameWhateverTheSeparator) {
  OneRecord record("small-dish", "slosh");
  const auto before = record.make().records.at(0);
  std::replace(record.text.begin(), record.text.end(), ',', ';');
  std::replace(record.text.begin(), record.text.end(), '.', ',');
  const auto after = record.make().records.at(0);
  EXPECT_EQ(record.notes.records[0].format, "text separated by semicolon, decimal comma");
  EXPECT_EQ(after.motor_rate.values, before.motor_rate.values);
  EXPECT_EQ(after.inlet_pressure[1].values, before.inlet_pressure[1].values);
}

}  // namespace
}  // namespace boresight::io
