#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/delay.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

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
    EXPECT_LT(numerics::spectral_abscissa(system.a), 0.0);
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
    EXPECT_THAT(reference::Call([&] { delay_approximant(bad, 4, "in", "out"); }),
                ThrowsMessage<InvalidInput>(HasSubstr("positive delay")));
  }
  EXPECT_THROW(delay_approximant(0.03, 0, "in", "out"), InvalidInput);
  EXPECT_THROW(delay_approximant(0.03, 17, "in", "out"), InvalidInput);
}

TEST(PadeCoefficients, AreThoseOfTheReferenceTable) {
  const auto file = reference::reference_values("pade");
  for (const auto& row : file.at("rows")) {
    const auto found = pade_coefficients(1.0, row.at(1), row.at(0));
    const auto denominator = reference::ascending(row.at(2));
    const auto numerator = reference::ascending(row.at(3));
    ASSERT_EQ(found.denominator.size(), denominator.size());
    ASSERT_EQ(found.numerator.size(), numerator.size());
    for (std::size_t i = 0; i < denominator.size(); ++i) {
      EXPECT_NEAR(found.denominator[i] * denominator[0], denominator[i], 1e-13 * denominator[i]);
    }
    for (std::size_t i = 0; i < numerator.size(); ++i) {
      EXPECT_NEAR(found.numerator[i] * numerator[0], numerator[i], 1e-13 * std::abs(numerator[i]));
    }
  }
}

TEST(PadeCoefficients, ScaleWithPowersOfTheDelay) {
  const auto one = pade_coefficients(1.0, 3, 4), other = pade_coefficients(0.02, 3, 4);
  for (int i = 0; i <= 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double power = std::pow(0.02, i);
    EXPECT_NEAR(other.denominator[k], power * one.denominator[k], 1e-15 * power);
    if (i == 4) continue;
    EXPECT_NEAR(other.numerator[k], power * one.numerator[k], 1e-15 * power);
  }
  // Taylor's series where there is no denominator.
  EXPECT_DOUBLE_EQ(pade_coefficients(2.0, 3, 0).numerator[3], -8.0 / 6.0);
}

TEST(PadeApproximant, HasTheResponseOfPadesClosedForm) {
  for (const double delay : {1e-30, 0.03, 1e20}) {
    for (int n = 1; n <= 16; ++n) {
      for (int m = n > 10 ? n - 1 : 0; m <= n; ++m) {
        const auto system = pade_approximant(delay, m, n, "in", "out");
        ASSERT_EQ(system.a.rows(), n);
        for (const double turn : {0.01, 0.5, 2.0, 5.0, 20.0}) {
          const Complex found = response(system, turn / delay);
          EXPECT_LT(std::abs(found - pade(m, n, Complex{0.0, -turn})), 1e-12)
              << m << "/" << n << ", " << turn;
        }
      }
    }
  }
}

TEST(PadeApproximant, OfEqualDegreesPassesEveryFrequencyUnchanged) {
  for (const int n : {1, 2, 5, 8}) {
    const auto system = pade_approximant(1.0, n, n, "in", "out");
    for (double w = 0.01; w < 1e4; w *= 3.0) {
      EXPECT_NEAR(std::abs(response(system, w)), 1.0, 1e-12);
    }
    EXPECT_NEAR(system.d(0, 0), n % 2 == 0 ? 1.0 : -1.0, 1e-12);
    EXPECT_EQ(system.states.back(), "out_delay_" + std::to_string(n));
  }
}

TEST(PadeApproximant, MeetsTheLegendreRealisation) {
  for (const int order : {1, 3, 6, 8}) {
    const auto one = delay_approximant(0.5, order, "in", "out");
    const auto other = pade_approximant(0.5, order - 1, order, "in", "out");
    for (const double w : {0.3, 4.0, 30.0}) {
      EXPECT_LT(std::abs(response(one, w) - response(other, w)), 1e-10) << order;
    }
  }
}

TEST(PadeApproximant, RefusesDelaysAndDegreesWithoutMeaning) {
  const auto refused = [](double delay, int m, int n, const char* message) {
    EXPECT_THAT(reference::Call([&] { pade_approximant(delay, m, n, "in", "out"); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused(0.1, 3, 2, "found 3 over 2");
  refused(0.1, -1, 2, "-1 and 2");
  refused(0.1, 2, 17, "2 and 17");
  refused(0.1, 0, 0, "not both 0");
  for (const double bad : {0.0, -0.1, std::nan(""), HUGE_VAL}) refused(bad, 1, 1, "positive delay");
}

}  // namespace
}  // namespace boresight::control
