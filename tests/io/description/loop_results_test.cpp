#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/loop_results.hpp>

namespace boresight::io {
namespace {

control::Margins some_margins() {
  control::Margins margins;
  margins.increasing_gain_margin = 2.0;
  margins.decreasing_gain_margin = 0.5;
  margins.phase_margin_deg = 60.0;
  margins.delay_margin = 0.1;
  margins.sensitivity = {2.0 * std::numbers::pi, 1.6};
  return margins;
}

TEST(LoopResults, MarginsAreInDecibelsDegreesAndSeconds) {
  RecordingVisitor v;
  describe(v, some_margins());
  EXPECT_NEAR(*v.numbers_found.at("increasing_gain_margin_dB"), 6.0206, 1e-4);
  EXPECT_NEAR(*v.numbers_found.at("decreasing_gain_margin_dB"), -6.0206, 1e-4);
  EXPECT_EQ(v.numbers_found.at("phase_margin_deg"), 60.0);
  EXPECT_EQ(v.numbers_found.at("delay_margin_s"), 0.1);
}

TEST(LoopResults, ModulusMarginIsTheInverseOfTheLargestSensitivity) {
  RecordingVisitor v;
  describe(v, some_margins());
  describe_sensitivity(v, some_margins());
  EXPECT_DOUBLE_EQ(
      *v.numbers_found.at("modulus_margin_1") * *v.numbers_found.at("sensitivity_peak_1"), 1.0);
}

TEST(LoopResults, SensitivityIsAFactorAtAFrequencyInHertz) {
  RecordingVisitor v;
  describe_sensitivity(v, some_margins());
  EXPECT_EQ(v.numbers_found.at("sensitivity_peak_1"), 1.6);
  EXPECT_DOUBLE_EQ(*v.numbers_found.at("sensitivity_peak_frequency_Hz"), 1.0);
}

TEST(LoopResults, LimitCyclesAreToldInThreeDepthsOfOneOrder) {
  const design::LimitCycleResult result;
  RecordingVisitor score, study, full;
  describe(score, result, LimitCycleDetail::score);
  describe(study, result, LimitCycleDetail::study);
  describe(full, result, LimitCycleDetail::full);
  EXPECT_THAT(score.places, testing::ElementsAre("rate_mdeg_per_s", "status", "limit_cycle",
                                                 "boresight_amplitude_mdeg", "frequency_Hz"));
  EXPECT_THAT(study.places, testing::IsSupersetOf(score.places));
  EXPECT_THAT(full.places, testing::IsSupersetOf(study.places));
  EXPECT_EQ(full.places.size(), 11U);
}

}  // namespace
}  // namespace boresight::io
