#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/control/loops/adaptive_panels.hpp>

namespace boresight::control {
namespace {

constexpr double pole = 0.3;  // ln w

// Panels from -1 to 1, halved until they are narrow against their distance from the pole.
struct Search {
  AdaptivePanels panels;
  std::vector<std::uint32_t> leaves;
  int made = 0, evaluated = 0;

  Search() {
    for (const FrequencyPanel& panel : panels_between({-1.0, 1.0, 0.2}, 0.5)) {
      panels.add(panel.from, panel.to);
      panels.start_from_last();
    }
  }
  void run(double narrowest) {
    panels.choose(
        leaves,
        [&](double from, double to) {
          panels.add(from, to);
          ++made;
        },
        [&](const std::uint32_t*, std::size_t count) { evaluated += static_cast<int>(count); },
        [&](std::uint32_t i) {
          const FrequencyPanel& panel = panels[i];
          return panel.half_width() < narrowest ||
                 panel.half_width() < std::abs(panel.centre() - pole);
        });
  }
};

TEST(AdaptivePanels, CutTheBandAtItsEdgesIntoPanelsOfAtMostTheWidth) {
  const auto places = places_within(0.1, 10.0, {0.1, 1.0, 10.0, 20.0, 0.01});
  ASSERT_EQ(places.size(), 3U);
  EXPECT_DOUBLE_EQ(places[1], std::log(2.0 * std::numbers::pi));
  const auto panels = panels_between({1.0, 0.0, 1.0 + 1e-9, 2.5}, 0.5);
  ASSERT_EQ(panels.size(), 5U);
  EXPECT_EQ(panels.front().from, 0.0);
  EXPECT_EQ(panels.back().to, 2.5);
  for (const auto& panel : panels) EXPECT_LE(panel.to - panel.from, 0.5 * (1.0 + 1e-12));
}

TEST(AdaptivePanels, HalveWhereTheyAreAskedToAndCoverAllOnce) {
  Search search;
  search.run(1e-4);
  double end = -1.0;
  for (const std::uint32_t i : search.leaves) {
    EXPECT_DOUBLE_EQ(search.panels[i].from, end);
    end = search.panels[i].to;
  }
  EXPECT_DOUBLE_EQ(end, 1.0);
  EXPECT_GT(search.leaves.size(), search.panels.first().size() + 10);
  // Nothing but the way there was evaluated.
  EXPECT_EQ(search.evaluated, search.made);
}

TEST(AdaptivePanels, AreAtHandForTheNextFunction) {
  Search search;
  search.run(1e-5);
  const auto leaves = search.leaves;
  const int made = search.made;
  search.run(1e-3);
  EXPECT_LT(search.leaves.size(), leaves.size());
  search.run(1e-5);
  EXPECT_EQ(search.leaves, leaves);
  EXPECT_EQ(search.made, made);
  EXPECT_FALSE(search.panels.drop_halves_if_too_many());
}

TEST(AdaptivePanels, AreDroppedDownToTheFirstOnesWhereTheyAreTooMany) {
  Search search;
  const std::size_t first = search.panels.size();
  search.run(1e-5);
  const std::size_t leaves = search.leaves.size();
  while (search.panels.size() <= AdaptivePanels::maximum) search.panels.add(0.0, 1.0);
  EXPECT_TRUE(search.panels.drop_halves_if_too_many());
  EXPECT_EQ(search.panels.size(), first);
  search.run(1e-5);
  EXPECT_EQ(search.leaves.size(), leaves);
}

}  // namespace
}  // namespace boresight::control
