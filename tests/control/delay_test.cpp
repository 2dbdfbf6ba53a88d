#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../random_numbers.hpp"
#include <boresight/control/delay.hpp>
#include <boresight/plant/eigenvalues.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;
using testing::ThrowsMessage;

double factorial(int n) {
  double product = 1.0;
  for (int i = 2; i <= n; ++i) product *= i;
  return product;
}

// The [m/n] Pade approximant of e^x, Pade's closed form.
Complex pade(int m, int n, Complex x) {
  Complex numerator = 0.0, denominator = 0.0;
  for (int j = 0; j <= m; ++j) {
    numerator += factorial(m + n - j) * factorial(m) /
                 (factorial(m + n) * factorial(j) * factorial(m - j)) * std::pow(x, j);
  }
  for (int j = 0; j <= n; ++j) {
    denominator += factorial(m + n - j) * factorial(n) /
                   (factorial(m + n) * factorial(j) * factorial(n - j)) * std::pow(-x, j);
  }
  return numerator / denominator;
}

Complex response(const plant::StateSpace& system, double w) {
  return plant::frequency_response(system, w)(0, 0);
}

TEST(DelayApproximant, IsPadesApproximantOfTheExponential) {
  const double delay = 0.03;
  for (int order = 1; order <= 10; ++order) {
    const auto system = delay_approximant(delay, order, "in", "out");
    EXPECT_EQ(system.a.rows(), order);
    for (const double turn : {0.01, 0.5, 2.0, 5.0, 20.0}) {
      const Complex found = response(system, turn / delay);
      const Complex expected = pade(order - 1, order, Complex{0.0, -turn});
      EXPECT_LT(std::abs(found - expected), 1e-11) << order << ", " << turn;
    }
  }
}

TEST(DelayApproximant, LeavesPadesRemainderAtLowFrequencies) {
  // e^x - [m/n] = (-1)^n m! n!/((m+n)! (m+n+1)!) x^(m+n+1) + ...
  const double delay = 0.03;
  for (int order = 1; order <= 4; ++order) {
    const auto system = delay_approximant(delay, order, "in", "out");
    const double turn = order < 3 ? 0.02 : 0.3;
    const int m = order - 1, n = order;
    const double leading = factorial(m) * factorial(n) / (factorial(m + n) * factorial(m + n + 1)) *
                           std::pow(turn, m + n + 1);
    const double error = std::abs(response(system, turn / delay) - std::polar(1.0, -turn));
    EXPECT_NEAR(error / leading, 1.0, 0.05) << order;
  }
}

TEST(DelayApproximant, OfTheOrderInUseIsExactInTheLoopsBand) {
  // Up to the 25 Hz of the band, 4.7 rad of dead time.
  const auto system = delay_approximant(0.03, 8, "in", "out");
  for (double w = 0.01; w < 0.1 / 0.03; w *= 1.3) {
    EXPECT_LT(std::abs(response(system, w) - std::polar(1.0, -0.03 * w)), 1e-14);
  }
  for (double w = 1.0; w < 2.0 / 0.03; w *= 1.1) {
    EXPECT_LT(std::abs(response(system, w) - std::polar(1.0, -0.03 * w)), 1e-9);
  }
  EXPECT_LT(std::abs(response(system, 157.0) - std::polar(1.0, -0.03 * 157.0)), 1e-4);
}

TEST(DelayApproximant, NeverAmplifiesAndFadesBeyondItsBand) {
  for (const int order : {2, 5, 8, 16}) {
    const auto system = delay_approximant(1.0, order, "in", "out");
    for (double w = 0.01; w < 1e4; w *= 1.2) {
      EXPECT_LT(std::abs(response(system, w)), 1.0 + 1e-9) << order << ", " << w;
    }
    EXPECT_LT(plant::spectral_abscissa(system.a), 0.0);
    EXPECT_NEAR(response(system, 0.0).real(), 1.0, 1e-12);
    // One pole more than zeros: n/(s delay).
    EXPECT_NEAR(std::abs(response(system, 1e7)) * 1e7, order, 1e-3 * order);
  }
}

TEST(DelayApproximant, DependsOnFrequencyTimesDelayAlone) {
  const auto one = delay_approximant(0.03, 8, "in", "out");
  const auto ten = delay_approximant(0.3, 8, "in", "out");
  for (const double w : {1.0, 30.0, 200.0}) {
    EXPECT_LT(std::abs(response(one, w) - response(ten, 0.1 * w)), 1e-12);
  }
}

TEST(DelayApproximant, RefusesDelaysAndOrdersWithoutMeaning) {
  for (const double bad : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
    EXPECT_THAT([&] { delay_approximant(bad, 4, "in", "out"); },
                ThrowsMessage<InvalidInput>(HasSubstr("positive delay")));
  }
  EXPECT_THROW(delay_approximant(0.03, 0, "in", "out"), InvalidInput);
  EXPECT_THROW(delay_approximant(0.03, 17, "in", "out"), InvalidInput);
}

}  // namespace
}  // namespace boresight::control
