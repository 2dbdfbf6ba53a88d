#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/interval_results.hpp>

namespace boresight::io {
namespace {

TEST(IntervalResults, NumbersAreInTheUnitBesideThem) {
  RecordingVisitor v;
  describe_interval(v, "stiffness", numerics::Interval{2.0, 0.5, 1.0, 3.0}, "N m/rad", "Of it.");
  EXPECT_EQ(v.texts_found.at("stiffness.unit"), "N m/rad");
  EXPECT_EQ(v.numbers_found.at("stiffness.value_si"), 2.0);
  EXPECT_EQ(v.numbers_found.at("stiffness.standard_uncertainty_si"), 0.5);
  EXPECT_EQ(v.numbers_found.at("stiffness.lower_95_si"), 1.0);
  EXPECT_EQ(v.numbers_found.at("stiffness.upper_95_si"), 3.0);
}

TEST(IntervalResults, PlainNumbersHaveTheUnitOne) {
  RecordingVisitor v;
  describe_interval(v, "ratio", numerics::Interval{}, "", "Of it.");
  EXPECT_EQ(v.texts_found.at("ratio.unit"), "1");
}

}  // namespace
}  // namespace boresight::io
