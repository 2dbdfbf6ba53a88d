#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/pointing_limit_results.hpp>

namespace boresight::io {
namespace {

TEST(PointingLimitResults, CostsAreInSquareMillidegrees) {
  constexpr double millidegree = key_units::millidegree_in_radians;
  design::PointingLimit limit;
  limit.bound.points = {{4.0 * millidegree * millidegree, 9.0 * millidegree * millidegree}};
  limit.min_rms = 3.0 * millidegree;
  RecordingVisitor v;
  describe(v, limit);
  EXPECT_DOUBLE_EQ(*v.numbers_found.at("bound_points[0].weight_mdeg2_s2_per_rad2"), 4.0);
  EXPECT_DOUBLE_EQ(*v.numbers_found.at("bound_points[0].cost_mdeg2"), 9.0);
  EXPECT_DOUBLE_EQ(*v.numbers_found.at("min_rms_mdeg"), 3.0);
}

TEST(PointingLimitResults, BenchmarksMayBeMissing) {
  RecordingVisitor missing, there;
  design::PointingLimit limit;
  describe(missing, limit);
  limit.robustified.emplace();
  describe(there, limit);
  EXPECT_FALSE(missing.numbers_found.contains("robustified.weights.spring_weight_1"));
  EXPECT_TRUE(there.numbers_found.contains("robustified.weights.spring_weight_1"));
}

}  // namespace
}  // namespace boresight::io
