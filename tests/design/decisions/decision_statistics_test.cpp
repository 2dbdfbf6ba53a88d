#include <cmath>
#include <complex>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/decisions/decision_statistics.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double normal_fraction(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

// Pairs of normal numbers with means 0 and `gap`, deviations 1 and `deviation`, correlated.
Eigen::MatrixXd normal_pairs(Eigen::Index random_samples, double gap, double deviation,
                             double correlation, std::uint64_t seed) {
  const numerics::NormalNumbers numbers(seed);
  Eigen::MatrixXd result(random_samples, 2);
  for (Eigen::Index n = 0; n < random_samples; ++n) {
    const std::complex<double> pair = numbers.pair(static_cast<std::uint64_t>(n));
    result(n, 0) = pair.real();
    result(n, 1) = gap + deviation * (correlation * pair.real() +
                                      std::sqrt(1.0 - correlation * correlation) * pair.imag());
  }
  return result;
}

// How often the interval holds `truth`.
template <typename Make>
double coverage(Make make, double truth, double confidence, double tie_tolerance = 0.0) {
  int within = 0;
  constexpr int repetitions = 600;
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    const auto found = compare_options(make(seed), {.confidence = confidence,
                                                    .tie_tolerance = tie_tolerance,
                                                    .quantile_fractions = {}})
                           .pairs[0]
                           .better;
    within += found.lower <= truth && truth <= found.upper;
  }
  return static_cast<double>(within) / repetitions;
}

TEST(DecisionStatistics, SaysHowProbablyOneIsBetterAsOftenRightAsItClaims) {
  // Jeffreys's interval is right on average over the probabilities, not at each: a binomial is
  // discrete. The deviation of a mean of 8 x 600 trials is 0.3 %.
  for (const double confidence : {0.8, 0.95}) {
    double sum = 0.0;
    for (const double gap : {0.05, 0.3, 0.6, 1.0}) {
      for (const double correlation : {0.0, 0.7}) {
        const double deviation = 1.4;
        const double spread =
            std::sqrt(1.0 + deviation * deviation - 2.0 * correlation * deviation);
        const double one = coverage(
            [&](std::uint64_t seed) {
              return normal_pairs(80, gap, deviation, correlation, seed * 16 + 5);
            },
            normal_fraction(gap / spread), confidence);
        EXPECT_NEAR(one, confidence, 0.06) << "gap " << gap << ", correlation " << correlation;
        sum += one;
      }
    }
    EXPECT_NEAR(sum / 8.0, confidence, 0.02);
  }
}

TEST(DecisionStatistics, CountsTiesHalfAndStaysCalibratedWithThem) {
  // Outcomes closer than 0.5 tie: P(d < -0.5) + P(|d| < 0.5)/2 with d normal, mean 0.4, sqrt(2).
  const double root = std::sqrt(2.0);
  const double losses = normal_fraction((-0.5 - 0.4) / root);
  const double wins = 1.0 - normal_fraction((0.5 - 0.4) / root);
  const double truth = wins + 0.5 * (1.0 - wins - losses);
  const double found = coverage(
      [](std::uint64_t seed) { return normal_pairs(100, 0.4, 1.0, 0.0, seed); }, truth, 0.95, 0.5);
  EXPECT_NEAR(found, 0.95, 0.025);
}

TEST(DecisionStatistics, NarrowsTheIntervalWhereHalfTheSamplesTie) {
  Eigen::ArrayXd decided(100);
  Eigen::ArrayXd tied(100);
  for (Eigen::Index n = 0; n < 100; ++n) {
    decided[n] = n % 2 == 0 ? 1.0 : 0.0;
    tied[n] = n % 4 == 0 ? 1.0 : (n % 4 == 1 ? 0.0 : 0.5);
  }
  const auto wide = mean_score(decided, 0.95);
  const auto narrow = mean_score(tied, 0.95);
  EXPECT_EQ(wide.value, 0.5);
  EXPECT_EQ(narrow.value, 0.5);
  // Half the variance.
  EXPECT_NEAR((narrow.upper - narrow.lower) / (wide.upper - wide.lower), std::sqrt(0.5), 0.01);
}

