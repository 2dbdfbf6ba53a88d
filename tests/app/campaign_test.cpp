#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/identify/campaign.hpp>
#include <boresight/identification/integrated_motion.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

using identification::DefectKind;
using identification::TestKind;
using testing::HasSubstr;

std::string folder_of(const std::string& campaign) {
  return std::string(BORESIGHT_CAMPAIGNS) + "/" + campaign;
}

Case case_of(const std::string& campaign) {
  return read_case(folder_of(campaign) + "/case.toml");
}

// The whole of a campaign with one record of it, whose text is edited.
struct OneRecord {
  explicit OneRecord(const std::string& campaign, const std::string& record)
      : antenna(case_of(campaign)) {
    std::erase_if(antenna.campaign.records,
                  [&](const RecordEntry& entry) { return entry.name != record; });
    std::ifstream file(folder_of(campaign) + "/" + record + ".csv");
    std::stringstream content;
    content << file.rdbuf();
    text = content.str();
    // A name for each test: they run side by side.
    path = testing::TempDir() + "/" +
           testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
    antenna.campaign.records.at(0).file = path;
  }
  identification::Campaign make() {
    std::ofstream(path) << text;
    notes = {};
    return make_campaign(antenna, notes);
  }
  std::string refusal() {
    try {
      make();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  }
  void replace(const std::string& old, const std::string& replacement) {
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), replacement);
  }
  Case antenna;
  std::string text, path;
  CampaignNotes notes;
};

TEST(MakeCampaign, ReadsTheThreeCampaignsWithoutAFalseAlarm) {
  for (const std::string name : {"full", "paper-like", "small-dish"}) {
    CampaignNotes notes;
    const Case antenna = case_of(name);
    const auto campaign = make_campaign(antenna, notes);
    EXPECT_EQ(campaign.records.size(), antenna.campaign.records.size());
    EXPECT_TRUE(notes.assumptions.empty());
    for (std::size_t i = 0; i < notes.records.size(); ++i) {
      const RecordNotes& note = notes.records[i];
      EXPECT_EQ(note.refusal, "");
      EXPECT_FALSE(note.test_guessed);
      EXPECT_GT(note.bytes, 100000U);
      EXPECT_NE(note.checksum, 0U);
      for (const auto& source : note.sources) EXPECT_FALSE(source.guessed);
      // The tachometer's plateaus, and nothing else.
      for (const auto& defect : note.defects) {
        EXPECT_EQ(defect.kind, DefectKind::clipped) << note.name << defect.channel;
        EXPECT_EQ(defect.channel, "tach");
        EXPECT_THAT(note.name, testing::AnyOf("fast_ramp", "slosh"));
      }
      EXPECT_EQ(campaign.records[i].inlet_pressure.size(), name == "small-dish" ? 2U : 4U);
      EXPECT_EQ(campaign.records[i].valve_command.has_value(), name != "paper-like");
    }
  }
}

TEST(MakeCampaign, KnowsTheDrivesFromTheirDrawings) {
  CampaignNotes notes;
  const auto big = drive_knowledge(case_of("full"), notes);
  EXPECT_EQ(big.motor_count, 4.0);
  EXPECT_DOUBLE_EQ(big.gear_inertia.value, 0.2171);
  EXPECT_NEAR(big.gear_inertia.standard_uncertainty, 0.05 * 0.2171, 1e-12);
  EXPECT_EQ(big.line_lengths.size(), 4U);
  EXPECT_DOUBLE_EQ(big.line_lengths[3].value, 15.60);
  EXPECT_DOUBLE_EQ(big.line_lengths[3].standard_uncertainty, 0.03);
  EXPECT_EQ(big.locked_rotor_frequencies.size(), 4U);
  EXPECT_DOUBLE_EQ(big.locked_rotor_frequencies[1].value, 3.13);
  EXPECT_NEAR(big.return_pressure, 60 * 6894.757293168361, 1e-6);
  const double turns = 134.0 / 20 * 101 / 21 * 113 / 23 * 77 / 20 * 754 / 16;
  EXPECT_NEAR(big.antenna_inertia.value, 2.4167e8 * 1.3558179483314004 / (turns * turns), 1e-9);
  const auto small = drive_knowledge(case_of("small-dish"), notes);
  const double ratio = 120.0 / 18 * 98 / 20 * 95 / 19 * 1260 / 18;
  EXPECT_NEAR(small.antenna_inertia.value, 5.2e6 / (ratio * ratio), 1e-12);
  EXPECT_NEAR(small.gear_inertia.value, 0.0182562, 1e-6);
  EXPECT_NEAR(small.gear_inertia.standard_uncertainty / small.gear_inertia.value, 0.053, 0.005);
  EXPECT_TRUE(notes.assumptions.empty());
}

