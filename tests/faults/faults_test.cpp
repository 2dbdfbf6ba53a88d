#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fault_case.hpp"
#include "fault_table.hpp"
#include "recorder_fault.hpp"
#include <boresight/numerics/error.hpp>

namespace boresight::faults {
namespace {

constexpr std::uint64_t seed = 1;

const Recorded& campaign() {
  static const Recorded one = recorded_campaign(seed, 2, {});
  return one;
}

RecorderFault fault_named(const std::string& name) {
  const auto faults = recorder_faults({name});
  const auto found = std::ranges::find(faults, name, &RecorderFault::name);
  if (found == faults.end()) throw InvalidInput("no fault " + name);
  return *found;
}

FaultCase with(const std::string& name) {
  return fault_case(fault_named(name), campaign(), seed, {});
}

TEST(RecorderFaults, AreAtLeastSixtyOfNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const RecorderFault& fault : recorder_faults()) names.insert(fault.name);
  EXPECT_EQ(names.size(), recorder_faults().size());
  EXPECT_GT(names.size(), 60U);
}

TEST(RecorderFaults, ChangeTheCampaign) {
  const auto& before = campaign().campaign;
  const auto same = [](const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
    if (one.size() != other.size()) return false;
    for (Eigen::Index i = 0; i < one.size(); ++i) {
      if (one[i] != other[i] && !(std::isnan(one[i]) && std::isnan(other[i]))) return false;
    }
    return true;
  };
  for (const RecorderFault& fault : recorder_faults()) {
    if (fault.kind == "none" || fault.kind == "case" || fault.kind == "wrong header") continue;
    RecordedCampaign after = before;
    reference::RandomNumbers random(1);
    fault.apply(after, random);
    bool changed = false;
    for (std::size_t i = 0; i < after.records.size(); ++i) {
      const auto& one = before.records[i];
      const auto& other = after.records[i];
      changed = changed || !same(one.time, other.time) ||
                !same(one.tachometer.values, other.tachometer.values) ||
                !same(one.inlet[0].values, other.inlet[0].values) ||
                !same(one.outlet[0].values, other.outlet[0].values) ||
                !same(one.rate_command->values, other.rate_command->values) ||
                !same(one.valve_command->values, other.valve_command->values) ||
                !same(one.encoder->values, other.encoder->values);
    }
    EXPECT_TRUE(changed) << fault.name;
  }
}

TEST(RecorderFaults, RefuseAWordThatNoneBeginsWith) {
  EXPECT_THROW(recorder_faults({"gremlins"}), InvalidInput);
}

TEST(FaultCase, NamesNothingInACampaignWithoutFault) {
  const FaultCase found = with("none");
  EXPECT_EQ(found.outcome, Outcome::right);
  EXPECT_THAT(found.findings, testing::IsEmpty());
}

TEST(FaultCase, IsFlaggedWhereTheFaultyChannelIsNamed) {
  for (const char* name : {"tachometer x 1.05", "inlet 1 x 0.9"}) {
    const FaultCase found = with(name);
    EXPECT_EQ(found.outcome, Outcome::flagged) << name;
    EXPECT_TRUE(found.named) << name;
  }
}

TEST(FaultCase, IsRefusedWhereTheRecordsCannotBeUsed) {
  const FaultCase found = with("all pressures x 10");
  EXPECT_TRUE(found.outcome == Outcome::refused || found.outcome == Outcome::flagged);
  EXPECT_FALSE(found.inertia);
}

TEST(FaultCase, IsRightWhereSamplesAreMissing) {
  EXPECT_EQ(with("all columns 0.05 at random").outcome, Outcome::right);
}

TEST(FaultTable, CountsEachCaseOnce) {
  FaultCase one;
  one.kind = "gain";
  one.fault = "a";
  one.outcome = Outcome::flagged;
  one.rejection = "channels contradict one another";
  FaultCase other = one;
  other.outcome = Outcome::silently_wrong;
  other.rejection.clear();
  other.error = -0.04;
  FaultCase third = other;
  third.fault = "b";
  const auto rows = fault_rows({one, other, third});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].campaigns, 2U);
  EXPECT_EQ(rows[0].of(Outcome::flagged), 1U);
  EXPECT_EQ(rows[0].of(Outcome::silently_wrong), 1U);
  EXPECT_EQ(rows[1].of(Outcome::silently_wrong), 1U);
  EXPECT_DOUBLE_EQ(rows[0].largest_error, 0.04);
}

}  // namespace
}  // namespace boresight::faults
