#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <boresight/numerics/bracketed_search.hpp>

namespace boresight::control {
namespace {

double root(const std::function<double(double)>& f, double low, double high) {
  return numerics::bracketed_root(f, low, high, f(low), f(high));
}

TEST(BracketedRoot, IsTheRootToTheLastDigits) {
  EXPECT_NEAR(root([](double x) { return std::cos(x); }, 1.0, 2.0), 0.5 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(root([](double x) { return x * x * x - 2.0; }, 0.0, 5.0), std::cbrt(2.0), 1e-15);
  // Steep on one side and flat on the other.
  EXPECT_NEAR(root([](double x) { return std::exp(-50.0 * x) - 0.5; }, -1.0, 10.0),
              std::numbers::ln2 / 50.0, 1e-15);
  // Multiple.
  EXPECT_NEAR(root([](double x) { return std::pow(x - 0.3, 9); }, 0.0, 1.0), 0.3, 1e-15);
}

TEST(BracketedRoot, IsAnEndThatIsZero) {
  const auto line = [](double x) { return x - 1.0; };
  EXPECT_EQ(root(line, 1.0, 3.0), 1.0);
  EXPECT_EQ(root(line, -1.0, 1.0), 1.0);
}

TEST(BracketedRoot, OfAJumpIsItsPlace) {
  int evaluations = 0;
  const double place = root(
      [&](double x) {
        ++evaluations;
        return x < 0.7 ? -1.0 : 3.0;
      },
      -1.0, 4.0);
  EXPECT_NEAR(place, 0.7, 1e-15);
  EXPECT_LT(evaluations, 120);
}

TEST(BracketedMaximum, HasItsPlaceToMoreDigitsThanItsValueTells) {
  // A golden section ends 1e-8 away, where the value no longer changes.
  for (const double width : {1.0, 1e-2, 1e-4}) {
    const auto function = [&](double x) {
      const double d = (x - 0.3) / width;
      return -d * d + 0.2 * d * d * d;
    };
    EXPECT_NEAR(numerics::bracketed_maximum(function, 0.3 - 0.7 * width, 0.3 + 0.4 * width), 0.3,
                1e-11 * width);
  }
  EXPECT_NEAR(numerics::bracketed_maximum([](double x) { return std::sin(x); }, 1.0, 3.0),
              0.5 * std::numbers::pi, 1e-11);
}

TEST(BracketedMaximum, CanBeAnEndOrAKink) {
  EXPECT_EQ(numerics::bracketed_maximum([](double x) { return x; }, 0.0, 2.0), 2.0);
  EXPECT_EQ(numerics::bracketed_maximum([](double x) { return -x; }, 0.0, 2.0), 0.0);
  EXPECT_NEAR(numerics::bracketed_maximum([](double x) { return -std::abs(x - 0.4); }, 0.0, 2.0),
              0.4, 1e-8);
}

TEST(BracketedMaximum, EndsInTheNarrowestInterval) {
  const double low = 11.0, high = std::nextafter(std::nextafter(low, 20.0), 20.0);
  const double place = numerics::bracketed_maximum([](double x) { return -x * x; }, low, high);
  EXPECT_GE(place, low);
  EXPECT_LE(place, high);
}

}  // namespace
}  // namespace boresight::control
