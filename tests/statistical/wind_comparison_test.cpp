#include <cmath>

#include <gtest/gtest.h>

#include "design/commissioning/simulated_pairs.hpp"

namespace boresight::design {
namespace {

TEST(CompareInWind, IsRightIn90Of100PairsOf20RecordsInDifferentWinds) {
  reference::SimulatedPairs pairs;
  const auto counted = pairs.count(100);
  RecordProperty("better", counted.better);
  RecordProperty("held", counted.held);
  RecordProperty("change_without_change", counted.change_without_change);
  EXPECT_GE(counted.better, 90);
  EXPECT_LE(counted.change_without_change, 10);
  // The 95 % interval holds the ratio that the linear loops have at that speed.
  EXPECT_GE(counted.held, 88);
  // Of the logarithm of the ratio, which is -1: an interval that holds it by being wide is of no
  // use.
  EXPECT_LT(std::abs(counted.log_error), 0.03);
  EXPECT_LT(counted.half_width, 0.12);
}

}  // namespace
}  // namespace boresight::design
