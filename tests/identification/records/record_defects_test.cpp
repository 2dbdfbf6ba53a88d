#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/swinging_record.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using namespace swinging;
using testing::HasSubstr;

TEST(CleanRecord, LeavesAHealthyRecordAsItIs) {
  const RawRecord raw = healthy();
  const CleanRecord clean = clean_record(raw);
  EXPECT_TRUE(clean.defects.empty());
  ASSERT_TRUE(clean.record);
  EXPECT_DOUBLE_EQ(clean.record->sample_time, step);
  EXPECT_EQ(clean.record->samples(), length);
  EXPECT_EQ(clean.record->motor_rate.values, raw.tachometer.values);
  EXPECT_TRUE(clean.record->motor_rate.valid.empty());
  EXPECT_EQ(clean.record->inlet_pressure[2].values, raw.inlet[2].values);
  EXPECT_EQ(clean.record->outlet_pressure[3].values, raw.outlet[3].values);
  EXPECT_EQ(clean.record->rate_command->values, raw.rate_command->values);
  EXPECT_FALSE(clean.record->valve_command);
  EXPECT_EQ(clean.record->name, "swing");
}

TEST(CleanRecord, MasksMissingSamplesAndBridgesThem) {
  RawRecord raw = healthy();
  raw.tachometer.values.segment(100, 7).setConstant(nan);
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::missing_samples);
  EXPECT_EQ(defect.channel, "tach");
  EXPECT_EQ(defect.first, 100);
  EXPECT_DOUBLE_EQ(defect.first_time, 0.5);
  EXPECT_EQ(defect.count, 7);
  EXPECT_EQ(defect.handling, DefectHandling::masked);
  const Signal& rate = clean.record->motor_rate;
  EXPECT_EQ(invalid_count(rate), 7);
  EXPECT_FALSE(rate.is_valid(103));
  EXPECT_NEAR(rate.values[103], 0.5 * (rate.values[99] + rate.values[107]), 1e-12);
}

TEST(CleanRecord, FillsFewMissingSamplesByTheCubicThroughTheirNeighbours) {
  RawRecord raw = healthy();
  // About the pressure that the record has there.
  const auto cubic = [](Eigen::Index i) {
    const double t = 0.1 * static_cast<double>(i - 498);
    return 6.51e6 + 2e3 * t * (2.0 - t * (0.7 - 0.11 * t));
  };
  Eigen::VectorXd& values = raw.inlet[1].values;
  for (Eigen::Index i = 498; i < 508; ++i) values[i] = cubic(i);
  values.segment(500, 2).setConstant(nan);
  values[504] = nan;
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::missing_samples);
  EXPECT_EQ(defect.handling, DefectHandling::bridged);
  EXPECT_EQ(defect.count, 3);
  const Signal& inlet = clean.record->inlet_pressure[1];
  EXPECT_TRUE(inlet.valid.empty() || invalid_count(inlet) == 0);
  for (const Eigen::Index i : {500, 501, 504}) {
    EXPECT_NEAR(inlet.values[i], cubic(i), 1e-6) << i;
  }
  // Lines ring too fast for it.
  raw.test = TestKind::slosh;
  EXPECT_EQ(only(clean_record(raw), DefectKind::missing_samples).handling, DefectHandling::masked);
}

TEST(CleanRecord, LeavesOutAValveCommandThatStandsStillWhileTheDriveMoves) {
  RawRecord raw = healthy();
  raw.valve_command = RawChannel{"valve_command", Eigen::VectorXd::Constant(length, 0.5)};
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::dead_channel);
  EXPECT_EQ(defect.channel, "valve_command");
  EXPECT_EQ(defect.handling, DefectHandling::left_out);
  EXPECT_FALSE(clean.record->valve_command);
  EXPECT_TRUE(clean.record->rate_command);
}

TEST(CleanRecord, MasksAStatedLimitWithAGuardBand) {
  RawRecord raw = healthy();
  raw.tachometer.upper_limit = 6.0;
  raw.tachometer.lower_limit = -6.0;
  for (double& value : raw.tachometer.values) value = std::clamp(value, -6.0, 6.0);
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::clipped);
  EXPECT_EQ(defect.channel, "tach");
  EXPECT_THAT(defect.explanation, HasSubstr("recorder's limit"));
  const Signal& rate = clean.record->motor_rate;
  EXPECT_DOUBLE_EQ(clean.record->motor_rate_limit, 6.0);
  EXPECT_GT(invalid_count(rate), defect.count);
  for (Index i = 2; i + 2 < rate.values.size(); ++i) {
    if (!rate.is_valid(i)) continue;
    for (Index k = i - 2; k <= i + 2; ++k) EXPECT_LT(std::abs(raw.tachometer.values[k]), 6.0);
  }
}

