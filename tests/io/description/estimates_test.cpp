#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/estimates.hpp>

namespace boresight::io {
namespace {

TEST(Estimates, MembersAreInTheUnitOfTheKeyAround) {
  RecordingVisitor v;
  const KeyUnit kilo{.suffix = "km", .divisor = 1000.0};
  describe_estimate(v, "length", {2000.0, 1000.0, 4000.0}, kilo, "Of a way.");
  EXPECT_EQ(v.numbers_found.at("length_km.value"), 2.0);
  EXPECT_EQ(v.numbers_found.at("length_km.lower"), 1.0);
  EXPECT_EQ(v.numbers_found.at("length_km.upper"), 4.0);
}

TEST(Estimates, DistributionsHoldTheirQuantiles) {
  design::DistributionSummary summary;
  summary.random_samples = 3;
  summary.largest = 4000.0;
  summary.quantiles = {{0.5, {1000.0, 500.0, 2000.0}}};
  RecordingVisitor v;
  describe_distribution(v, "length", summary, {.suffix = "km", .divisor = 1000.0}, "Of ways.");
  EXPECT_EQ(v.numbers_found.at("length_km.plants"), 3.0);
  EXPECT_EQ(v.numbers_found.at("length_km.largest"), 4.0);
  EXPECT_EQ(v.numbers_found.at("length_km.quantiles[0].fraction_1"), 0.5);
  EXPECT_EQ(v.numbers_found.at("length_km.quantiles[0].upper"), 2.0);
}

}  // namespace
}  // namespace boresight::io
