#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/swinging_record.hpp"

namespace boresight::identification {
namespace {

using namespace swinging;
using testing::HasSubstr;

TEST(CleanRecord, LeavesSamplesWithoutTimeOut) {
  RawRecord raw = healthy();
  raw.time[70] = nan;
  const CleanRecord clean = clean_record(raw);
  EXPECT_EQ(of(clean, DefectKind::missing_times).at(0).first, 70);
  EXPECT_EQ(clean.record->samples(), length);
  // As a lost line: from its neighbours.
  EXPECT_TRUE(clean.record->motor_rate.is_valid(70));
  EXPECT_NEAR(clean.record->motor_rate.values[70], rate_at(70 * step), 0.03);
  EXPECT_EQ(clean.record->motor_rate.values[71], raw.tachometer.values[71]);
}

TEST(CleanRecord, LeavesARepeatedTimeOut) {
  RawRecord raw = healthy();
  raw.time[300] = raw.time[299];
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = of(clean, DefectKind::repeated_times).at(0);
  EXPECT_EQ(defect.count, 1);
  EXPECT_NEAR(static_cast<double>(defect.first), 299.5, 0.6);
  EXPECT_EQ(defect.handling, DefectHandling::left_out);
  EXPECT_EQ(invalid_count(clean.record->motor_rate), 0);
  EXPECT_EQ(clean.record->motor_rate.values[301], raw.tachometer.values[301]);
}

TEST(CleanRecord, LeavesTimesThatRunBackOrAheadOut) {
  RawRecord raw = healthy();
  raw.time[300] = 0.1;
  raw.time[800] = 1e6;
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = of(clean, DefectKind::backward_times).at(0);
  EXPECT_EQ(defect.count, 2);
  EXPECT_EQ(defect.first, 300);
  EXPECT_EQ(invalid_count(clean.record->motor_rate), 0);
  EXPECT_EQ(clean.record->motor_rate.values[2000], raw.tachometer.values[2000]);
}

TEST(CleanRecord, RefusesTwoRecordsInOneFile) {
  RawRecord raw = healthy();
  raw.time.tail(1000).array() -= 15.0;
  const CleanRecord clean = clean_record(raw);
  EXPECT_FALSE(clean.record);
  EXPECT_THAT(clean.refusal, HasSubstr("is the file made of several records?"));
  EXPECT_EQ(clean.defects.back().handling, DefectHandling::refused);
  EXPECT_EQ(clean.defects.back().kind, DefectKind::backward_times);
}

TEST(CleanRecord, InterpolatesJitteredTimesOntoAnEvenGrid) {
  RawRecord raw = healthy();
  for (Index i = 1; i + 1 < length; ++i) {
    raw.time[i] += 0.3 * step * noise(i, 20) + 1e-7 * noise(i, 21);
  }
  const Eigen::VectorXd at = raw.time;
  for (Index i = 0; i < length; ++i) raw.tachometer.values[i] = rate_at(at[i]);
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::jitter);
  EXPECT_EQ(defect.handling, DefectHandling::resampled);
  EXPECT_GT(defect.count, length / 2);
  ASSERT_TRUE(clean.record);
  EXPECT_NEAR(clean.record->sample_time, step, 1e-9);
  double worst = 0.0;
  for (Index i = 0; i < clean.record->samples(); ++i) {
    const double t = clean.record->sample_time * static_cast<double>(i);
    worst = std::max(worst, std::abs(clean.record->motor_rate.values[i] - rate_at(t)));
  }
  // Linear interpolation: h^2/8 times the second derivative, and the steps are up to 1.3 h.
  EXPECT_LT(worst, 8.0 * std::pow(2.0 * std::numbers::pi * 0.3 * 1.3 * step, 2) / 8.0);
}

TEST(CleanRecord, TakesRoundedTimesForEven) {
  RawRecord raw = healthy();
  const double odd = 1.0 / 300.0;
  for (Index i = 0; i < length; ++i) {
    raw.time[i] = std::round(1000.0 * odd * static_cast<double>(i)) / 1000.0;
  }
  const CleanRecord clean = clean_record(raw);
  EXPECT_TRUE(clean.defects.empty());
  EXPECT_NEAR(clean.record->sample_time, odd, 1e-8);
  EXPECT_EQ(clean.record->motor_rate.values, raw.tachometer.values);
}

TEST(CleanRecord, TakesTimesOfTooFewDigitsByTheirOrder) {
  RawRecord raw = healthy();
  for (Index i = 0; i < length; ++i) {
    raw.time[i] = std::floor(step * static_cast<double>(i) * 50.0 + 1e-9) / 50.0;
  }
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::repeated_times);
  EXPECT_EQ(defect.handling, DefectHandling::resampled);
  EXPECT_THAT(defect.explanation, HasSubstr("too few digits"));
  EXPECT_NEAR(clean.record->sample_time, step, 1e-6);
  EXPECT_EQ(clean.record->motor_rate.values, raw.tachometer.values);
}

