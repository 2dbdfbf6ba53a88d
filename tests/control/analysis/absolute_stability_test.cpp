#include <cmath>
#include <complex>
#include <limits>

#include <gtest/gtest.h>

#include <boresight/control/analysis/absolute_stability.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

Eigen::ArrayXd grid() {
  return Eigen::ArrayXd::LinSpaced(4000, std::log(1e-4), std::log(1e4)).exp();
}

// K/(s (s + 1)): with q = 1 the line is 1 + Re K/(j w) = 1, whatever K.
TEST(AbsoluteStability, HoldsForASecondOrderLoopOfAnyGain) {
  for (const double k : {0.1, 10.0, 1e4}) {
    const auto result = absolute_stability(
        [k](double w) {
          return k / (Complex{0.0, w} * Complex{1.0, w});
        },
        grid());
    EXPECT_TRUE(result.proven) << k;
    EXPECT_GT(result.distance, 0.0);
  }
}

// K/(s (s + 1)^2): Popov's limit is Hurwitz's, 2. With s = j w, 1 + Re (1 + j w q) L is
// 1 + K (q (1 - w^2) - 2)/(1 + w^2)^2, of which q = 2 makes 1 - 2 K w^2/(1 + w^2)^2: least at w =
// 1, where it is 1 - K/2.
TEST(AbsoluteStability, ReachesTheLinearLimitOfAThirdOrderLoop) {
  const auto loop = [](double k) {
    return [k](double w) { return k / (Complex{0.0, w} * Complex{1.0, w} * Complex{1.0, w}); };
  };
  EXPECT_TRUE(absolute_stability(loop(1.95), grid()).proven);
  const auto beyond = absolute_stability(loop(2.02), grid());
  EXPECT_FALSE(beyond.proven);
  EXPECT_NEAR(beyond.frequency, 1.0, 0.05);
  EXPECT_NEAR(beyond.slope, 2.0, 0.05);
  EXPECT_NEAR(beyond.distance, 1.0 - 0.5 * 2.02, 1e-4);
}

// K (s + 1)^2/s^3 is stable for K above 0.5 only: no sector from 0 is.
TEST(AbsoluteStability, IsNotProvenWhereALowerGainIsUnstable) {
  const auto result = absolute_stability(
      [](double w) {
        const Complex s{0.0, w};
        return 2.0 * (1.0 + s) * (1.0 + s) / (s * s * s);
      },
      grid());
  EXPECT_FALSE(result.proven);
}

TEST(AbsoluteStability, RefusesWhatIsNoLoop) {
  EXPECT_THROW(absolute_stability([](double) { return Complex{}; }, {}), InvalidInput);
  EXPECT_THROW(absolute_stability(
                   [](double) {
                     return Complex{std::numeric_limits<double>::quiet_NaN(), 0.0};
                   },
                   grid()),
               NumericalFailure);
}

}  // namespace
}  // namespace boresight::control
