// Position against rate gain where the rate loop hardly acts, on the reference antenna.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

design::TuningResult ended_at_position_gain(std::vector<double> gains) {
  design::TuningResult tuning;
  tuning.status = design::TuningStatus::optimal;
  tuning.law = {control::LoopStructure::pi_with_lag(), std::move(gains)};
  tuning.gains_at_bound = {"position gain"};
  return tuning;
}

// The robust PI law of this antenna: a position gain of 30 1/s on a rate gain of 0.04.
TEST(PositionGainTrade, LowersThePositionGainAtTheSameProductAndRms) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const auto problem = make_problem(antenna);
  const auto goals = make_goals(antenna);
  const std::vector<design::EnsembleMember> nominal{{"nominal", problem.plant}};
  auto tuning = ended_at_position_gain({0.038316, 0.22045, 2.7894, 30.0, 0.18267});
  const double rms = design::judge(problem, nominal, tuning.law, goals, 1).members.front().beam_rms;
  ASSERT_TRUE(ends_at_position_gain(tuning));
  const auto trade = design::position_gain_trade(problem, tuning, rms, goals, nominal);
  ASSERT_TRUE(trade);
  const double position = trade->law.gains.at(trade->position_gain);
  const double rate = trade->law.gains.at(trade->rate_gain);
  EXPECT_LE(position, 15.0);
  EXPECT_NEAR(position * rate, 30.0 * 0.038316, 2e-4 * position * rate);
  EXPECT_LE(trade->beam_rms, 1.01 * rms);
  // The law that it names has that rms, and keeps its goals as said.
  tuning.law.gains[0] = rate;
  tuning.law.gains[3] = position;
  const auto named = design::judge(problem, nominal, tuning.law, goals, 1);
  EXPECT_NEAR(named.members.front().beam_rms, trade->beam_rms, 1e-3 * rms);
  EXPECT_EQ(named.within_goals, trade->within_goals);
}

TEST(PositionGainTrade, IsNoneWhereTheRateLoopActsOrNoBoundIsReached) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const auto problem = make_problem(antenna);
  const auto goals = make_goals(antenna);
  // Twice this rate gain and the loop is unstable.
  auto tuning = ended_at_position_gain({0.4, 0.8, 6.0, 1.35, 0.02});
  const double rms = design::judge(problem, {{"nominal", problem.plant}}, tuning.law, goals, 1)
                         .members.front()
                         .beam_rms;
  EXPECT_TRUE(design::ends_at_position_gain(tuning));
  EXPECT_FALSE(design::position_gain_trade(problem, tuning, rms, goals, {}));
  tuning.gains_at_bound.clear();
  EXPECT_FALSE(ends_at_position_gain(tuning));
  EXPECT_FALSE(design::position_gain_trade(problem, tuning, rms, goals, {}));
  // The lower bound, and no law at all.
  EXPECT_FALSE(ends_at_position_gain(ended_at_position_gain({0.4, 0.8, 6.0, 0.03, 0.02})));
  EXPECT_FALSE(ends_at_position_gain(ended_at_position_gain({})));
}

TEST(PositionGainTrade, SpeaksOfPlantsOnlyWhereItWasJudgedOnSome) {
  const design::PositionGainTrade trade{
      {control::LoopStructure::pi(), {0.254, 1.0, 6.0, 0.25}}, 2, 0, 9.5 * millidegree, 20};
  EXPECT_THAT(trade_in_words(trade, {}, "PI with lag", 9.4551 * millidegree, 30),
              AllOf(HasSubstr("PI with lag has kp at its bound because"),
                    HasSubstr("9.5000 mdeg, +0.5 %, with every goal kept on 20 of 30 plants")));
  EXPECT_THAT(trade_in_words(trade, {}, "PI with lag", 9.4551 * millidegree, 0),
              AllOf(HasSubstr("9.5000 mdeg, +0.5 %. A lower upper bound of kp ([[tuning.bound]]"),
                    Not(HasSubstr("plants"))));
}

}  // namespace
}  // namespace boresight::app
