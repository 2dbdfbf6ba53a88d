#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.hpp"
#include <boresight/io/campaign/measured_record.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

const std::string folder = BORESIGHT_SOURCE_DIR "/cases/dss14-70m";

// One degree of the antenna more in each sample, in a column of that heading behind the others.
RecordNotes with_column(const ScratchFolder& place, const std::string& heading) {
  std::ifstream recorded(folder + "/records/valve-chirp.csv");
  std::ostringstream text;
  std::string line;
  std::getline(recorded, line);
  text << line << ',' << heading << '\n';
  for (int row = 0; std::getline(recorded, line); ++row) text << line << ',' << row << '\n';
  RecordNotes notes;
  notes.path = place.write("chirp.csv", text.str());
  return notes;
}

Eigen::Index samples_of(const RecordNotes& notes) {
  std::istringstream text(content_of(notes.path));
  std::string line;
  Eigen::Index lines = 0;
  while (std::getline(text, line)) ++lines;
  return lines - 1;
}

TEST(EncoderColumn, IsTheAntennasAngleAtTheMotor) {
  const ScratchFolder place;
  Case antenna = read_case(folder + "/campaign.toml");
  const RecordNotes notes = with_column(place, "Encoder position [deg]");
  const Eigen::Index samples = samples_of(notes);
  const auto column = encoder_column(antenna, notes, samples);
  ASSERT_TRUE(column && column->motor_angle);
  EXPECT_EQ(column->name, "Encoder position");
  const Eigen::VectorXd& angle = *column->motor_angle;
  ASSERT_EQ(angle.size(), samples);
  EXPECT_EQ(angle[0], 0.0);
  const double turned = 1000.0 * degree * gear_ratio(antenna);
  EXPECT_NEAR(angle[1000], turned, 1e-9 * turned);
  antenna.campaign->columns.reversed.emplace_back("encoder POSITION");
  EXPECT_EQ(*encoder_column(antenna, notes, samples)->motor_angle, -angle);
}

TEST(EncoderColumn, IsNotUsedWhereItIsNotTheRecordsAngle) {
  const ScratchFolder place;
  const Case antenna = read_case(folder + "/campaign.toml");
  const RecordNotes voltage = with_column(place, "encoder [V]");
  const auto no_angle = encoder_column(antenna, voltage, samples_of(voltage));
  ASSERT_TRUE(no_angle.has_value());
  EXPECT_FALSE(no_angle->motor_angle);
  const RecordNotes angle = with_column(place, "encoder [deg]");
  const auto cut = encoder_column(antenna, angle, samples_of(angle) - 1);
  ASSERT_TRUE(cut.has_value());
  EXPECT_FALSE(cut->motor_angle);
  const RecordNotes other = with_column(place, "resolver [deg]");
  EXPECT_FALSE(encoder_column(antenna, other, samples_of(other)).has_value());
}

TEST(RecordOfResponse, HasAValveCommandAndPressuresWithTheRateLoopOpen) {
  identification::Campaign campaign;
  identification::DriveRecord record;
  record.name = "chirp";
  record.valve_command.emplace();
  record.inlet_pressure.resize(1);
  record.outlet_pressure.resize(1);
  campaign.records = {record};
  CampaignNotes notes;
  notes.records.resize(2);
  notes.records[0].name = "chirp";
  notes.records[1].name = "slosh";
  EXPECT_EQ(&record_of_response(campaign, notes, "chirp"), campaign.records.data());

  const auto refusal = [&](const std::string& name) -> std::string {
    try {
      record_of_response(campaign, notes, name);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal("sweep"), HasSubstr("one of chirp, slosh"));
  notes.records[1].refusal = "its time runs backwards";
  EXPECT_THAT(refusal("slosh"), HasSubstr("left out: its time runs backwards"));
  campaign.records[0].rate_loop_closed = true;
  EXPECT_THAT(refusal("chirp"), HasSubstr("rate loop open"));
  campaign.records[0].outlet_pressure.clear();
  EXPECT_THAT(refusal("chirp"), HasSubstr("none of the pressures"));
  campaign.records[0].valve_command.reset();
  EXPECT_THAT(refusal("chirp"), HasSubstr("none of the valve command"));
}

}  // namespace
}  // namespace boresight::io