TEST(CleanRecord, FindsALimitThatNobodyStated) {
  RawRecord raw = healthy();
  for (double& value : raw.tachometer.values) value = std::clamp(value, -5.9, 6.0);
  for (double& value : raw.inlet[1].values) value = std::min(value, 7.3e6);
  const CleanRecord clean = clean_record(raw);
  const auto defects = of(clean, DefectKind::clipped);
  ASSERT_EQ(defects.size(), 2U);
  EXPECT_EQ(defects[0].channel, "p2_in");
  EXPECT_EQ(defects[1].channel, "tach");
  EXPECT_THAT(defects[1].explanation, HasSubstr("no limit is stated"));
  EXPECT_DOUBLE_EQ(clean.record->motor_rate_limit, 5.9);
  Index beyond = 0;
  for (const double value : raw.tachometer.values) beyond += value == 6.0 || value == -5.9;
  EXPECT_NEAR(static_cast<double>(defects[1].count), static_cast<double>(beyond), 20.0);
  EXPECT_EQ(clean.defects.size(), 2U);
}

TEST(CleanRecord, DoesNotTakeRestOrAQuietConverterForClipping) {
  RawRecord raw = healthy();
  // Noise-free, 12 bits, at rest first and last: long equal runs everywhere.
  for (Index i = 0; i < length; ++i) {
    const bool rest = i < 500 || i > 3500;
    raw.tachometer.values[i] =
        rest ? 0.0 : 0.005 * std::round((1.0 + rate_at(step * static_cast<double>(i))) / 0.005);
    raw.rate_command->values[i] = raw.tachometer.values[i];
  }
  const CleanRecord clean = clean_record(raw);
  EXPECT_EQ(invalid_count(clean.record->motor_rate), 0);
}

TEST(CleanRecord, MasksSpikesAndNotSteps) {
  RawRecord raw = healthy();
  raw.inlet[0].values[777] += 2e6;
  raw.tachometer.values[1500] -= 3.0;
  raw.tachometer.values[1501] -= 3.0;
  raw.outlet[2].values.tail(1000).array() += 4e5;  // a step is no spike
  const CleanRecord clean = clean_record(raw);
  const auto defects = of(clean, DefectKind::spike);
  ASSERT_EQ(defects.size(), 1U + 1U);
  EXPECT_EQ(defects[0].channel, "p1_in");
  EXPECT_EQ(defects[0].first, 777);
  EXPECT_EQ(defects[0].count, 1);
  EXPECT_EQ(defects[1].channel, "tach");
  EXPECT_EQ(defects[1].count, 2);
  EXPECT_FALSE(clean.record->inlet_pressure[0].is_valid(777));
  EXPECT_LT(clean.record->inlet_pressure[0].values[777], 7.6e6);
  EXPECT_EQ(invalid_count(clean.record->outlet_pressure[2]), 0);
}

TEST(CleanRecord, MasksAStuckStretch) {
  RawRecord raw = healthy();
  raw.inlet[3].values.segment(1000, 400).setConstant(raw.inlet[3].values[1000]);
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::stuck);
  EXPECT_EQ(defect.channel, "p4_in");
  EXPECT_EQ(defect.first, 1000);
  EXPECT_EQ(defect.count, 399);
  EXPECT_EQ(invalid_count(clean.record->inlet_pressure[3]), 399);
}

