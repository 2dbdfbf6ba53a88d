#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/commissioning/drive_record_comparison.hpp>

namespace boresight::design {
namespace {

using identification::DriveKnowledge;
using identification::DriveRecord;
using identification::Signal;

Signal noise(double rms, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> draw(0.0, rms);
  Signal signal;
  signal.values.resize(8192);
  for (double& value : signal.values) value = draw(generator);
  return signal;
}

// A record of which everything moves by `rms`.
DriveRecord record(double rms, unsigned seed) {
  DriveRecord one;
  one.sample_time = 0.01;
  one.motor_rate = noise(rms, seed);
  one.rate_command = Signal{Eigen::VectorXd::Zero(8192), {}};
  one.valve_command = noise(rms, seed + 1);
  for (unsigned motor = 0; motor < 2; ++motor) {
    one.inlet_pressure.push_back(noise(rms, seed + 2 + motor));
    one.outlet_pressure.push_back(noise(rms, seed + 4 + motor));
  }
  return one;
}

DriveKnowledge knowledge() {
  DriveKnowledge known;
  known.displacement.value = 2.0;
  known.torque_efficiency.value = 0.9;
  return known;
}

TEST(CompareDriveRecords, FindsTheRatioOfEveryQuantity) {
  const auto compared = compare_drive_records(record(2.0, 1), record(1.0, 100), knowledge());
  std::vector<ComparedQuantity> quantities;
  for (const auto& one : compared) {
    quantities.push_back(one.quantity);
    EXPECT_EQ(one.not_compared, "");
    EXPECT_LT(one.comparison.whole.lower, 0.5);
    EXPECT_GT(one.comparison.whole.upper, 0.5);
    EXPECT_EQ(one.comparison.whole.change, Change::better);
  }
  EXPECT_THAT(quantities,
              testing::ElementsAre(ComparedQuantity::rate_error, ComparedQuantity::motor_rate,
                                   ComparedQuantity::torque, ComparedQuantity::valve_command));
}

TEST(CompareDriveRecords, LeavesOutWhatOneOfThemDoesNotHave) {
  DriveRecord lacking = record(1.0, 7);
  lacking.rate_command.reset();
  lacking.valve_command.reset();
  lacking.inlet_pressure.clear();
  const auto compared = compare_drive_records(record(1.0, 1), lacking, knowledge());
  ASSERT_EQ(compared.size(), 1U);
  EXPECT_EQ(compared[0].quantity, ComparedQuantity::motor_rate);
}

// Without an unbroken stretch in one quantity the others are still compared.
TEST(CompareDriveRecords, SaysWhatCannotBeCompared) {
  DriveRecord clipped = record(1.0, 7);
  clipped.valve_command->valid.assign(8192, false);
  const auto compared = compare_drive_records(record(1.0, 1), clipped, knowledge());
  ASSERT_EQ(compared.size(), 4U);
  EXPECT_EQ(compared[1].not_compared, "");
  EXPECT_NE(compared[3].not_compared, "");
}

CommissioningPlan plan_from(StageKind first, double before, double after) {
  const auto band = [](double value) {
    return PlantBand{value, 0.9 * value, 1.1 * value, 0.8 * value, 1.2 * value};
  };
  CommissioningPlan plan;
  plan.stages.resize(2);
  plan.stages[0].kind = first;
  plan.stages[1].kind = StageKind::position_loop;
  plan.stages[0].expected.windy_torque = band(before);
  plan.stages[1].expected.windy_torque = band(after);
  return plan;
}

TEST(PredictedRatio, IsThatOfTheLastStageOverTheGainsFound) {
  const auto plan = plan_from(StageKind::as_found, 4.0, 1.0);
  const auto ratio = predicted_ratio(plan, ComparedQuantity::torque);
  ASSERT_TRUE(ratio);
  EXPECT_DOUBLE_EQ(ratio->value, 0.25);
  EXPECT_DOUBLE_EQ(ratio->lower, 0.8 / 4.8);
  EXPECT_DOUBLE_EQ(ratio->upper, 1.2 / 3.2);
  EXPECT_FALSE(predicted_ratio(plan, ComparedQuantity::rate_error));
  EXPECT_FALSE(
      predicted_ratio(plan_from(StageKind::rate_loop, 4.0, 1.0), ComparedQuantity::torque));
  EXPECT_FALSE(
      predicted_ratio(plan_from(StageKind::as_found, INFINITY, 1.0), ComparedQuantity::torque));
  RecordComparison measured;
  measured.whole.lower = 0.3;
  measured.whole.upper = 0.5;
  EXPECT_TRUE(agrees(measured, *ratio));
  measured.whole.lower = 0.4;
  EXPECT_FALSE(agrees(measured, *ratio));
}

}  // namespace
}  // namespace boresight::design
