#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <boresight/numerics/golden_section.hpp>

namespace boresight::control {
namespace {

TEST(GoldenSection, FindsTheMaximumOfAFunctionWithOne) {
  const auto parabola = [](double x) { return -(x - 0.3) * (x - 0.3); };
  EXPECT_NEAR(numerics::golden_section_maximum(parabola, -2.0, 5.0, 1e-7), 0.3, 1e-7);
  const auto sine = [](double x) { return std::sin(x); };
  EXPECT_NEAR(numerics::golden_section_maximum(sine, 0.0, 3.0, 1e-7), std::numbers::pi / 2.0, 1e-7);
  const auto roof = [](double x) { return -std::abs(x - 1.9); };
  EXPECT_NEAR(numerics::golden_section_maximum(roof, 0.0, 2.0, 1e-12), 1.9, 1e-12);
}

TEST(GoldenSection, GoesToTheHigherEndOfAMonotoneFunction) {
  const auto rising = [](double x) { return x; };
  const auto falling = [](double x) { return -x; };
  EXPECT_NEAR(numerics::golden_section_maximum(rising, 0.0, 1.0, 1e-9), 1.0, 1e-9);
  EXPECT_NEAR(numerics::golden_section_maximum(falling, 0.0, 1.0, 1e-9), 0.0, 1e-9);
}

TEST(GoldenSection, AsksForTheValueOnceAStep) {
  int calls = 0;
  const auto counted = [&](double x) {
    ++calls;
    return -x * x;
  };
  numerics::golden_section_maximum(counted, -1.0, 2.0, 3e-6);
  // log(1e6)/log(1.618) steps and the first pair.
  EXPECT_LE(calls, 32);
}

}  // namespace
}  // namespace boresight::control