TEST(CleanRecord, RefusesTimesThatStandStill) {
  RawRecord raw = healthy();
  raw.time.setConstant(3.0);
  EXPECT_THAT(clean_record(raw).refusal, HasSubstr("expected times that rise"));
  raw.time.setConstant(nan);
  EXPECT_THAT(clean_record(raw).refusal, HasSubstr("expected at least 200 samples, found 0"));
}

TEST(CleanRecord, MasksAGap) {
  RawRecord raw = healthy();
  raw.time.tail(1000).array() += 40 * step;
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::gap);
  EXPECT_EQ(defect.first, length - 1001);
  EXPECT_EQ(defect.count, 40);
  EXPECT_EQ(clean.record->samples(), length + 40);
  EXPECT_EQ(invalid_count(clean.record->motor_rate), 40);
  EXPECT_FALSE(clean.record->inlet_pressure[0].is_valid(length - 1000 + 20));
  EXPECT_EQ(clean.record->motor_rate.values.tail(1000), raw.tachometer.values.tail(1000));
}

TEST(CleanRecord, FillsLostLinesAsMissingSamples) {
  // The same samples missing as lines and as numbers.
  const RawRecord whole = healthy();
  RawRecord numbers = whole, lines = whole;
  const auto is_lost = [](Index i) { return i % 20 == 7 || i % 300 == 8; };
  std::vector<Index> kept;
  for (Index i = 0; i < length; ++i) {
    if (!is_lost(i)) kept.push_back(i);
  }
  const auto without = [&](Eigen::VectorXd& values) {
    const Eigen::VectorXd all = values;
    values = all(kept);
  };
  without(lines.time);
  for (RawRecord* record : {&numbers, &lines}) {
    std::vector<RawChannel*> channels{&record->tachometer, &*record->rate_command};
    for (auto* side : {&record->inlet, &record->outlet}) {
      for (RawChannel& channel : *side) channels.push_back(&channel);
    }
    for (RawChannel* channel : channels) {
      if (record == &lines) {
        without(channel->values);
        continue;
      }
      for (Index i = 0; i < length; ++i) {
        if (is_lost(i)) channel->values[i] = nan;
      }
    }
  }
  const CleanRecord by_numbers = clean_record(numbers), by_lines = clean_record(lines);
  EXPECT_THAT(only(by_lines, DefectKind::gap).explanation, HasSubstr("filled"));
  ASSERT_EQ(by_lines.record->samples(), by_numbers.record->samples());
  EXPECT_EQ(invalid_count(by_lines.record->motor_rate), 0);
  EXPECT_TRUE(by_lines.record->motor_rate.values.isApprox(by_numbers.record->motor_rate.values));
  EXPECT_TRUE(by_lines.record->inlet_pressure[2].values.isApprox(
      by_numbers.record->inlet_pressure[2].values));
  // Lines of a slosh test ring too fast for it.
  lines.test = TestKind::slosh;
  EXPECT_EQ(invalid_count(clean_record(lines).record->inlet_pressure[0]),
            length - static_cast<Index>(kept.size()));
}

TEST(CleanRecord, RefusesGapsLongerThanTheRecord) {
  RawRecord raw = healthy();
  raw.time.tail(1000).array() += 1e4;
  const CleanRecord clean = clean_record(raw);
  EXPECT_THAT(clean.refusal, HasSubstr("cut the file there"));
  EXPECT_EQ(clean.defects.back().kind, DefectKind::gap);
}

TEST(CleanRecord, FindsAChangeOfTheSampleRate) {
  RawRecord raw = healthy();
  for (Index i = 0; i < length; ++i) {
    const auto slow = static_cast<double>(std::max<Index>(0, i - 3000));
    raw.time[i] = step * (static_cast<double>(i) + slow);  // 100 a second from sample 3000
    raw.tachometer.values[i] = rate_at(raw.time[i]);
  }
  const CleanRecord clean = clean_record(raw);
  const RecordDefect defect = only(clean, DefectKind::rate_change);
  EXPECT_NEAR(static_cast<double>(defect.first), 3000.0, 40.0);
  EXPECT_NEAR(static_cast<double>(defect.count), 1000.0, 40.0);
  EXPECT_DOUBLE_EQ(clean.record->sample_time, step);
  EXPECT_EQ(clean.record->samples(), length + 999);
  EXPECT_EQ(invalid_count(clean.record->motor_rate), 0);
  EXPECT_NEAR(clean.record->motor_rate.values[4500], rate_at(4500 * step), 1e-3);
}

}  // namespace
}  // namespace boresight::identification
