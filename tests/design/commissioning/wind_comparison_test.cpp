#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/simulated_pairs.hpp"
#include "refused_call.hpp"
#include <boresight/design/commissioning/wind_comparison.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using identification::Signal;

// Noise through first-order lags: error and wind of a mast that measures the very wind.
WindyRecord record_of(double speed, double gain, std::uint64_t seed, double own_noise = 0.0) {
  constexpr Eigen::Index samples = 3000;
  const numerics::NormalNumbers numbers(seed);
  WindyRecord record{"record " + std::to_string(seed), 0.2, {}, {}, {}};
  record.error.values.resize(samples);
  record.wind_speed.values.resize(samples);
  double gust = 0.0, error = 0.0;
  for (Eigen::Index k = 0; k < samples; ++k) {
    const auto pair = numbers.pair(static_cast<std::uint64_t>(k));
    gust += 0.05 * (pair.real() - gust);
    const double wind = speed * (1.0 + 0.8 * gust);
    error += 0.1 * (wind * wind - error);
    record.wind_speed.values[k] = wind;
    record.error.values[k] = gain * (error - speed * speed) + own_noise * pair.imag();
  }
  return record;
}

std::vector<WindyRecord> records_of(double gain, double slowest, std::uint64_t seed,
                                    int count = 8) {
  std::vector<WindyRecord> records;
  for (int i = 0; i < count; ++i) {
    records.push_back(record_of(slowest + 0.6 * i, gain, seed + static_cast<std::uint64_t>(i)));
  }
  return records;
}

std::string refused(const reference::Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "taken";
}

TEST(CompareInWind, FindsTheRatioOfTwoGainsAtEqualWind) {
  const auto result = compare_in_wind(records_of(1e-5, 5.0, 1), records_of(0.6e-5, 7.0, 100));
  EXPECT_EQ(result.kind, WindComparisonKind::regression);
  ASSERT_TRUE(result.at_reference && result.by_coherence);
  EXPECT_LT(result.at_reference->ratio.lower, 0.6);
  EXPECT_GT(result.at_reference->ratio.upper, 0.6);
  EXPECT_LT(result.at_reference->ratio.upper, 0.8);
  EXPECT_EQ(result.at_reference->change, Change::better);
  EXPECT_FALSE(result.at_reference->before_extrapolated);
  // The wind explains all of the error but what the squares fold together and short segments hide.
  EXPECT_NEAR(result.by_coherence->value, 0.6, 0.01);
  EXPECT_GT(result.before.explained, 0.9);
  EXPECT_LT(result.before.explained_threshold, 0.05);
}

TEST(CompareInWind, DoesNotDependOnUnitOrOrderAndInvertsWithTheSides) {
  auto before = records_of(1e-5, 5.0, 1);
  auto after = records_of(0.6e-5, 7.0, 100);
  const auto first = compare_in_wind(before, after);
  const auto swapped = compare_in_wind(after, before);
  EXPECT_NEAR(first.at_reference->ratio.value * swapped.at_reference->ratio.value, 1.0, 1e-6);
  EXPECT_NEAR(first.at_reference->ratio.lower * swapped.at_reference->ratio.upper, 1.0, 1e-6);
  EXPECT_NEAR(first.by_coherence->lower * swapped.by_coherence->upper, 1.0, 1e-9);
  EXPECT_EQ(swapped.at_reference->change, Change::worse);
  std::ranges::reverse(before);
  std::ranges::reverse(after);
  for (auto* records : {&before, &after}) {
    for (WindyRecord& record : *records) record.error.values *= 3600.0;
  }
  const auto scaled = compare_in_wind(before, after);
  EXPECT_NEAR(scaled.at_reference->ratio.value, first.at_reference->ratio.value, 1e-6);
  EXPECT_NEAR(scaled.at_reference->before.value, 3600.0 * first.at_reference->before.value,
              3600.0 * 1e-6 * first.at_reference->before.value);
  EXPECT_NEAR(scaled.by_coherence->upper, first.by_coherence->upper, 1e-9);
}

TEST(CompareInWind, FindsNoCoherenceWithAWindThatHasNone) {
  auto before = records_of(1e-5, 5.0, 1);
  auto after = records_of(0.6e-5, 5.0, 100);
  for (std::size_t i = 0; i < before.size(); ++i) {
    before[i].wind_speed = record_of(5.0 + 0.6 * static_cast<double>(i), 0.0, 500 + i).wind_speed;
  }
  const auto result = compare_in_wind(before, after);
  EXPECT_LT(result.before.explained, 2.0 * result.before.explained_threshold);
  EXPECT_GT(result.after.explained, 0.9);
  ASSERT_TRUE(result.at_reference);
  EXPECT_EQ(result.at_reference->change, Change::better);
}