TEST(MakeCampaign, ScalesAtTheMotorShaft) {
  OneRecord big("full", "constant_speed_8V");
  const auto first = big.make().records.at(0);
  EXPECT_NEAR(first.motor_rate_limit, 10.0 * 600 * 2 * std::numbers::pi / 60 / 157 * 130 / 23,
              1e-9);
  EXPECT_NEAR(first.rate_command->values.maxCoeff(), 1.444 * 12.533, 0.01);
  EXPECT_NEAR(first.inlet_pressure[0].values[0], 1041.0 * 6894.757293168361, 1.0);
  EXPECT_NEAR(big.make().instruments.valve_scale, 0.03, 1e-12);
  OneRecord small("small-dish", "constant_speed_0.22deg_s");
  const auto second = small.make().records.at(0);
  const double ratio = 120.0 / 18 * 98 / 20 * 95 / 19 * 1260 / 18;
  EXPECT_NEAR(second.rate_command->values.maxCoeff(), 0.22 * std::numbers::pi / 180 * ratio, 0.01);
  EXPECT_NEAR(second.motor_rate_limit, 200 * 2 * std::numbers::pi / 60 * 2.4, 1e-9);
  EXPECT_NEAR(second.motor_rate.values.maxCoeff(), second.rate_command->values.maxCoeff(), 3.0);
}

TEST(MakeCampaign, GuessesColumnsTestsAndLoopsAndSaysSo) {
  for (const std::string name : {"full", "small-dish", "paper-like"}) {
    Case antenna = case_of(name);
    CampaignNotes stated_notes;
    const auto stated = make_campaign(antenna, stated_notes);
    antenna.campaign.columns = {};
    for (auto& record : antenna.campaign.records) record.test = record.rate_loop = "";
    CampaignNotes notes;
    const auto guessed = make_campaign(antenna, notes);
    for (std::size_t i = 0; i < stated.records.size(); ++i) {
      EXPECT_EQ(to_string(guessed.records[i].test), to_string(stated.records[i].test))
          << name << " " << stated.records[i].name;
      EXPECT_EQ(guessed.records[i].rate_loop_closed, stated.records[i].rate_loop_closed)
          << name << " " << stated.records[i].name;
      EXPECT_EQ(guessed.records[i].outlet_pressure.back().values,
                stated.records[i].outlet_pressure.back().values);
      EXPECT_TRUE(notes.records[i].test_guessed);
      EXPECT_TRUE(notes.records[i].rate_loop_guessed);
      for (const auto& source : notes.records[i].sources) EXPECT_TRUE(source.guessed);
    }
  }
}

TEST(MakeCampaign, TakesUnitsInAnyCaseAndFromTheCase) {
  OneRecord record("full", "slow_ramp");
  const auto before = record.make().records.at(0);
  record.replace("p1_in [psi]", "P1_IN [PSIG]");
  record.replace("tach [V]", "Tach");
  record.replace("time [s]", "TIME [sec]");
  record.antenna.campaign.columns.tachometer->unit = "V";
  const auto after = record.make().records.at(0);
  EXPECT_EQ(after.motor_rate.values, before.motor_rate.values);
  EXPECT_EQ(after.inlet_pressure[0].values, before.inlet_pressure[0].values);
  record.antenna.campaign.columns.tachometer->unit.clear();
  EXPECT_THAT(record.refusal(),
              HasSubstr("expected a unit of column 'Tach', found none in the file or the case (say "
                        "it in the case: record_columns.tachometer = \"Tach [unit]\")"));
  record.replace("Tach", "Tach [mV]");
  record.antenna.campaign.columns.tachometer->unit = "V";
  EXPECT_THAT(record.refusal(), HasSubstr("Case.csv states, 'mV', or none, found 'V'"));
}

TEST(MakeCampaign, TurnsOnlyTheSignsItIsTold) {
  OneRecord record("full", "slow_ramp");
  const auto before = record.make().records.at(0);
  record.antenna.campaign.columns.reversed = {"TACH"};
  const auto after = record.make().records.at(0);
  EXPECT_EQ(after.motor_rate.values, -before.motor_rate.values);
  EXPECT_EQ(after.inlet_pressure[0].values, before.inlet_pressure[0].values);
  bool suspected = false;
  for (const auto& defect : record.notes.records[0].defects) {
    suspected = suspected || defect.kind == DefectKind::reversed_sign;
  }
  EXPECT_TRUE(suspected);
}

