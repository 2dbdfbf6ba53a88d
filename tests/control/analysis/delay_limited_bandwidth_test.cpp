#include <algorithm>
#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/control/analysis/delay_limited_bandwidth.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// |S| of the loop gain k exp(-j y)/(j y).
double sensitivity(double gain, double y) {
  return 1.0 / std::abs(1.0 + gain * std::polar(1.0, -y) / std::complex<double>(0.0, y));
}

double peak(double gain) {
  double highest = 0.0;
  for (double y = 0.01; y < 10.0; y += 1e-4) highest = std::max(highest, sensitivity(gain, y));
  return highest;
}

TEST(DelayLimitedBandwidth, IsThatOfTheLoopWithThePeak) {
  for (const double gain : {0.2, 0.5, 0.7, 1.2}) {
    const double bandwidth = delay_limited_bandwidth(1.0, peak(gain));
    EXPECT_NEAR(sensitivity(gain, bandwidth), std::sqrt(0.5), 1e-6) << gain;
    for (double y = 0.01; y < 0.999 * bandwidth; y += 0.01) {
      EXPECT_LT(sensitivity(gain, y), std::sqrt(0.5)) << gain;
    }
  }
  // Skogestad's rule.
  EXPECT_NEAR(peak(0.5), 1.59, 0.005);
}

TEST(DelayLimitedBandwidth, FallsWithTheDelayAndRisesWithThePeak) {
  EXPECT_NEAR(delay_limited_bandwidth(0.03, 2.0), delay_limited_bandwidth(1.0, 2.0) / 0.03, 1e-9);
  EXPECT_LT(delay_limited_bandwidth(1.0, 1.5), delay_limited_bandwidth(1.0, 2.0));
  EXPECT_LT(delay_limited_bandwidth(1.0, 1.0 + 1e-9), 1e-3);
}

TEST(DelayLimitedBandwidth, RefusesWhatIsNoDelayOrNoPeak) {
  for (const auto& [delay, highest] : {std::pair{0.0, 2.0}, {-1.0, 2.0}, {1.0, 1.0}, {1.0, NAN}}) {
    EXPECT_THAT(
        ([&, delay = delay, highest = highest] { (void)delay_limited_bandwidth(delay, highest); }),
        ThrowsMessage<InvalidInput>(HasSubstr("expected a delay above 0")));
  }
}

}  // namespace
}  // namespace boresight::control
