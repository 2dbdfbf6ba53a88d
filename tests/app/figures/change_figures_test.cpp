#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/figures/change_figures.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

TEST(ChangeFigures, ShowEveryRecordAndWhatIsCompared) {
  design::ChangeStudy study;
  study.comparison.before.records = {{"a", 600.0, 5.0, 0.2, 2.0 * millidegree, 30.0, 0.0},
                                     {"b", 600.0, 7.0, 0.2, 4.0 * millidegree, 30.0, 0.0}};
  study.comparison.after.records = {{"c", 600.0, 6.0, 0.2, 1.0 * millidegree, 30.0, 0.0}};
  auto figures = change_figures(study);
  ASSERT_EQ(figures.size(), 1U);
  ASSERT_EQ(figures[0].panels.size(), 1U);
  const auto& panel = figures[0].panels[0];
  ASSERT_EQ(panel.series.size(), 2U);
  EXPECT_THAT(panel.series[0].x, testing::ElementsAre(5.0, 7.0));
  EXPECT_THAT(panel.series[0].y,
              testing::ElementsAre(testing::DoubleEq(2.0), testing::DoubleEq(4.0)));
  EXPECT_THAT(panel.series[1].labels, testing::ElementsAre("c"));
  EXPECT_EQ(panel.y.unit, "mdeg");
  EXPECT_EQ(panel.y.label, "boresight error rms");

  study.comparison.at_reference =
      design::RatioAtSpeed{6.0,
                           {3.0 * millidegree, 2.5 * millidegree, 3.5 * millidegree},
                           {1.0 * millidegree, 0.8 * millidegree, 1.2 * millidegree},
                           {1.0 / 3.0, 0.2, 0.5}};
  figures = change_figures(study);
  ASSERT_EQ(figures[0].panels[0].series.size(), 4U);
  EXPECT_THAT(figures[0].panels[0].series[3].y_upper, testing::ElementsAre(testing::DoubleEq(1.2)));
}

}  // namespace
}  // namespace boresight::app
