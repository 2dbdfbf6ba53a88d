#include <cmath>
#include <numeric>

#include <boost/math/distributions/binomial.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/design/ensembles/monte_carlo_statistics.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight {
namespace {

using design::EstimatedNumber;

bool holds(const EstimatedNumber& estimate, double truth) {
  return estimate.lower <= truth && truth <= estimate.upper;
}

// Inverse of the logistic distribution function, and its variance pi^2/3.
double logistic(double fraction) {
  return std::log(fraction / (1.0 - fraction));
}

TEST(Probability, HoldsTheTruthInNinetyFivePerCentOfStudiesWhateverItIs) {
  for (const std::uint64_t random_samples : {20, 100, 1000}) {
    for (const double truth : {0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
      const boost::math::binomial_distribution<double> controller(
          static_cast<double>(random_samples), truth);
      double covered = 0.0;
      for (std::uint64_t hits = 0; hits <= random_samples; ++hits) {
        if (holds(design::probability(hits, random_samples), truth)) {
          covered += boost::math::pdf(controller, static_cast<double>(hits));
        }
      }
      EXPECT_GE(covered, 0.95) << truth << " of " << random_samples;
      const bool many = static_cast<double>(random_samples) * std::min(truth, 1.0 - truth) > 50.0;
      EXPECT_TRUE(!many || covered < 0.97) << covered;
    }
  }
}

TEST(Probability, KnowsTheClosedFormsAtBothEnds) {
  EXPECT_EQ(design::probability(0, 100).value, 0.0);
  EXPECT_EQ(design::probability(0, 100).lower, 0.0);
  // (1 - p)^100 = 0.025
  EXPECT_NEAR(design::probability(0, 100).upper, 1.0 - std::pow(0.025, 0.01), 1e-12);
  EXPECT_NEAR(design::probability(100, 100).lower, std::pow(0.025, 0.01), 1e-12);
  EXPECT_EQ(design::probability(100, 100).upper, 1.0);
  EXPECT_EQ(design::probability(0, 0).upper, 1.0);
  EXPECT_THAT(
      reference::Call([] { design::probability(3, 2); }),
      testing::ThrowsMessage<InvalidInput>("probability: expected at most 2 hits, found 3"));
}

TEST(Summary, HasTheClosedFormsOfEvenlySpacedNumbers) {
  std::vector<double> values(101);
  std::iota(values.begin(), values.end(), 0.0);
  std::ranges::reverse(values);
  const auto summary = design::summarise(values, {0.25, 0.5});
  EXPECT_EQ(summary.random_samples, 101U);
  EXPECT_DOUBLE_EQ(summary.mean.value, 50.0);
  // n (n + 1)/12
  EXPECT_DOUBLE_EQ(summary.standard_deviation.value, std::sqrt(101.0 * 102.0 / 12.0));
  EXPECT_EQ(summary.minimum, 0.0);
  EXPECT_EQ(summary.largest, 100.0);
  EXPECT_DOUBLE_EQ(summary.quantiles[0].number.value, 25.0);
  EXPECT_DOUBLE_EQ(summary.quantiles[1].number.value, 50.0);
  // By tables of the binomial distribution: the median of 101 between the 41st and the 61st.
  EXPECT_EQ(summary.quantiles[1].number.lower, 40.0);
  EXPECT_EQ(summary.quantiles[1].number.upper, 60.0);
}

TEST(Summary, IntervalsHoldTheTruthOfALogisticLaw) {
  reference::RandomNumbers random(4);
  constexpr int studies = 1500;
  constexpr double variance = 3.289868133696453;
  int mean = 0, deviation = 0, median = 0, high = 0;
  for (int study = 0; study < studies; ++study) {
    std::vector<double> values(250);
    for (double& value : values) value = logistic(random.uniform(1e-12, 1.0));
    const auto summary = design::summarise(values, {0.5, 0.95});
    mean += holds(summary.mean, 0.0) ? 1 : 0;
    deviation += holds(summary.standard_deviation, std::sqrt(variance)) ? 1 : 0;
    median += holds(summary.quantiles[0].number, 0.0) ? 1 : 0;
    high += holds(summary.quantiles[1].number, logistic(0.95)) ? 1 : 0;
  }
  EXPECT_NEAR(mean, 0.95 * studies, 0.02 * studies);
  EXPECT_NEAR(deviation, 0.94 * studies, 0.03 * studies);
  // Exact at least: between order statistics it can only be more.
  EXPECT_NEAR(median, 0.957 * studies, 0.02 * studies);
  EXPECT_NEAR(high, 0.96 * studies, 0.02 * studies);
}

TEST(Summary, SaysWhereTheSamplesAreTooFew) {
  const auto empty = design::summarise({}, {0.5});
  EXPECT_TRUE(std::isnan(empty.mean.value));
  EXPECT_TRUE(std::isnan(empty.quantiles[0].number.upper));
  const auto few = design::summarise({1.0, 2.0, 3.0, 4.0, 5.0}, {0.5, 0.99});
  EXPECT_EQ(few.quantiles[0].number.value, 3.0);
  EXPECT_TRUE(std::isinf(few.quantiles[1].number.upper));
  EXPECT_TRUE(std::isinf(design::summarise({7.0}, {0.5}).mean.upper));
  // Nothing cancels where all are nearly the same.
  EXPECT_NEAR(design::summarise({1e9, 1e9 + 1.0, 1e9 + 2.0}, {}).standard_deviation.value, 1.0,
              1e-6);
  EXPECT_THROW(design::summarise({1.0}, {0.0}), InvalidInput);
  EXPECT_THAT(reference::Call([] { design::summarise({std::nan("")}, {0.5}); }),
              testing::ThrowsMessage<InvalidInput>("summarise: expected finite values, found nan"));
}

TEST(RankCorrelation, SeesAnyMonotoneRelationAndNoneWhereThereIsNone) {
  reference::RandomNumbers random(9);
  std::vector<double> x(200), rising(200), falling(200);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = random.uniform(-1.0, 1.0);
    rising[i] = std::exp(5.0 * x[i]);
    falling[i] = -std::pow(x[i], 3.0);
  }
  EXPECT_EQ(design::rank_correlation(x, rising).value, 1.0);
  EXPECT_EQ(design::rank_correlation(x, falling).value, -1.0);
  EXPECT_TRUE(std::isnan(design::rank_correlation(x, std::vector<double>(200, 1.0)).value));
  // With ties: 1 - 6 sum d^2/(n (n^2 - 1)) no longer holds, Pearson's of the mean ranks does.
  const std::vector<double> a{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, b{1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
  EXPECT_NEAR(design::rank_correlation(a, b).value, 80.0 / std::sqrt(82.5 * 80.0), 1e-12);
  int covered = 0;
  for (int study = 0; study < 1000; ++study) {
    std::vector<double> u(60), v(60);
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] = random.uniform(0.0, 1.0);
      v[i] = random.uniform(0.0, 1.0);
    }
    covered += holds(design::rank_correlation(u, v), 0.0) ? 1 : 0;
  }
  EXPECT_NEAR(covered, 950, 25);
  EXPECT_THROW(design::rank_correlation({1.0}, {}), InvalidInput);
}

}  // namespace
}  // namespace boresight
