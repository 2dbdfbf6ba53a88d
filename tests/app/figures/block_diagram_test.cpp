#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/app/figures/block_diagram.hpp>
#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

int count(std::string_view text, std::string_view what) {
  int found = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos;
       at = text.find(what, at + what.size())) {
    ++found;
  }
  return found;
}

Figure diagram(const char* short_name, const std::vector<std::string>& gains = {}) {
  return block_diagram("controller", "heading", control::LoopStructure::named(short_name), gains,
                       0.03);
}

TEST(BlockDiagram, HasASummingPointAndABlockForEachPathOfTheStructure) {
  // Position and rate compensator, dead time and antenna; two feedbacks.
  const std::string pi = to_svg(diagram("PI-0"));
  EXPECT_EQ(count(pi, "class=\"block\""), 4);
  EXPECT_EQ(count(pi, "class=\"sum\""), 2);
  const std::string pressure = to_svg(diagram("DPF"));
  EXPECT_EQ(count(pressure, "class=\"block\""), 5);
  EXPECT_EQ(count(pressure, "class=\"sum\""), 3);
  const std::string all = to_svg(diagram("FULL+C"));
  EXPECT_EQ(count(all, "class=\"block\""), 6);
  EXPECT_EQ(count(all, "class=\"sum\""), 4);
  EXPECT_EQ(count(all, "class=\"head\""), count(pressure, "class=\"head\"") + 3);
}

TEST(BlockDiagram, ShowsEveryGainOnce) {
  for (const char* name : {"PI-0", "PI", "DPF", "LL", "FULL", "FULL+N", "LL+C"}) {
    const auto structure = control::LoopStructure::named(name);
    std::vector<std::string> gains;
    for (std::size_t i = 0; i < structure.gains().size(); ++i) {
      gains.push_back(std::string("value ") + static_cast<char>('a' + i));
    }
    const std::string svg = to_svg(diagram(name, gains));
    for (const auto& gain : gains) EXPECT_EQ(count(svg, gain), 1) << name << " " << gain;
  }
}

TEST(BlockDiagram, ListsItsPartsWithinTheDrawing) {
  const Figure figure = diagram("FULL+C");
  ASSERT_EQ(figure.panels.size(), 1U);
  const auto& series = figure.panels.front().series;
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[1].labels.size(), 6U);
  for (const auto& one : series) {
    for (std::size_t i = 0; i < one.x.size(); ++i) {
      if (std::isnan(one.x[i])) continue;
      EXPECT_GE(one.x[i], 0.0);
      EXPECT_LE(one.x[i], figure.drawing.width);
      EXPECT_LE(one.y[i], 0.0);
      EXPECT_GE(one.y[i], -figure.drawing.height);
    }
  }
}

TEST(BlockDiagram, SignalsRunStraightAlongTheAxes) {
  const Figure figure = diagram("FULL+C");
  const auto& x = figure.panels.front().series.front().x;
  const auto& y = figure.panels.front().series.front().y;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (std::isnan(x[i]) || std::isnan(x[i - 1])) continue;
    EXPECT_TRUE(x[i] == x[i - 1] || y[i] == y[i - 1]) << i;
  }
}

TEST(BlockDiagram, RefusesAnotherNumberOfGainsThanTheStructureHas) {
  EXPECT_THROW(diagram("PI", {"1"}), InvalidInput);
}

}  // namespace
}  // namespace boresight::app
