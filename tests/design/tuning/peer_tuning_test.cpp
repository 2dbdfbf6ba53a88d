// The peers' tuning: the same optimum from nearly every start, evaluated on the state space.
#include "peer_tuning.hpp"

#include <gtest/gtest.h>

#include "random_numbers.hpp"

namespace boresight::design {
namespace {

using reference::relative_error;

TEST(PeerTuning, FindsTheOptimumThatOthersFind) {
  const auto tuning = reference::tune_peer(5);
  ASSERT_TRUE(tuning.has_value());
  const auto evaluated = reference::evaluate_peer(5, tuning->gains);
  EXPECT_LT(evaluated.abscissa, 0.0);
  EXPECT_LT(relative_error(evaluated.rms, reference::peer_tuned_rms), 1e-6);
  EXPECT_LT(evaluated.peak, reference::peer_peak_limit * (1.0 + 1e-6));
  // The search and the independent evaluation agree.
  EXPECT_LT(relative_error(tuning->rms, evaluated.rms), 1e-8);
  EXPECT_LT(relative_error(tuning->peak, evaluated.peak), 1e-6);
}

TEST(PeerTuning, FindsItFromNearlyEveryStart) {
  reference::RandomNumbers random(221);
  constexpr int starts = 200;
  int reached = 0;
  for (int i = 0; i < starts; ++i) {
    const auto near = [&](double gain) { return random.log_uniform(0.1 * gain, 10.0 * gain); };
    const auto& start = reference::peer_tuning_start;
    const double rate = near(start.rate_gain), rate_integral = near(start.rate_integral);
    const double position = near(start.position_gain);
    const auto tuning =
        reference::tune_peer(5, {rate, rate_integral, position, near(start.position_integral)});
    if (!tuning) continue;
    const auto evaluated = reference::evaluate_peer(5, tuning->gains);
    // Whatever is reported is feasible.
    EXPECT_LT(evaluated.abscissa, 0.0);
    EXPECT_LT(evaluated.peak, reference::peer_peak_limit * (1.0 + 1e-6));
    reached += relative_error(evaluated.rms, reference::peer_tuned_rms) < 1e-6 ? 1 : 0;
  }
  EXPECT_GE(reached, 198);
}

TEST(PeerTuning, KnowsAnotherOptimumAtTheBoundOfTheRateIntegral) {
  const auto tuning = reference::tune_peer(5, {0.5, 1e-3, 3.7, 17.0});
  ASSERT_TRUE(tuning.has_value());
  const auto evaluated = reference::evaluate_peer(5, tuning->gains);
  EXPECT_LT(evaluated.abscissa, 0.0);
  EXPECT_GT(evaluated.abscissa, -0.01);
  EXPECT_LT(evaluated.peak, reference::peer_peak_limit * (1.0 + 1e-6));
  EXPECT_LT(relative_error(evaluated.rms, 2.44083), 1e-5);
}

TEST(PeerTuning, WithFiveHundredModesEndsAtItsLimit) {
  const auto tuning = reference::tune_peer(500);
  ASSERT_TRUE(tuning.has_value());
  EXPECT_LT(relative_error(tuning->peak, reference::peer_peak_limit), 1e-6);
}

}  // namespace
}  // namespace boresight::design
