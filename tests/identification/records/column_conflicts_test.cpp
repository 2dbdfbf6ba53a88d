#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/swinging_record.hpp"
#include <boresight/identification/records/column_conflicts.hpp>

namespace boresight::identification {
namespace {

using namespace swinging;
using testing::HasSubstr;

using Edit = void (*)(RawRecord&);

/// So many records of which the first few are edited.
struct Records {
  Records(std::size_t count, std::size_t edited, Edit edit) {
    for (std::size_t i = 0; i < count; ++i) {
      raw.push_back(healthy());
      raw.back().name = "record " + std::to_string(i + 1);
      if (i < edited) edit(raw.back());
    }
  }
  ColumnConflicts evaluate() {
    clean.clear();
    for (const RawRecord& one : raw) clean.push_back(clean_record(one));
    std::vector<EvaluatedRecord> evaluated;
    for (std::size_t i = 0; i < raw.size(); ++i) evaluated.push_back({&raw[i], &clean[i]});
    return column_conflicts(evaluated);
  }
  std::vector<RawRecord> raw;
  std::vector<CleanRecord> clean;
};

void exchange_third(RawRecord& raw) {
  std::swap(raw.inlet[2].values, raw.outlet[2].values);
}

void exchange_all(RawRecord& raw) {
  std::swap(raw.inlet, raw.outlet);
}

void keep_two_and_exchange_one(RawRecord& raw) {
  raw.inlet.resize(2);
  raw.outlet.resize(2);
  std::swap(raw.inlet[0].values, raw.outlet[0].values);
}

void turn_tachometer(RawRecord& raw) {
  raw.tachometer.values *= -1.0;
}

void turn_command(RawRecord& raw) {
  raw.rate_command->values *= -1.0;
}

void nothing(RawRecord&) {}

TEST(ColumnConflicts, LeaveHealthyRecordsAlone) {
  const auto conflicts = Records(3, 3, nothing).evaluate();
  EXPECT_EQ(conflicts.refusal, "");
  for (const auto& one : conflicts.records) {
    EXPECT_FALSE(one.again);
    EXPECT_EQ(one.refusal, "");
  }
  EXPECT_TRUE(column_conflicts({}).records.empty());
}

TEST(ColumnConflicts, OfMostRecordsHoldForAll) {
  const auto conflicts = Records(3, 2, exchange_third).evaluate();
  EXPECT_EQ(conflicts.refusal, "");
  for (const auto& one : conflicts.records) {
    EXPECT_TRUE(one.again);
    EXPECT_EQ(one.options.exchanged_motors, std::vector<std::size_t>{2});
  }
}

TEST(ColumnConflicts, OfFewRecordsHoldForThose) {
  const auto conflicts = Records(3, 1, exchange_third).evaluate();
  EXPECT_EQ(conflicts.records[0].options.exchanged_motors, std::vector<std::size_t>{2});
  EXPECT_FALSE(conflicts.records[1].again);
  const auto turned = Records(3, 1, turn_tachometer).evaluate();
  EXPECT_EQ(turned.refusal, "");
  EXPECT_THAT(turned.records[0].refusal, HasSubstr("drives against the tachometer"));
  EXPECT_EQ(turned.records[1].refusal, "");
}

TEST(ColumnConflicts, AreRefusedWhereNobodyCanTellWhichMotorItIs) {
  const auto conflicts = Records(2, 2, keep_two_and_exchange_one).evaluate();
  EXPECT_THAT(conflicts.refusal, HasSubstr("cannot be told"));
  EXPECT_THAT(conflicts.refusal, HasSubstr("p1_in and p1_out, p2_in and p2_out"));
  EXPECT_THAT(conflicts.refusal, HasSubstr("2 of 2 records in motion, 'record 1' first"));
  EXPECT_THAT(conflicts.refusal, HasSubstr("record_columns.inlet and .outlet"));
}

TEST(ColumnConflicts, OfTorqueAndMotionAreRefusedWithTheRemedy) {
  for (const Edit edit : {turn_tachometer, exchange_all}) {
    const auto conflicts = Records(3, 3, edit).evaluate();
    EXPECT_THAT(conflicts.refusal, HasSubstr("the sign of tach is turned"));
    EXPECT_THAT(conflicts.refusal, HasSubstr("record_columns.reversed"));
  }
}

TEST(ColumnConflicts, LeaveOutACommandThatGoesAgainstTheDrive) {
  const auto conflicts = Records(3, 2, turn_command).evaluate();
  EXPECT_EQ(conflicts.refusal, "");
  for (const auto& one : conflicts.records) EXPECT_TRUE(one.options.leave_out_rate_command);
  const auto few = Records(3, 1, turn_command).evaluate();
  EXPECT_TRUE(few.records[0].options.leave_out_rate_command);
  EXPECT_FALSE(few.records[1].options.leave_out_rate_command);
}

TEST(ColumnConflicts, AreNotReadOffASloshTest) {
  Records records(3, 1, exchange_third);
  records.raw[0].test = TestKind::slosh;
  EXPECT_FALSE(records.evaluate().records[0].again);
}

}  // namespace
}  // namespace boresight::identification