TEST(CleanRecord, ReplacesADeadPressureByTheMeanOfTheOthers) {
  for (const bool missing : {false, true}) {
    RawRecord raw = healthy();
    const RawRecord alive = raw;
    if (missing) {
      raw.outlet[1].values.setConstant(nan);
    } else {
      for (Index i = 0; i < length; ++i) raw.outlet[1].values[i] = 1e5 + 50.0 * noise(i, 30);
    }
    const CleanRecord clean = clean_record(raw);
    const auto defects = of(clean, DefectKind::dead_channel);
    ASSERT_EQ(defects.size(), 1U);
    EXPECT_EQ(defects[0].channel, "p2_out");
    EXPECT_EQ(defects[0].handling, DefectHandling::replaced);
    EXPECT_EQ(clean.replaced_outlets, std::vector<std::size_t>{1});
    EXPECT_TRUE(clean.replaced_inlets.empty());
    const Signal& signal = clean.record->outlet_pressure[1];
    EXPECT_EQ(invalid_count(signal), 0);
    const double mean =
        (alive.outlet[0].values[900] + alive.outlet[2].values[900] + alive.outlet[3].values[900]) /
        3.0;
    EXPECT_NEAR(signal.values[900], mean, 1e-6);
  }
}

TEST(CleanRecord, TakesAReplacedPressureForValidWhereTheOthersAre) {
  RawRecord raw = healthy();
  raw.outlet[1].values.setConstant(nan);
  raw.outlet[2].values[700] = 1e9;  // a spike
  const CleanRecord clean = clean_record(raw);
  const auto& outlets = clean.record->outlet_pressure;
  EXPECT_EQ(invalid_count(outlets[1]), 1);
  EXPECT_FALSE(outlets[1].is_valid(700));
  EXPECT_TRUE(outlets[0].is_valid(700));
  EXPECT_EQ(of(clean, DefectKind::spike).size(), 1U);
  // Each line on its own: nothing is known of this one.
  raw.test = TestKind::slosh;
  const CleanRecord slosh = clean_record(raw);
  EXPECT_EQ(invalid_count(slosh.record->outlet_pressure[1]), length);
  EXPECT_EQ(slosh.record->outlet_pressure[1].values, outlets[1].values);
}

TEST(CleanRecord, RefusesWithoutAnyPressureOfASide) {
  RawRecord raw = healthy();
  for (auto& channel : raw.inlet) channel.values.setConstant(nan);
  const CleanRecord clean = clean_record(raw);
  EXPECT_FALSE(clean.record);
  EXPECT_THAT(clean.refusal, HasSubstr("expected an inlet pressure of one motor at least"));
}

TEST(CleanRecord, NeedsATachometerButInASloshTest) {
  RawRecord raw = healthy();
  raw.tachometer.values.setConstant(0.0);
  EXPECT_THAT(clean_record(raw).refusal,
              HasSubstr("expected a tachometer that moves, found tach at one value throughout"));
  // Not refused while it may still be recognised as one.
  raw.test_known = false;
  EXPECT_TRUE(clean_record(raw).record);
  EXPECT_TRUE(clean_record(raw).without_rate);
  raw.test_known = true;
  raw.test = TestKind::slosh;
  const CleanRecord slosh = clean_record(raw);
  ASSERT_TRUE(slosh.record);
  EXPECT_EQ(invalid_count(slosh.record->motor_rate), length);
  EXPECT_EQ(slosh.record->motor_rate.values.norm(), 0.0);
  raw.test = TestKind::fast_ramp;
  raw.tachometer.values.setConstant(nan);
  EXPECT_THAT(clean_record(raw).refusal, HasSubstr("missing in more than half of the samples"));
}

TEST(CleanRecord, SuspectsSwappedPortsAndTurnsNothing) {
  RawRecord raw = healthy();
  std::swap(raw.inlet[2].values, raw.outlet[2].values);
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::swapped_ports);
  EXPECT_EQ(defect.channel, "p3_in");
  EXPECT_EQ(defect.handling, DefectHandling::reported);
  EXPECT_EQ(clean.suspicions.exchanged_motors, std::vector<std::size_t>{2});
  EXPECT_THAT(defect.explanation, HasSubstr("motor 3 goes against that of the others"));
  EXPECT_EQ(clean.record->inlet_pressure[2].values, raw.inlet[2].values);
}

TEST(CleanRecord, SuspectsATurnedTachometer) {
  RawRecord raw = healthy();
  raw.tachometer.values *= -1.0;
  const CleanRecord clean = clean_record(raw);
  const auto defects = of(clean, DefectKind::reversed_sign);
  ASSERT_EQ(defects.size(), 2U);  // against its command, and against the torque
  EXPECT_EQ(defects[0].channel, "command");
  EXPECT_EQ(defects[1].channel, "tach");
  EXPECT_TRUE(clean.suspicions.torque);
  EXPECT_TRUE(clean.suspicions.rate_command);
  EXPECT_EQ(clean.record->motor_rate.values, raw.tachometer.values);
}

