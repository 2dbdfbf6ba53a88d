#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <boresight/app/figures/figure_id.hpp>
#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(ThinnedSeries, KeepsEveryPeakAndTheOrderOfTime) {
  constexpr Eigen::Index count = 100003;
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(count, 0.0, 1.0);
  Eigen::VectorXd y = (40.0 * x.array()).sin().matrix();
  y[77] = 5.0;
  y[50001] = -7.0;
  y[count - 1] = 3.0;
  const auto thin = thinned(x, y, 600);
  EXPECT_LE(thin.x.size(), 600U);
  EXPECT_GT(thin.x.size(), 500U);
  EXPECT_EQ(thin.x.size(), thin.y.size());
  EXPECT_TRUE(std::ranges::is_sorted(thin.x));
  for (const double peak : {5.0, -7.0, 3.0}) {
    EXPECT_EQ(std::ranges::count(thin.y, peak), 1) << peak;
  }
}

TEST(ThinnedSeries, LeavesShortSeriesAloneAndGapsOpen) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(10, 0.0, 9.0);
  EXPECT_EQ(thinned(x, 2.0 * x, 10).y, plotted(x, 2.0));
  const Eigen::VectorXd many = Eigen::VectorXd::LinSpaced(1000, 0.0, 999.0);
  Eigen::VectorXd y = many;
  y.segment(300, 400).setConstant(none);
  const auto thin = thinned(many, y, 100);
  int gaps = 0;
  for (std::size_t i = 0; i < thin.x.size(); ++i) {
    const bool inside = thin.x[i] >= 300.0 && thin.x[i] < 700.0;
    EXPECT_EQ(std::isnan(thin.y[i]), inside) << thin.x[i];
    gaps += inside ? 1 : 0;
  }
  EXPECT_EQ(gaps, 20);
}

TEST(ThinnedSeries, RefusesWhatDoesNotBelongTogether) {
  EXPECT_THROW(thinned(Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(4)), InvalidInput);
  EXPECT_THROW(thinned(Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3), 1), InvalidInput);
}

TEST(FigureId, IsMadeOfLettersDigitsAndHyphens) {
  EXPECT_EQ(figure_id("Record constant_speed 0.25 V"), "record-constant-speed-0-25-v");
  EXPECT_EQ(figure_id("  (a)  "), "a");
  EXPECT_EQ(figure_id(""), "");
}

}  // namespace
}  // namespace boresight::app
