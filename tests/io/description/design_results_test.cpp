#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/design_results.hpp>

namespace boresight::io {
namespace {

TEST(DesignResults, ModesHaveTheirPoleInRadiansPerSecond) {
  plant::PlantMode mode;
  mode.pole = {-1.0, 5.0};
  mode.frequency = 0.8;
  RecordingVisitor v;
  describe(v, mode);
  EXPECT_EQ(v.numbers_found.at("pole_real_rad_per_s"), -1.0);
  EXPECT_EQ(v.numbers_found.at("pole_imaginary_rad_per_s"), 5.0);
  EXPECT_EQ(v.numbers_found.at("frequency_Hz"), 0.8);
}

TEST(DesignResults, EnsemblesNameTheirWorstMember) {
  design::EnsembleResult ensemble;
  ensemble.members = {{.name = "stiff"}, {.name = "soft"}};
  ensemble.worst = 1;
  ensemble.largest_rms = key_units::millidegree_in_radians;
  RecordingVisitor v;
  describe(v, ensemble);
  EXPECT_EQ(v.texts_found.at("worst"), "soft");
  EXPECT_DOUBLE_EQ(*v.numbers_found.at("largest_boresight_rms_mdeg"), 1.0);
  EXPECT_EQ(v.texts_found.at("members[0].name"), "stiff");
}

TEST(DesignResults, DesignsHaveMarginsAtEveryBreak) {
  design::Design design;
  design.margins[2].increasing_gain_margin = 10.0;
  RecordingVisitor v;
  describe(v, design);
  EXPECT_DOUBLE_EQ(*v.numbers_found.at("loop_breaks[2].margins.increasing_gain_margin_dB"), 20.0);
  EXPECT_EQ(v.texts_found.at("loop_breaks[2].loop_break"), "position loop");
}

}  // namespace
}  // namespace boresight::io
