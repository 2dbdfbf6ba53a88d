#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/design/tuning/active_multipliers.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(NonnegativeLeastSquares, MeetsTheConditionsOfALeast) {
  reference::RandomNumbers random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const int rows = random.integer(1, 12), columns = random.integer(1, 15);
    const Eigen::MatrixXd matrix = random.matrix(rows, columns);
    const Eigen::VectorXd right = random.matrix(rows, 1);
    const Eigen::VectorXd x = nonnegative_least_squares(matrix, right);
    const Eigen::VectorXd pull = matrix.transpose() * (right - matrix * x);
    for (Eigen::Index k = 0; k < columns; ++k) {
      EXPECT_GE(x[k], 0.0);
      EXPECT_LE(pull[k], 1e-8) << "one that is held back pushes further back";
      EXPECT_NEAR(x[k] * pull[k], 0.0, 1e-8) << "one that is free is balanced";
    }
  }
}

TEST(NonnegativeLeastSquares, BearsColumnsThatDependOnOneAnother) {
  Eigen::MatrixXd twins(2, 3);
  twins << 1.0, 1.0, 0.0, 2.0, 2.0, 0.0;
  const Eigen::VectorXd x = nonnegative_least_squares(twins, Eigen::Vector2d(1.0, 2.0));
  EXPECT_NEAR(x[0] + x[1], 1.0, 1e-9);
  EXPECT_EQ(x[2], 0.0);
  EXPECT_EQ(nonnegative_least_squares(Eigen::MatrixXd(2, 0), Eigen::Vector2d(1.0, 2.0)).size(), 0);
}

TEST(ActiveMultipliers, ArePricesOfTheConstraints) {
  // x^2 + y^2 with 4 - x - y <= 0 and x <= 1: least at (1, 3), cost 10. Relaxed by d each:
  // (4 - d - 1)^2 + 1 falls by 6 d; x up to 1 + d, y down to 3 - d, falls by 4 d.
  ActiveSet active;
  active.objectives = Eigen::RowVector2d(2.0, 6.0);
  active.constraints = Eigen::RowVector2d(-1.0, -1.0);
  active.at_lower = {false, false};
  active.at_upper = {true, false};
  const Multipliers found = active_multipliers(active);
  EXPECT_NEAR(found.constraints[0], 6.0, 1e-9);
  EXPECT_NEAR(found.upper[0], 4.0, 1e-9);
  EXPECT_EQ(found.lower.sum(), 0.0);
  EXPECT_NEAR(found.objectives[0], 1.0, 1e-9);
  EXPECT_LT(found.residual, 1e-9);
}

TEST(ActiveMultipliers, WeightTheObjectivesThatMeetAtAKink) {
  // The larger of x and -2 x meets at 0: weights 2/3 and 1/3.
  ActiveSet active;
  active.objectives = Eigen::Vector2d(1.0, -2.0);
  active.at_lower = active.at_upper = {false};
  const Multipliers found = active_multipliers(active);
  EXPECT_NEAR(found.objectives[0], 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(found.objectives[1], 1.0 / 3.0, 1e-9);
}

TEST(ActiveMultipliers, SayWhereThereIsNoMinimum) {
  ActiveSet active;
  active.objectives = Eigen::RowVector2d(1.0, 0.0);
  active.constraints = Eigen::RowVector2d(1.0, 0.0);  // pulls the same way
  active.at_lower = active.at_upper = {false, false};
  const Multipliers found = active_multipliers(active);
  EXPECT_EQ(found.constraints[0], 0.0);
  EXPECT_NEAR(found.residual, 1.0, 1e-9);
  active.at_lower.pop_back();
  EXPECT_THAT(reference::Call([&] { active_multipliers(active); }),
              ThrowsMessage<InvalidInput>(HasSubstr("bounds of 1 and 2")));
}

}  // namespace
}  // namespace boresight::design
