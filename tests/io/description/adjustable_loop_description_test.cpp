#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "io/description/recording_visitor.hpp"
#include <boresight/io/description/adjustable_loop_description.hpp>

namespace boresight::io {
namespace {

design::AdjustableLoop some_loop() {
  return {"PI", reference::cautious_gains(), reference::tracking_problem(), {}};
}

TEST(AdjustableLoopDescription, NumbersAreInTheUnitsThatTheyAreComputedIn) {
  const auto loop = some_loop();
  RecordingVisitor v;
  describe(v, loop);
  const auto& plant = loop.problem.plant;
  EXPECT_EQ(v.numbers_found.at("drive.oil_stiffness_N_m_per_rad"), plant.drive.oil_stiffness);
  EXPECT_EQ(v.numbers_found.at("drive.valve_corner_rad_per_s"), plant.drive.valve_corner);
  EXPECT_EQ(v.numbers_found.at("antenna.modes[1].damping_N_m_s_per_rad"),
            plant.structure.modes[1].damping);
  EXPECT_EQ(v.numbers_found.at("noise.encoder_rad"), loop.problem.noise.encoder_rms);
  EXPECT_EQ(v.numbers_found.at("dead_time_s"), loop.problem.delay);
}

TEST(AdjustableLoopDescription, EachBlockHasItsOwnGains) {
  const auto loop = some_loop();
  RecordingVisitor v;
  describe(v, loop);
  const auto& blocks = loop.controller.structure.blocks();
  ASSERT_EQ(blocks.size(), loop.controller.gains.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::string place = "blocks[" + std::to_string(i) + "].";
    EXPECT_EQ(v.texts_found.at(place + "path"), control::to_string(blocks[i].path));
    EXPECT_EQ(v.texts_found.at(place + "kind"), control::to_string(blocks[i].kind));
    EXPECT_EQ(v.texts_found.at(place + "gains[0].symbol"), blocks[i].gains[0].symbol);
    EXPECT_EQ(v.numbers_found.at(place + "gains[0].value"), loop.controller.gains[i]);
  }
}

TEST(AdjustableLoopDescription, SiteWithoutGustsOfItsOwnHasDavenports) {
  const auto loop = some_loop();
  RecordingVisitor v;
  describe(v, loop);
  EXPECT_EQ(v.texts_found.at("wind.gusts.kind"), "davenport");
  EXPECT_EQ(v.numbers_found.at("wind.gusts.surface_drag_1"), loop.problem.wind.site.surface_drag);
}

TEST(AdjustableLoopDescription, ALoopByDefaultCanBeDescribed) {
  RecordingVisitor v(true);
  describe(v, design::AdjustableLoop{});
  EXPECT_TRUE(v.numbers_found.contains("limits.control_effort_rad_per_s"));
}

}  // namespace
}  // namespace boresight::io
