#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Eigen::VectorXcd by_the_definition(const Eigen::VectorXd& series) {
  const Eigen::Index n = series.size();
  Eigen::VectorXcd half = Eigen::VectorXcd::Zero(n / 2 + 1);
  for (Eigen::Index k = 0; k < half.size(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double turns = static_cast<double>(i * k % n) / static_cast<double>(n);
      half[k] += series[i] * std::polar(1.0, -2.0 * std::numbers::pi * turns);
    }
  }
  return half;
}

TEST(FourierTransform, IsTheDefinitionsSumForEveryLength) {
  reference::RandomNumbers random(5);
  for (Eigen::Index n = 1; n <= 130; ++n) {
    const Eigen::VectorXd series = random.matrix(n, 1);
    const Eigen::VectorXcd half = numerics::fourier_transform(series);
    ASSERT_EQ(half.size(), n / 2 + 1);
    EXPECT_LT((half - by_the_definition(series)).norm(), 1e-13 * static_cast<double>(n)) << n;
  }
}

TEST(FourierTransform, AndBackIsTheSeries) {
  reference::RandomNumbers random(6);
  for (const Eigen::Index n : {1, 2, 3, 4, 7, 45, 96, 1009, 6000, 65536, 72000}) {
    const Eigen::VectorXd series = random.matrix(n, 1);
    EXPECT_LT((numerics::inverse_fourier_transform(numerics::fourier_transform(series), n) - series)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-14)
        << n;
  }
}

TEST(FourierTransform, KeepsTheMeanSquare) {
  reference::RandomNumbers random(7);
  for (const Eigen::Index n : {9, 4096, 5400}) {
    const Eigen::VectorXd series = random.matrix(n, 1);
    Eigen::ArrayXd powers = numerics::fourier_transform(series).array().abs2();
    const Eigen::Index last = n / 2;
    powers.segment(1, n % 2 == 0 ? last - 1 : last) *= 2.0;
    EXPECT_NEAR(powers.sum() / static_cast<double>(n) / series.squaredNorm(), 1.0, 1e-13);
  }
}

TEST(FastTransformLength, IsTheNextEvenOneOfSmallFactors) {
  EXPECT_EQ(numerics::fast_transform_length(1), 1);
  EXPECT_EQ(numerics::fast_transform_length(2), 2);
  EXPECT_EQ(numerics::fast_transform_length(7), 8);
  EXPECT_EQ(numerics::fast_transform_length(72000), 72000);
  EXPECT_EQ(numerics::fast_transform_length(72001), 72900);
  for (Eigen::Index n = 2; n < 3000; ++n) {
    const Eigen::Index found = numerics::fast_transform_length(n);
    Eigen::Index expected = n;
    for (;; ++expected) {
      Eigen::Index rest = expected;
      for (const Eigen::Index prime : {2, 3, 5}) {
        while (rest % prime == 0) rest /= prime;
      }
      if (rest == 1 && expected % 2 == 0) break;
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(FourierTransform, RefusesWhatHasNoTransformOrWouldTakeHours) {
  EXPECT_THAT(reference::Call([] { numerics::fourier_transform(Eigen::VectorXd()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("fourier_transform: expected 1 to")));
  EXPECT_THAT(reference::Call(
                  [] { numerics::fourier_transform(Eigen::VectorXd::Constant(4, std::nan(""))); }),
              ThrowsMessage<InvalidInput>(HasSubstr("finite samples")));
  // A prime: 131101 times itself.
  EXPECT_THAT(reference::Call([] { numerics::fourier_transform(Eigen::VectorXd::Zero(131101)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("such as 131220 samples have")));
  EXPECT_THAT(
      reference::Call([] { numerics::inverse_fourier_transform(Eigen::VectorXcd::Zero(4), 8); }),
      ThrowsMessage<InvalidInput>(HasSubstr("expected 5 elements for 8 samples, found 4")));
  Eigen::VectorXcd half = Eigen::VectorXcd::Zero(5);
  half[4] = {0.0, 1.0};
  EXPECT_THAT(reference::Call([&] { numerics::inverse_fourier_transform(half, 8); }),
              ThrowsMessage<InvalidInput>(HasSubstr("real first and middle")));
  EXPECT_NO_THROW(numerics::inverse_fourier_transform(half, 9));
  half[4] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(numerics::inverse_fourier_transform(half, 8), InvalidInput);
  EXPECT_THROW(numerics::inverse_fourier_transform(half, 0), InvalidInput);
  EXPECT_THROW(numerics::fast_transform_length(0), InvalidInput);
  EXPECT_THROW(numerics::fast_transform_length(Eigen::Index{1} << 40), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