TEST(DecisionStatistics, KnowsJeffreysIntervals) {
  // Beta(10.5, 0.5) and Beta(8.5, 2.5) at 2.5 % and 97.5 %, by Simpson's rule and bisection.
  Eigen::ArrayXd scores = Eigen::ArrayXd::Ones(10);
  const auto all = mean_score(scores, 0.95);
  EXPECT_EQ(all.upper, 1.0);
  EXPECT_NEAR(all.lower, 0.7828037324908, 1e-9);
  scores.head(2).setZero();
  const auto maximum = mean_score(scores, 0.95);
  EXPECT_NEAR(maximum.lower, 0.4972255035600, 1e-9);
  EXPECT_NEAR(maximum.upper, 0.9559405864473, 1e-9);
  const auto none = mean_score(Eigen::ArrayXd::Zero(10), 0.95);
  EXPECT_EQ(none.lower, 0.0);
  EXPECT_NEAR(none.upper, 1.0 - all.lower, 1e-12);
  // All tied: nothing is certain, but the mean is known better than by ten decisions.
  const auto tied = mean_score(Eigen::ArrayXd::Constant(10, 0.5), 0.95);
  EXPECT_LT(tied.lower, 0.46);
  EXPECT_GT(tied.lower, 0.3);
  EXPECT_NEAR(tied.upper, 1.0 - tied.lower, 1e-12);
}

TEST(DecisionStatistics, KnowsWhoIsBestAndWhatTheOthersLose) {
  Eigen::MatrixXd outcomes(4, 3);
  outcomes << 1.0, 2.0, 3.0,  //
      2.0, 1.0, 1.0,          //
      1.0, 4.0, infinity,     //
      2.0, 2.0, 2.0;
  const auto result = compare_options(outcomes);
  ASSERT_EQ(result.options.size(), 3u);
  EXPECT_EQ(result.random_samples, 4u);
  EXPECT_NEAR(result.options[0].best.value, (1.0 + 0.0 + 1.0 + 1.0 / 3.0) / 4.0, 1e-15);
  EXPECT_NEAR(result.options[1].best.value, (0.0 + 0.5 + 0.0 + 1.0 / 3.0) / 4.0, 1e-15);
  EXPECT_EQ(result.options[0].expected_regret, 0.25);
  EXPECT_EQ(result.options[1].expected_regret, 1.0);
  EXPECT_EQ(result.options[2].expected_regret, infinity);
  EXPECT_TRUE(std::isnan(result.options[2].regret_error));
  EXPECT_EQ(result.options[2].mean, infinity);
  EXPECT_EQ(result.options[0].mean, 1.5);
  EXPECT_NEAR(result.options[0].standard_error, std::sqrt(1.0 / 12.0), 1e-15);
  ASSERT_EQ(result.pairs.size(), 3u);
  const PairComparison& pair = result.pairs[1];
  EXPECT_EQ(pair.first, 0u);
  EXPECT_EQ(pair.second, 2u);
  EXPECT_EQ(pair.wins, 2u);
  EXPECT_EQ(pair.losses, 1u);
  EXPECT_EQ(pair.ties, 1u);
  EXPECT_EQ(pair.better.value, 0.625);
  EXPECT_TRUE(std::isnan(pair.mean_gain));
  EXPECT_EQ(result.pairs[0].mean_gain, 0.75);
  double sum = 0.0;
  for (const OptionStatistics& option : result.options) sum += option.best.value;
  EXPECT_NEAR(sum, 1.0, 1e-15);
}

TEST(DecisionStatistics, SwappingTwoOptionsSwapsWhatIsSaidOfThem) {
  Eigen::MatrixXd outcomes = normal_pairs(50, 0.3, 1.2, 0.4, 9);
  const auto one = compare_options(outcomes);
  outcomes.col(0).swap(outcomes.col(1));
  const auto other = compare_options(outcomes);
  EXPECT_NEAR(one.pairs[0].better.lower, 1.0 - other.pairs[0].better.upper, 1e-12);
  EXPECT_EQ(one.pairs[0].mean_gain, -other.pairs[0].mean_gain);
  EXPECT_EQ(one.options[0].expected_regret, other.options[1].expected_regret);
  EXPECT_EQ(one.options[1].best.upper, other.options[0].best.upper);
}

