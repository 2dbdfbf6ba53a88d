#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/one_record.hpp"
#include <boresight/io/records/csv_table.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/records/record_mat_writer.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

double degrees(int row) {
  return 359.9 + 0.001 * row;
}

// A record with a further column.
OneRecord with_column(const std::string& header, const std::function<std::string(int)>& value) {
  OneRecord record("small-dish", "slow_ramp");
  std::stringstream lines(record.text);
  std::string line, edited;
  for (int row = -1; std::getline(lines, line); ++row) {
    edited += line + "," + (row < 0 ? header : value(row)) + "\n";
  }
  record.text = edited;
  return record;
}

OneRecord with_encoder(const std::string& header) {
  return with_column(header,
                     [](int row) { return std::to_string(std::fmod(degrees(row), 360.0)); });
}

void expect_continuous(const identification::DriveRecord& record) {
  ASSERT_TRUE(record.encoder);
  EXPECT_EQ(record.encoder->values.size(), record.samples());
  for (const Eigen::Index row : {Eigen::Index{0}, Eigen::Index{2000}, record.samples() - 1}) {
    EXPECT_NEAR(record.encoder->values(row) - record.encoder->values(0),
                0.001 * degree * static_cast<double>(row), 1e-7);
  }
}

TEST(CampaignEncoder, IsInferredByTheWordsOfServoRecordsAndContinuous) {
  for (const char* header : {"Encoder [deg]", "AZ encoder [deg]", "enc [deg]"}) {
    OneRecord record = with_encoder(header);
    const auto made = record.make().records.at(0);
    expect_continuous(made);
    EXPECT_TRUE(record.notes.records[0].sources.back().guessed) << header;
    EXPECT_EQ(record.notes.records[0].sources.back().signal, "encoder") << header;
  }
}

TEST(CampaignEncoder, IsNotInferredFromAnotherAxisCommandOrKind) {
  for (const char* header :
       {"el encoder [deg]", "position command [deg]", "encoder [V]", "position error [deg]",
        "wind angle [deg]", "AZ position [deg]", "motor encoder [deg]"}) {
    OneRecord record = with_encoder(header);
    EXPECT_FALSE(record.make().records.at(0).encoder) << header;
    EXPECT_EQ(record.notes.records[0].unused_columns.size(), 1U) << header;
  }
}

TEST(CampaignEncoder, LeavesAllElseAsWithoutOne) {
  OneRecord plain("small-dish", "slow_ramp");
  const auto before = plain.make();
  const auto after = with_encoder("encoder [deg]").make();
  EXPECT_FALSE(before.records[0].encoder);
  EXPECT_EQ(after.records[0].motor_rate.values, before.records[0].motor_rate.values);
  EXPECT_EQ(after.records[0].inlet_pressure[0].values, before.records[0].inlet_pressure[0].values);
}

TEST(CampaignEncoder, IsNamedInTheCaseWithItsUnit) {
  OneRecord record = with_encoder("resolver");
  record.antenna.campaign->columns.encoder =
      ColumnEntry{"resolver", "deg", {}, "record_columns.encoder"};
  expect_continuous(record.make().records.at(0));
  record.antenna.campaign->columns.encoder->unit = "V";
  EXPECT_THAT(record.refusal(), HasSubstr("expected an angle at the sky in column 'resolver'"));
  record.antenna.campaign->columns.encoder->name = "resolvers";
  EXPECT_THAT(record.refusal(), HasSubstr("record_columns.encoder: expected a column of one record "
                                          "at least, found 'resolvers'"));
}

TEST(CampaignEncoder, HasItsMissingSamplesMaskedAndIsOmittedWhereItStandsStill) {
  const auto made = with_column("encoder [deg]",
                                [](int row) {
                                  return row >= 500 && row < 600 ? "" : std::to_string(0.001 * row);
                                })
                        .make()
                        .records.at(0);
  ASSERT_TRUE(made.encoder);
  EXPECT_FALSE(made.encoder->is_valid(550));
  EXPECT_TRUE(made.encoder->is_valid(700));
  EXPECT_TRUE(made.motor_rate.is_valid(550));
  OneRecord still = with_column("encoder [deg]", [](int) { return std::string("12.5"); });
  EXPECT_FALSE(still.make().records.at(0).encoder);
  EXPECT_EQ(still.notes.records[0].defects.back().channel, "encoder");
}

TEST(CampaignEncoder, IsReadFromMat) {
  OneRecord record = with_encoder("encoder [deg]");
  std::ofstream(record.path) << record.text;
  const RecordTable table = read_record(record.path);
  CsvTable mat;
  for (const RecordColumn& column : table.columns) {
    mat.columns.push_back(
        {column.name, column.unit, 6,
         Eigen::Map<const Eigen::VectorXd>(column.values.data(), std::ssize(column.values))});
  }
  record.text = to_mat(mat);
  expect_continuous(record.make().records.at(0));
  EXPECT_THAT(record.notes.records[0].format, HasSubstr("MAT"));
}

}  // namespace
}  // namespace boresight::io
