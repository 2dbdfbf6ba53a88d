// What is said of a position gain whose bound is no sharp number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(PositionGainTrade, NamesPlantsOnlyWhereItWasEvaluatedOnSome) {
  const design::PositionGainTrade trade{
      {control::LoopStructure::pi(), {0.254, 1.0, 6.0, 0.25}}, 2, 0, 9.5 * millidegree, 20};
  EXPECT_THAT(trade_in_words(trade, {}, "PI with lag", 9.4551 * millidegree, 30),
              AllOf(HasSubstr("PI with lag has kp at its bound:"),
                    HasSubstr("9.5000 mdeg, +0.5 %, with all constraints met on 20 of 30 plants")));
  EXPECT_THAT(
      trade_in_words(trade, {}, "PI with lag", 9.4551 * millidegree, 0),
      AllOf(HasSubstr("9.5000 mdeg, +0.5 %. Lower the upper bound of kp with [[tuning.bound]]"),
            Not(HasSubstr("plants"))));
}

}  // namespace
}  // namespace boresight::app
