#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::plant {
namespace {

constexpr std::uint64_t random_samples = 200000;

TEST(Splitmix64, IsThePublishedSequence) {
  // The sequence of seed 1234567 that implementations print as their check.
  const std::uint64_t expected[] = {6457827717110365317U, 3203168211198807973U,
                                    9817491932198370423U, 4593380528125082431U,
                                    16408922859458223821U};
  for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(numerics::splitmix64(1234567, i), expected[i]);
}

TEST(NormalNumbers, HaveTheMomentsOfTheNormalDistribution) {
  const numerics::NormalNumbers normal(17);
  const double expected[] = {0.0, 1.0, 0.0, 3.0, 0.0, 15.0};
  // Variances of x^k: the moments 2k less the squared moments k.
  const double variances[] = {1.0, 2.0, 15.0, 96.0, 945.0, 10395.0 - 225.0};
  double sums[6] = {};
  double product = 0.0;
  for (std::uint64_t i = 0; i < random_samples; ++i) {
    const auto pair = normal.pair(i);
    product += pair.real() * pair.imag();
    for (const double x : {pair.real(), pair.imag()}) {
      double power = 1.0;
      for (double& sum : sums) sum += power *= x;
    }
  }
  const double count = 2.0 * random_samples;
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(sums[k] / count, expected[k], 4.0 * std::sqrt(variances[k] / count)) << k + 1;
  }
  EXPECT_NEAR(product / random_samples, 0.0, 4.0 / std::sqrt(random_samples));
}

TEST(NormalNumbers, AreDistributedNormally) {
  // Kolmogorov and Smirnov: sqrt(n) D is below 1.95 but in one case of a thousand.
  const numerics::NormalNumbers normal(18, 3);
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < random_samples / 2; ++i) {
    numbers.push_back(normal.pair(i).real());
    numbers.push_back(normal.pair(i).imag());
  }
  std::sort(numbers.begin(), numbers.end());
  double worst = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double expected = 0.5 * std::erfc(-numbers[i] / std::numbers::sqrt2);
    worst = std::max(worst, std::abs((static_cast<double>(i) + 0.5) / random_samples - expected));
  }
  EXPECT_LT(std::sqrt(random_samples) * worst, 1.95);
}

TEST(NormalNumbers, OfNeighbouringSeedsStreamsAndPlacesAreUnrelated) {
  const numerics::NormalNumbers one(4), other_stream(4, 1), other_seed(5);
  double stream = 0.0, seed = 0.0, next = 0.0;
  for (std::uint64_t i = 0; i < random_samples; ++i) {
    const double x = one.pair(i).real();
    stream += x * other_stream.pair(i).real() / random_samples;
    seed += x * other_seed.pair(i).real() / random_samples;
    next += x * one.pair(i + 1).real() / random_samples;
  }
  for (const double correlation : {stream, seed, next}) {
    EXPECT_NEAR(correlation, 0.0, 4.0 / std::sqrt(random_samples));
  }
}

TEST(NormalNumbers, AreTheSameWheneverAsked) {
  const numerics::NormalNumbers one(9, 2), again(9, 2);
  const auto late = one.pair(1000);
  for (std::uint64_t i = 0; i < 10; ++i) EXPECT_EQ(one.pair(i), again.pair(i));
  EXPECT_EQ(again.pair(1000), late);
  EXPECT_NE(numerics::NormalNumbers(9, 3).pair(0), one.pair(0));
}

}  // namespace
}  // namespace boresight::plant
