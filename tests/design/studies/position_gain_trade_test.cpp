// Position against rate gain where the rate loop hardly acts, on the reference antenna.
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/position_gain_trade.hpp>

namespace boresight::design {
namespace {

TuningResult ended_at_position_gain(std::vector<double> gains) {
  TuningResult tuning;
  tuning.status = TuningStatus::optimal;
  tuning.controller = {control::LoopStructure::pi_with_lag(), std::move(gains)};
  tuning.gains_at_bound = {"position gain"};
  return tuning;
}

// The robust PI controller of this antenna: a position gain of 30 1/s on a rate gain of 0.04.
TEST(PositionGainTrade, LowersThePositionGainAtTheSameProductAndRms) {
  const Mission mission = reference::demo_mission();
  const auto problem = tracking_problem(mission);
  const auto goals = constraints(mission);
  const std::vector<EnsembleMember> nominal{{"nominal", problem.plant}};
  auto tuning = ended_at_position_gain({0.038316, 0.22045, 2.7894, 30.0, 0.18267});
  const double rms =
      evaluate(problem, nominal, tuning.controller, goals, 1).members.front().boresight_rms;
  ASSERT_TRUE(ends_at_position_gain(tuning));
  const auto trade = position_gain_trade(problem, tuning, rms, goals, nominal);
  ASSERT_TRUE(trade);
  const double position = trade->controller.gains.at(trade->position_gain);
  const double rate = trade->controller.gains.at(trade->rate_gain);
  EXPECT_LE(position, 15.0);
  EXPECT_NEAR(position * rate, 30.0 * 0.038316, 2e-4 * position * rate);
  EXPECT_LE(trade->boresight_rms, 1.01 * rms);
  // The controller that it names has that rms, and keeps its goals as said.
  tuning.controller.gains[0] = rate;
  tuning.controller.gains[3] = position;
  const auto named = evaluate(problem, nominal, tuning.controller, goals, 1);
  EXPECT_NEAR(named.members.front().boresight_rms, trade->boresight_rms, 1e-3 * rms);
  EXPECT_EQ(named.within_constraints, trade->within_constraints);
}

TEST(PositionGainTrade, IsNoneWhereTheRateLoopActsOrNoBoundIsReached) {
  const Mission mission = reference::demo_mission();
  const auto problem = tracking_problem(mission);
  const auto goals = constraints(mission);
  // Twice this rate gain and the loop is unstable.
  auto tuning = ended_at_position_gain({0.4, 0.8, 6.0, 1.35, 0.02});
  const double rms = evaluate(problem, {{"nominal", problem.plant}}, tuning.controller, goals, 1)
                         .members.front()
                         .boresight_rms;
  EXPECT_TRUE(ends_at_position_gain(tuning));
  EXPECT_FALSE(position_gain_trade(problem, tuning, rms, goals, {}));
  tuning.gains_at_bound.clear();
  EXPECT_FALSE(ends_at_position_gain(tuning));
  EXPECT_FALSE(position_gain_trade(problem, tuning, rms, goals, {}));
  // The lower bound, and no controller at all.
  EXPECT_FALSE(ends_at_position_gain(ended_at_position_gain({0.4, 0.8, 6.0, 0.03, 0.02})));
  EXPECT_FALSE(ends_at_position_gain(ended_at_position_gain({})));
}

}  // namespace
}  // namespace boresight::design