TEST(CleanRecord, ReplacesAPressureBelowZero) {
  RawRecord raw = healthy();
  const RawRecord right = raw;
  raw.inlet[0].values *= -1.0;
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::reversed_sign);
  EXPECT_EQ(defect.channel, "p1_in");
  EXPECT_EQ(defect.handling, DefectHandling::replaced);
  EXPECT_THAT(defect.explanation, HasSubstr("record_columns.reversed"));
  EXPECT_EQ(clean.replaced_inlets, std::vector<std::size_t>{0});
  EXPECT_NEAR(clean.record->inlet_pressure[0].values[900], right.inlet[0].values[900], 5e4);
  // Of two motors on lines without pressure a zero error is no sign.
  raw = right;
  for (double& value : raw.outlet[0].values) value = -1e4 + 5e3 * std::sin(value);
  EXPECT_TRUE(of(clean_record(raw), DefectKind::reversed_sign).empty());
}

TEST(CleanRecord, LeavesOutWhatTheCampaignShowsToBeAnother) {
  RawRecord raw = healthy();
  std::swap(raw.inlet[2].values, raw.outlet[2].values);
  DefectOptions options;
  options.exchanged_motors = {2};
  options.leave_out_rate_command = true;
  const CleanRecord clean = clean_record(raw, options);
  EXPECT_EQ(clean.replaced_inlets, std::vector<std::size_t>{2});
  EXPECT_EQ(clean.replaced_outlets, std::vector<std::size_t>{2});
  EXPECT_TRUE(clean.suspicions.exchanged_motors.empty());
  EXPECT_FALSE(clean.record->rate_command);
  EXPECT_EQ(of(clean, DefectKind::swapped_ports).size(), 2U);
  const auto difference = [&](std::size_t motor) {
    return clean.record->inlet_pressure[motor].values[900] -
           clean.record->outlet_pressure[motor].values[900];
  };
  EXPECT_NEAR(difference(2), difference(0), 0.1 * std::abs(difference(0)));
}

TEST(CleanRecord, HandlesDifferentLengths) {
  RawRecord raw = healthy();
  raw.rate_command->values.conservativeResize(length - 5);
  const CleanRecord shorter = clean_record(raw);
  EXPECT_EQ(only(shorter, DefectKind::different_length).handling, DefectHandling::left_out);
  EXPECT_FALSE(shorter.record->rate_command);
  raw.inlet[1].values.conservativeResize(length - 1);
  const CleanRecord refused = clean_record(raw);
  EXPECT_THAT(refused.refusal,
              HasSubstr("expected as many samples of p2_in as of the time, 4000, found 3999"));
  EXPECT_EQ(refused.defects.back().kind, DefectKind::different_length);
}

TEST(CleanRecord, RefusesAShortRecord) {
  RawRecord raw = healthy();
  for (auto* side : {&raw.inlet, &raw.outlet}) {
    for (auto& channel : *side) channel.values.conservativeResize(150);
  }
  raw.time.conservativeResize(150);
  raw.tachometer.values.conservativeResize(150);
  raw.rate_command.reset();
  const CleanRecord clean = clean_record(raw);
  EXPECT_EQ(clean.refusal, "expected at least 200 samples, found 150");
  EXPECT_EQ(clean.defects.back().kind, DefectKind::too_short);
}

TEST(CleanRecord, RefusesARecordWithoutMotors) {
  RawRecord raw = healthy();
  raw.outlet.pop_back();
  EXPECT_THAT(reference::Call([&] { clean_record(raw); }),
              testing::ThrowsMessage<InvalidInput>(HasSubstr("clean_record: record 'swing'")));
}

TEST(CleanRecord, NamesEveryKindAndHandling) {
  for (int i = 0; i <= static_cast<int>(DefectKind::too_short); ++i) {
    EXPECT_FALSE(to_string(static_cast<DefectKind>(i)).empty());
  }
  for (int i = 0; i <= static_cast<int>(DefectHandling::refused); ++i) {
    EXPECT_FALSE(to_string(static_cast<DefectHandling>(i)).empty());
  }
}

}  // namespace
}  // namespace boresight::identification
