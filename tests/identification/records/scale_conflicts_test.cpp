#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/identification/records/scale_conflicts.hpp>

namespace boresight::identification {
namespace {

using Channel = ScaleConflict::Channel;

/// Records whose rate is a fraction of both commands, a smaller one in some than in others.
std::vector<DriveRecord> records() {
  std::vector<DriveRecord> all;
  for (const double fraction : {0.6, 0.8, 0.9, 1.0}) {
    DriveRecord record;
    record.name = "record " + std::to_string(all.size() + 1);
    record.test = TestKind::constant_speed;
    record.sample_time = 0.01;
    const Eigen::VectorXd command =
        5.0 * Eigen::VectorXd::LinSpaced(400, 0.0, 20.0).array().sin().matrix();
    record.rate_command = Signal{command, {}};
    record.valve_command = Signal{1.3 * command, {}};
    record.motor_rate = {fraction * command, {}};
    all.push_back(std::move(record));
  }
  return all;
}

std::vector<ScaleConflict> conflicts_of(const std::vector<DriveRecord>& all) {
  std::vector<const DriveRecord*> list;
  list.reserve(all.size());
  for (const auto& record : all) list.push_back(&record);
  return scale_conflicts(list);
}

TEST(ScaleConflicts, AreNoneWhereLossesAloneDiffer) {
  EXPECT_TRUE(conflicts_of(records()).empty());
  EXPECT_TRUE(scale_conflicts({nullptr, nullptr, nullptr}).empty());
}

TEST(ScaleConflicts, NameTheTachometerWhereBothCommandsAreOff) {
  auto all = records();
  all[1].motor_rate.values *= 10.0;
  const auto found = conflicts_of(all);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].record, 1U);
  EXPECT_EQ(found[0].channel, Channel::tachometer);
  EXPECT_NEAR(found[0].factor, 8.0 / 0.9, 1e-9);  // of the other records' median
}

TEST(ScaleConflicts, NameTheCommandWhereOneOfTwoIsOff) {
  auto all = records();
  all[2].valve_command->values *= 0.1;
  const auto found = conflicts_of(all);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].record, 2U);
  EXPECT_EQ(found[0].channel, Channel::valve_command);
  EXPECT_NEAR(found[0].factor, 0.1 * 0.8 / 0.9, 1e-9);
}

// Under friction's load leakage takes as much valve command at any rate.
TEST(ScaleConflicts, TakeLeakageOfASlowRecordForNoScale) {
  auto all = records();
  for (Signal* signal : {&all[0].motor_rate, &*all[0].rate_command}) signal->values *= 0.05;
  all[0].valve_command->values *= 0.05 * 4.0;
  EXPECT_TRUE(conflicts_of(all).empty());
  all[0].valve_command->values *= 2.5;
  auto found = conflicts_of(all);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].channel, Channel::valve_command);
  // A valve command that is too small is no leakage's.
  all[0].valve_command->values *= 0.01;
  found = conflicts_of(all);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].channel, Channel::valve_command);
}

// Though it makes its own record slow.
TEST(ScaleConflicts, NameTheTachometerOfASlowRecordByBothCommands) {
  auto all = records();
  for (Signal* signal : {&all[0].motor_rate, &*all[0].rate_command, &*all[0].valve_command}) {
    signal->values *= 0.3;
  }
  all[0].motor_rate.values *= 0.2;
  const auto found = conflicts_of(all);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].channel, Channel::tachometer);
}

TEST(ScaleConflicts, TakeValidSamplesAlone) {
  auto all = records();
  all[1].motor_rate.values.head(100) *= 100.0;
  all[1].motor_rate.valid.assign(400, true);
  std::fill_n(all[1].motor_rate.valid.begin(), 100, false);
  EXPECT_TRUE(conflicts_of(all).empty());
}

TEST(ScaleConflicts, TakeThreeRecordsWithACommandToTell) {
  auto all = records();
  all.resize(2);
  all[1].motor_rate.values *= 10.0;
  EXPECT_TRUE(conflicts_of(all).empty());
  all = records();
  all[1].motor_rate.values *= 10.0;
  all[1].test = TestKind::slosh;
  EXPECT_TRUE(conflicts_of(all).empty());
}

}  // namespace
}  // namespace boresight::identification
