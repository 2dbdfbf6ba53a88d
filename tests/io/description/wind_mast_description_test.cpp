#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::io {
namespace {

TEST(WindMastDescription, HeightsAreInMetres) {
  RecordingVisitor v;
  describe(v, plant::WindMast{10.0, 40.0, 0.2, 1.32});
  EXPECT_EQ(v.numbers_found.at("height_m"), 10.0);
  EXPECT_EQ(v.numbers_found.at("dish_height_m"), 40.0);
  EXPECT_EQ(v.numbers_found.at("shear_exponent_1"), 0.2);
  EXPECT_EQ(v.numbers_found.at("speed_ratio_1"), 1.32);
}

}  // namespace
}  // namespace boresight::io
