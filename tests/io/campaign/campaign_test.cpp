#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/one_record.hpp"
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/io/campaign/loaded_campaign.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>

namespace boresight::io {
namespace {

using identification::DefectKind;
using testing::HasSubstr;

TEST(MakeCampaign, ReadsTheThreeCampaignsWithoutAFalseAlarm) {
  for (const std::string name : {"full", "paper-like", "small-dish"}) {
    CampaignNotes notes;
    const Case antenna = case_of(name);
    const auto campaign = make_campaign(antenna, notes);
    EXPECT_EQ(campaign.records.size(), antenna.campaign->records.size());
    EXPECT_TRUE(notes.assumptions.empty());
    for (std::size_t i = 0; i < notes.records.size(); ++i) {
      const RecordNotes& note = notes.records[i];
      EXPECT_EQ(note.refusal, "");
      EXPECT_FALSE(note.test_guessed);
      EXPECT_GT(note.bytes, 100000U);
      EXPECT_EQ(note.sha256.size(), 64U);
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

TEST(LoadCampaign, HoldsWhatWasRecordedAndMakesTheSameCampaign) {
  const Case antenna = case_of("small-dish");
  LoadedCampaign loaded = load_campaign(antenna, 3);
  ASSERT_EQ(loaded.records.size(), antenna.campaign->records.size());
  for (const LoadedRecord& one : loaded.records) {
    EXPECT_GT(one.raw.time.size(), 1000);
    EXPECT_TRUE(one.clean.record);
  }
  CampaignNotes notes, direct_notes;
  const auto campaign = make_campaign(antenna, std::move(loaded), notes);
  const auto direct = make_campaign(antenna, direct_notes, 1);
  EXPECT_EQ(notes.assumptions, direct_notes.assumptions);
  ASSERT_EQ(notes.records.size(), direct_notes.records.size());
  EXPECT_EQ(campaign.instruments.pressure_zero, direct.instruments.pressure_zero);
  ASSERT_EQ(campaign.records.size(), direct.records.size());
  for (std::size_t i = 0; i < campaign.records.size(); ++i) {
    EXPECT_EQ(notes.records[i].sha256, direct_notes.records[i].sha256);
    const auto& rate = campaign.records[i].motor_rate.values;
    EXPECT_TRUE((rate.array() == direct.records[i].motor_rate.values.array()).all());
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
    antenna.campaign->columns = {};
    for (auto& record : antenna.campaign->records) record.test = record.rate_loop = "";
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

TEST(MakeCampaign, TurnsOnlyTheSignsItIsTold) {
  OneRecord record("full", "slow_ramp");
  const auto before = record.make().records.at(0);
  record.antenna.campaign->columns.reversed = {"TACH"};
  EXPECT_THAT(record.refusal(), HasSubstr("case.toml: record_columns: inlet above outlet drives "
                                          "against the tachometer in 1 of 1 records in motion"));
  // With inlets and outlets exchanged beside it, all is in order but for the command.
  std::swap(record.antenna.campaign->columns.inlet, record.antenna.campaign->columns.outlet);
  const auto after = record.make().records.at(0);
  EXPECT_EQ(after.motor_rate.values, -before.motor_rate.values);
  EXPECT_EQ(after.outlet_pressure[0].values, before.inlet_pressure[0].values);
  EXPECT_TRUE(before.rate_command);
  EXPECT_FALSE(after.rate_command);
  bool said = false;
  for (const auto& defect : record.notes.records[0].defects) {
    said = said || (defect.kind == DefectKind::reversed_sign &&
                    defect.handling == identification::DefectHandling::left_out);
  }
  EXPECT_TRUE(said);
}

TEST(MakeCampaign, TakesACommandOfZerosForAnOpenLoop) {
  OneRecord record("small-dish", "fast_ramp");
  record.antenna.campaign->records[0].rate_loop = "";
  std::stringstream lines(record.text);
  std::string line;
  std::getline(lines, line);
  const auto names = line;
  std::size_t column = 0;
  for (std::size_t at = 0; (at = names.find(',', at)) != std::string::npos; ++at) {
    if (names.compare(at + 1, 12, "rate_command") == 0) break;
    ++column;
  }
  std::string edited = line + "\n";
  while (std::getline(lines, line)) {
    std::size_t at = 0;
    for (std::size_t i = 0; i <= column; ++i) at = line.find(',', at) + 1;
    const std::size_t end = std::min(line.find(',', at), line.size());
    edited += line.substr(0, at) + "0.0" + line.substr(end) + "\n";
  }
  record.text = edited;
  EXPECT_FALSE(record.make().records.at(0).rate_loop_closed);
}

TEST(MakeCampaign, LeavesAMotorOutWhosePortsAreExchanged) {
  OneRecord four("full", "slow_ramp");
  const auto before = four.make();
  std::swap(four.antenna.campaign->columns.inlet[1], four.antenna.campaign->columns.outlet[1]);
  const auto after = four.make();
  const auto torque = [](const identification::Campaign& campaign) {
    return identification::recorded_torque(campaign.records[0], campaign.knowledge);
  };
  const double scale = torque(before).cwiseAbs().maxCoeff();
  EXPECT_LT((torque(after) - torque(before)).cwiseAbs().maxCoeff(), 0.1 * scale);
  EXPECT_GT(after.instruments.pressure_zero, before.instruments.pressure_zero);
  EXPECT_GT(after.instruments.unknown_pressure_sum, 0.0);
  OneRecord two("small-dish", "constant_speed_0.14deg_s");
  std::swap(two.antenna.campaign->columns.inlet[1], two.antenna.campaign->columns.outlet[1]);
  EXPECT_THAT(two.refusal(), HasSubstr("which motors have their inlet and outlet exchanged"));
}

TEST(MakeCampaign, SaysOfEveryRecordWhyItIsOfNoUse) {
  OneRecord record("full", "slow_ramp");
  record.replace("tach [V]", "tach [V],unused [V]");
  std::stringstream lines(record.text);
  std::string line;
  std::getline(lines, line);
  std::string edited = line + "\n";
  // Before the tachometer's column a dead one, which then is it.
  while (std::getline(lines, line)) {
    std::size_t at = 0;
    for (int column = 0; column < 9; ++column) at = line.find(',', at) + 1;
    edited += line.substr(0, at) + "0.0," + line.substr(at) + "\n";
  }
  record.text = edited;
  EXPECT_THAT(record.refusal(),
              HasSubstr("found 1 that are not; slow_ramp: expected a tachometer"));
}

TEST(MakeCampaign, RecognisesASloshTestWithoutTachometer) {
  OneRecord record("full", "slosh");
  record.antenna.campaign->records[0].test = "";
  record.replace("tach [V]", "tach [V],unused [V]");
  std::stringstream lines(record.text);
  std::string line;
  std::getline(lines, line);
  std::string edited = line + "\n";
  while (std::getline(lines, line)) {
    std::size_t at = 0;
    for (int column = 0; column < 9; ++column) at = line.find(',', at) + 1;
    edited += line.substr(0, at) + "0.0," + line.substr(at) + "\n";
  }
  record.text = edited;
  EXPECT_EQ(to_string(record.make().records.at(0).test), "slosh");
}

TEST(MakeCampaign, RefusesASupplyBelowTheReturnAtItsPlace) {
  OneRecord record("full", "slow_ramp");
  record.antenna.drive->supply_pressure.value = 2e5;
  EXPECT_THAT(record.refusal(),
              HasSubstr("drive.supply_pressure: expected a supply pressure above the return"));
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
  record.antenna.campaign->records[0].test = "slosh";
  EXPECT_EQ(valid(record.make()), 0);
  record.antenna.campaign->records[0].test = "slow-ramp";
  // The sum over the motors is off by what the transducers differ by, far less than a motor's
  // share.
  const auto torque = [](const identification::Campaign& campaign) {
    return identification::recorded_torque(campaign.records[0], campaign.knowledge);
  };
  const double scale = torque(before).cwiseAbs().maxCoeff();
  EXPECT_LT((torque(after) - torque(before)).cwiseAbs().maxCoeff(), 0.1 * scale);
}

}  // namespace
}  // namespace boresight::io
