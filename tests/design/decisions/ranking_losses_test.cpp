#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/decisions/ranking_losses.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;

constexpr double lost = std::numeric_limits<double>::infinity();

// 1000 samples: losses from 1 to 2, evenly spaced, times `scale`; the fraction `failing` fails.
OptionStatistics option(double scale, double failing) {
  Eigen::MatrixXd losses(1000, 1);
  for (Eigen::Index i = 0; i < losses.rows(); ++i) {
    const double fraction = (static_cast<double>(i) + 0.5) / 1000.0;
    losses(i, 0) = fraction < 1.0 - failing ? scale * (1.0 + fraction) : lost;
  }
  return compare_options(losses).options[0];
}

TEST(RankingLosses, TakesTheMeanWhereOneThatIsFitHasOne) {
  const auto ranking = ranking_losses({option(1.0, 0.0), option(0.5, 0.01)}, {true, true});
  EXPECT_EQ(ranking.measure, LossMeasure::mean);
  EXPECT_NEAR(ranking.losses[0], 1.5, 1e-12);
  EXPECT_EQ(ranking.losses[1], lost);
}

TEST(RankingLosses, TellsApartThoseThatFailOnSomeSamples) {
  const auto ranking = ranking_losses({option(1.0, 0.01), option(0.5, 0.02)}, {true, true});
  EXPECT_EQ(ranking.measure, LossMeasure::quantile_95);
  EXPECT_NEAR(ranking.losses[0], 1.95, 2e-3);
  EXPECT_NEAR(ranking.losses[1], 0.975, 1e-3);
  // Beyond a twentieth of the samples even that is lost, by one of them or by all.
  EXPECT_EQ(ranking_losses({option(1.0, 0.01), option(0.5, 0.1)}, {true, true}).losses[1], lost);
  const auto often = ranking_losses({option(1.0, 0.1), option(0.5, 0.2)}, {true, true});
  EXPECT_EQ(often.measure, LossMeasure::median);
  EXPECT_NEAR(often.losses[0], 1.5, 2e-3);
  EXPECT_NEAR(often.losses[1], 0.75, 1e-3);
}

// What is not fit does not decide how those that are fit are ranking.
TEST(RankingLosses, AsksThoseThatAreFit) {
  EXPECT_EQ(ranking_losses({option(1.0, 0.01), option(0.5, 0.0)}, {true, false}).measure,
            LossMeasure::quantile_95);
  EXPECT_EQ(ranking_losses({option(1.0, 0.01), option(0.5, 0.0)}, {false, false}).measure,
            LossMeasure::mean);
  EXPECT_THAT(ranking_losses({option(1.0, 0.0)}, {true}).losses, ElementsAre(testing::Ge(1.0)));
  EXPECT_THROW(ranking_losses({option(1.0, 0.0)}, {}), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