TEST(MakeCampaign, RefusesColumnsAndUnitsThatDoNotFit) {
  const auto refused = [](const std::function<void(OneRecord&)>& edit) {
    OneRecord record("full", "slow_ramp");
    edit(record);
    return record.refusal();
  };
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign.columns.tachometer->name = "tacho"; }),
              HasSubstr("record_columns.tachometer: expected a column of "));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign.columns.tachometer->name = "tacho"; }),
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
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign.instruments->valve_command_scale.reset(); }),
              HasSubstr("instruments.valve_command_scale: expected a rate per recorded unit, 'V', "
                        "for 'valve_command'"));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign.instruments->rate_command_shaft.clear(); }),
              HasSubstr("instruments.rate_command_shaft: expected whose rate it is"));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign.tachometer.reset(); }),
              HasSubstr("tachometer: expected voltage and shaft_speed of the tachometer"));
  EXPECT_THAT(refused([](auto& r) {
                r.antenna.campaign.columns.rate_command = r.antenna.campaign.columns.tachometer;
              }),
              HasSubstr("expected a column for each signal, found 'tach' taken for two"));
  EXPECT_THAT(refused([](auto& r) {
                r.antenna.campaign.columns = {};
                r.replace("p3_out", "q3_nobody");
              }),
              HasSubstr("expected a column for the outlet pressure of motor 3, found none or "
                        "several that could be it among 'time', 'p1_in'"));
  EXPECT_THAT(refused([](auto& r) {
                r.antenna.campaign.instruments.reset();
                r.antenna.recorder.reset();
              }),
              HasSubstr("instruments: expected the uncertainties"));
  EXPECT_THAT(refused([](auto& r) { r.antenna.campaign.records.clear(); }),
              HasSubstr("record: expected a list of tables [[record]], found none"));
  EXPECT_THAT(refused([](auto& r) { r.text.resize(3000); }),
              HasSubstr("expected one record at least that can be used, found none: slow_ramp: "
                        "expected at least 200 samples"));
}

TEST(MakeCampaign, RefusesAMappedColumnThatNoRecordHas) {
  for (const std::string key : {"rate_command", "valve_command"}) {
    OneRecord record("full", "slow_ramp");
    auto& columns = record.antenna.campaign.columns;
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
  record.antenna.campaign.columns.reversed = {"tach", "p1_inn"};
  EXPECT_THAT(record.refusal(),
              HasSubstr("record_columns.reversed: expected a column of one record at least, found "
                        "'p1_inn' (did you mean 'p1_in'?)"));
}

TEST(MakeCampaign, SaysWhichRecordsLackAMappedColumn) {
  OneRecord record("full", "slow_ramp");
  record.antenna.campaign.records.push_back(record.antenna.campaign.records[0]);
  RecordEntry& whole = record.antenna.campaign.records[1];
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
  record.antenna.campaign.columns = {};
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
    styled.antenna.campaign.columns = {};
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
  record.antenna.campaign.columns = {};
  record.replace("valve_command [V]", "p1_in_sensor [mA]");
  record.replace("rate_command [V]", "p1_in_temperature [K]");
  record.make();
  EXPECT_EQ(record.notes.records[0].unused_columns,
            (std::vector<std::string>{"p1_in_temperature", "p1_in_sensor"}));
}

TEST(MakeCampaign, LeavesAGuessedCommandItCannotScaleOutAndSaysSo) {
  OneRecord record("full", "slow_ramp");
  record.antenna.campaign.columns = {};
  record.antenna.campaign.instruments->valve_command_scale.reset();
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
  record.antenna.campaign.columns.time.reset();
  Quantity rate;
  rate.value = 200.0;
  rate.text = "200 Hz";
  record.antenna.campaign.columns.sample_rate = rate;
  record.replace("time [s]", "counter");
  const auto after = record.make().records.at(0);
  EXPECT_NEAR(after.sample_time, 0.005, 1e-15);
  EXPECT_EQ(after.motor_rate.values, before.motor_rate.values);
  EXPECT_EQ(record.notes.records[0].unused_columns, std::vector<std::string>{"counter"});
}

TEST(MakeCampaign, RaisesUncertaintiesForADeadTransducer) {
  OneRecord record("full", "slow_ramp");
  const auto before = record.make();
  // The second column at one value from the first line on.
  std::stringstream lines(record.text);
  std::string line;
  std::getline(lines, line);
  std::string edited = line + "\n";
  while (std::getline(lines, line)) {
    const std::size_t first = line.find(',');
    edited += line.substr(0, first + 1) + "14.7" + line.substr(line.find(',', first + 1)) + "\n";
  }
  record.text = edited;
  const auto after = record.make();
  EXPECT_GT(after.instruments.pressure_gain, 1.05 * before.instruments.pressure_gain);
  EXPECT_GT(after.instruments.pressure_zero, 1.05 * before.instruments.pressure_zero);
  ASSERT_EQ(record.notes.assumptions.size(), 1U);
  EXPECT_THAT(record.notes.assumptions[0], HasSubstr("a dead pressure was replaced by the mean"));
  // What needs every pressure has the record still, but not what looks at each line on its own.
  const auto valid = [](const identification::Campaign& campaign) {
    return std::ranges::count(identification::usable_samples(campaign.records[0], 0.0), true);
  };
  EXPECT_EQ(valid(after), valid(before));
  record.antenna.campaign.records[0].test = "slosh";
  EXPECT_EQ(valid(record.make()), 0);
  record.antenna.campaign.records[0].test = "slow-ramp";
  // The sum over the motors is off by what the transducers differ by, far less than a motor's
  // share.
  const auto torque = [](const identification::Campaign& campaign) {
    return identification::recorded_torque(campaign.records[0], campaign.knowledge);
  };
  const double scale = torque(before).cwiseAbs().maxCoeff();
  EXPECT_LT((torque(after) - torque(before)).cwiseAbs().maxCoeff(), 0.1 * scale);
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
}  // namespace boresight::app
