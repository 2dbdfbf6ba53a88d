#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/decisions/pareto_front.hpp>
#include <boresight/design/decisions/tornado.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

TEST(ParetoFront, KeepsWhatNothingElseBeats) {
  //                       0           1           2           3           4           5
  EXPECT_THAT(
      pareto_front({{3.0, 1.0}, {1.0, 3.0}, {2.0, 2.0}, {2.0, 2.5}, {3.0, 2.0}, {4.0, 1.0}}),
      ElementsAre(1, 2, 0));
}

TEST(ParetoFront, LetsEqualPointsStandTogether) {
  EXPECT_THAT(pareto_front({{1.0, 2.0}, {2.0, 1.0}, {1.0, 2.0}, {2.0, 1.0}, {2.0, 2.0}}),
              ElementsAre(0, 2, 1, 3));
  EXPECT_THAT(pareto_front({{0.0, 5.0}, {0.0, 4.0}}), ElementsAre(1));  // one cost: the better
}

TEST(ParetoFront, TakesInfinityForTheWorst) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(pareto_front({{0.0, infinity}, {1.0, 2.0}, {2.0, infinity}}), ElementsAre(0, 1));
  EXPECT_THAT(pareto_front({}), IsEmpty());
}

TEST(ParetoFront, CountsTheSamplesInWhichAnOptionStands) {
  Eigen::MatrixXd quantities(4, 3);
  quantities << 3.0, 2.0, 1.0,  // all
      1.0, 2.0, 3.0,            // the cheapest alone
      2.0, 2.0, 1.0,            // cheapest and dearest
      2.0, 1.0, 1.0;            // cheapest and middle
  EXPECT_THAT(front_fractions({0.0, 1.0, 2.0}, quantities), ElementsAre(1.0, 0.5, 0.5));
}

TEST(ParetoFront, SaysWhatIsWrong) {
  const auto refusal = [](auto call) -> std::string {
    try {
      call();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(refusal([] {
                pareto_front({{0.0, 1.0}, {no_number, 1.0}});
              }),
              HasSubstr("found NaN in point 1"));
  EXPECT_THAT(refusal([] { pareto_front({{0.0, no_number}}); }), HasSubstr("NaN in point 0"));
  EXPECT_THAT(refusal([] {
                front_fractions({1.0, 2.0}, Eigen::MatrixXd::Ones(3, 1));
              }),
              HasSubstr("of 2 options (columns), as many as costs, found 3 x 1"));
  EXPECT_THAT(refusal([] { front_fractions({1.0}, Eigen::MatrixXd(0, 1)); }),
              HasSubstr("found 0 x 1"));
}

TEST(Tornado, SortsTheInputsByWhatEachDoesAlone) {
  const auto result = tornado(4, [](const std::vector<double>& x) {
    // The last is worst in the middle.
    return 2.0 * x[0] - 10.0 * x[1] - 4.0 * (x[3] - 0.5) * (x[3] - 0.5);
  });
  EXPECT_DOUBLE_EQ(result.at_median, -4.0);
  ASSERT_EQ(result.bars.size(), 4u);
  EXPECT_EQ(result.bars[0].input, 1u);
  EXPECT_DOUBLE_EQ(result.bars[0].at_low, 0.5);
  EXPECT_DOUBLE_EQ(result.bars[0].at_high, -8.5);
  EXPECT_DOUBLE_EQ(result.bars[0].swing, 9.0);
  EXPECT_EQ(result.bars[1].input, 0u);
  EXPECT_DOUBLE_EQ(result.bars[1].swing, 1.8);
  EXPECT_EQ(result.bars[2].input, 3u);
  EXPECT_NEAR(result.bars[2].swing, 4.0 * 0.45 * 0.45, 1e-12);
  EXPECT_EQ(result.bars[3].input, 2u);
  EXPECT_EQ(result.bars[3].swing, 0.0);
}

TEST(Tornado, SaysWhatIsWrong) {
  const auto first = [](const std::vector<double>& x) { return x[0]; };
  EXPECT_THROW(tornado(0, first), InvalidInput);
  EXPECT_THROW(tornado(1, first, 0.6, 0.9), InvalidInput);
  EXPECT_THROW(tornado(1, first, 0.05, 1.0), InvalidInput);
  try {
    tornado(2, [](const auto& x) { return x[1] > 0.9 ? no_number : 1.0; });
    FAIL() << "nothing was thrown";
  } catch (const NumericalFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("not finite with input 1 at its fraction 0.95"));
  }
}

}  // namespace
}  // namespace boresight::design