TEST(DecisionStatistics, OrdersDistributionsByDominance) {
  const auto verdict = [](std::initializer_list<double> first, std::initializer_list<double> second,
                          bool forward) {
    Eigen::MatrixXd outcomes(static_cast<Eigen::Index>(first.size()), 2);
    std::copy(first.begin(), first.end(), outcomes.col(0).begin());
    std::copy(second.begin(), second.end(), outcomes.col(1).begin());
    const auto pair = compare_options(outcomes).pairs[0];
    return forward ? pair.first_over_second : pair.second_over_first;
  };
  EXPECT_EQ(verdict({1, 2, 3}, {1, 2, 4}, true), Dominance::in_every_sample);
  EXPECT_EQ(verdict({1, 2, 3}, {1, 2, 4}, false), Dominance::none);
  EXPECT_EQ(verdict({1, 2, 3}, {2, 1, 4}, true), Dominance::first_order);
  EXPECT_EQ(verdict({2, 2, 2}, {1, 2, 3}, true), Dominance::second_order);  // same mean, no risk
  EXPECT_EQ(verdict({2, 2, 2}, {1, 2, 3}, false), Dominance::none);
  EXPECT_EQ(verdict({2, 2, 2.5}, {1, 1, 3}, true), Dominance::none);
  EXPECT_EQ(verdict({1, 2, 3}, {3, 1, 2}, true), Dominance::none);  // one distribution
  EXPECT_EQ(verdict({1, 2, infinity}, {2, 2, infinity}, true), Dominance::in_every_sample);
  EXPECT_EQ(to_string(Dominance::in_every_sample), "in every sample");
  EXPECT_EQ(to_string(Dominance::second_order), "second order");
}

TEST(DecisionStatistics, BoundsQuantilesByOrderStatistics) {
  // 1 ... 99: the median's 95 % interval is the 40th to the 60th of 99 (W. J. Conover, Practical
  // Nonparametric Statistics: 49.5 -+ 1.96 sqrt(99)/2).
  Eigen::MatrixXd outcomes(99, 1);
  for (Eigen::Index n = 0; n < 99; ++n) outcomes(n, 0) = static_cast<double>(99 - n);
  const auto found = compare_options(outcomes).options[0].quantiles;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[1].value, 50.0);
  EXPECT_EQ(found[1].lower, 40.0);
  EXPECT_EQ(found[1].upper, 60.0);
  EXPECT_NEAR(found[0].value, 1.0 + 0.05 * 98.0, 1e-12);
  EXPECT_EQ(found[2].upper, 99.0);
  // Ten samples do not bound the 95 % quantile: all lie below it with probability 0.95^10 = 0.6.
  const auto few = compare_options(outcomes.topRows(10)).options[0].quantiles;
  EXPECT_EQ(few[2].upper, infinity);
  EXPECT_EQ(few[0].lower, -infinity);
}

TEST(DecisionStatistics, CoversQuantilesAsOftenAsItClaims) {
  int within = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const auto found = compare_options(normal_pairs(100, 0.0, 1.0, 0.0, seed)).options[0].quantiles;
    within += found[0].lower <= -1.644854 && -1.644854 <= found[0].upper;
  }
  // Order statistics are discrete: at least 95 %.
  EXPECT_GT(within / 600.0, 0.935);
  EXPECT_LT(within / 600.0, 0.99);
}

template <typename Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(DecisionStatistics, SaysWhatIsWrong) {
  using testing::HasSubstr;
  const Eigen::MatrixXd fine = Eigen::MatrixXd::Ones(3, 2);
  EXPECT_THAT(refusal([&] { compare_options(fine.topRows(1)); }), HasSubstr("found 1 x 2"));
  EXPECT_THAT(refusal([&] { compare_options(fine.leftCols(0)); }), HasSubstr("found 3 x 0"));
  Eigen::MatrixXd bad = fine;
  bad(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([&] { compare_options(bad); }),
              HasSubstr("+infinity (failed) as outcomes, found nan in sample 2 of option 1"));
  bad(2, 1) = -infinity;
  EXPECT_THAT(refusal([&] { compare_options(bad); }), HasSubstr("found -inf"));
  EXPECT_THAT(refusal([&] { compare_options(fine, {.confidence = 1.0}); }),
              HasSubstr("compare_options: expected a confidence within (0, 1), found 1"));
  EXPECT_THAT(refusal([&] { compare_options(fine, {.tie_tolerance = -1.0}); }),
              HasSubstr("a tie tolerance of at least 0, found -1"));
  EXPECT_THAT(refusal([&] { compare_options(fine, {.quantile_fractions = {50.0}}); }),
              HasSubstr("quantile fractions within (0, 1), found 50"));
  EXPECT_THAT(refusal([] { mean_score(Eigen::ArrayXd(0), 0.95); }), HasSubstr("found 0 scores"));
  EXPECT_THAT(refusal([] { mean_score(Eigen::ArrayXd::Constant(3, 1.1), 0.95); }),
              HasSubstr("all within [0, 1]"));
  EXPECT_THAT(refusal([] { mean_score(Eigen::ArrayXd::Ones(3), 0.0); }),
              HasSubstr("mean_score: expected a confidence"));
}

}  // namespace
}  // namespace boresight::design