TEST(CompareInWind, ComparesOnlyWhereBothConditionsHaveWind) {
  const auto result = compare_in_wind(records_of(1e-5, 3.0, 1), records_of(1e-5, 9.0, 100));
  EXPECT_EQ(result.kind, WindComparisonKind::no_overlap);
  EXPECT_FALSE(result.at_reference);
  EXPECT_FALSE(result.at_design);
  const auto extrapolated =
      compare_in_wind(records_of(1e-5, 5.0, 1), records_of(1e-5, 7.0, 100), {.design_speed = 10.0});
  ASSERT_TRUE(extrapolated.at_design);
  EXPECT_TRUE(extrapolated.at_design->before_extrapolated);
  EXPECT_FALSE(extrapolated.at_design->after_extrapolated);
  const auto width = [](const RatioBand& ratio) { return ratio.upper / ratio.lower; };
  EXPECT_GT(width(extrapolated.at_design->ratio), width(extrapolated.at_reference->ratio));
}

TEST(CompareInWind, ComparesFewRecordsOnlyInEqualWind) {
  const std::vector before{record_of(8.0, 1e-5, 1), record_of(8.3, 1e-5, 2)};
  const auto equal = compare_in_wind(before, {record_of(7.9, 0.4e-5, 3)});
  EXPECT_EQ(equal.kind, WindComparisonKind::equal_wind);
  ASSERT_TRUE(equal.at_reference);
  EXPECT_EQ(equal.at_reference->change, Change::better);
  EXPECT_LT(equal.at_reference->ratio.lower, 0.4);
  EXPECT_GT(equal.at_reference->ratio.upper, 0.4);
  const auto different = compare_in_wind(before, {record_of(10.0, 0.4e-5, 3)});
  EXPECT_EQ(different.kind, WindComparisonKind::too_few_records);
  EXPECT_FALSE(different.at_reference);
}

TEST(CompareInWind, ReportsTheDirectionsOfTheWind) {
  auto before = records_of(1e-5, 5.0, 1, 3);
  auto after = records_of(1e-5, 5.0, 100, 3);
  const auto turn = [](std::vector<WindyRecord>& records, double angle) {
    for (WindyRecord& record : records) {
      record.wind_direction =
          Signal{Eigen::VectorXd::Constant(record.error.values.size(), angle), {}};
    }
  };
  turn(before, 350.0 * degree);
  before[0].wind_direction->values.setConstant(10.0 * degree);
  before[1].wind_direction->values.setConstant(0.0);
  turn(after, 20.0 * degree);
  const auto near = compare_in_wind(before, after);
  ASSERT_TRUE(near.before.wind_direction && near.after.wind_direction);
  EXPECT_NEAR(std::remainder(*near.before.wind_direction, two_pi), 0.0, 1e-9);
  EXPECT_FALSE(near.directions_differ);
  turn(after, 40.0 * degree);
  EXPECT_TRUE(compare_in_wind(before, after).directions_differ);
}

TEST(CompareInWind, LeavesOutInvalidSamples) {
  auto before = records_of(1e-5, 5.0, 1, 4);
  const auto after = records_of(1e-5, 5.0, 100, 4);
  before[0].error.values[1500] = 1.0;
  before[0].error.valid.assign(3000, true);
  before[0].error.valid[1500] = false;
  const auto result = compare_in_wind(before, after);
  EXPECT_LT(result.before.records[0].rms, 2.0 * result.before.records[1].rms);
}

TEST(CompareInWind, RefusesRecordsItCannotUse) {
  const auto good = records_of(1e-5, 5.0, 1, 3);
  const auto refusal = [&](auto edit) {
    auto edited = good;
    edit(edited[1]);
    return refused([&] { compare_in_wind(good, edited); });
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal([](WindyRecord& one) { one.error.values.setConstant(1e-5); }),
              HasSubstr("expected an error that varies, found none in the record 'record 2'"));
  EXPECT_THAT(refusal([](WindyRecord& one) { one.wind_speed.values.setZero(); }),
              HasSubstr("expected a positive mean wind speed"));
  EXPECT_THAT(refusal([](WindyRecord& one) { one.wind_speed.values.conservativeResize(2000); }),
              HasSubstr("expected 3000 samples of the wind speed, found 2000"));
  EXPECT_THAT(refusal([](WindyRecord& one) { one.error.valid.assign(3000, false); }),
              HasSubstr("of valid samples at a stretch, found none"));
  EXPECT_THAT(refusal([](WindyRecord& one) { one.error.values[3] = std::nan(""); }),
              HasSubstr("expected a finite error"));
  EXPECT_THAT(refused([&] { compare_in_wind(good, {}); }), HasSubstr("found none after"));
  EXPECT_THAT(refused([&] { compare_in_wind(good, good, {.confidence = 1.0}); }),
              HasSubstr("expected a confidence within (0, 1)"));
}

// The whole count, of 100 repetitions, is in tests/statistical.
TEST(CompareInWind, IsRightOfSimulatedPairsInDifferentWinds) {
  reference::SimulatedPairs pairs;
  const auto counted = pairs.count(8);
  EXPECT_EQ(counted.better, 8);
  EXPECT_LT(std::abs(counted.log_error), 0.08);  // of a logarithm near -1
  EXPECT_LE(counted.change_without_change, 2);
}

}  // namespace
}  // namespace boresight::design
