#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/riccati_solution.hpp"
#include "refused_call.hpp"
#include <boresight/control/equations/riccati.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Eigen::MatrixXd;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Riccati, RefusesModesOnTheBoundaryThatNoWeightSees) {
  // An undamped oscillator beside a lag; only the lag is weighted.
  RiccatiProblem problem{MatrixXd::Zero(3, 3),
                         MatrixXd::Ones(3, 1),
                         MatrixXd::Zero(3, 3),
                         MatrixXd::Identity(1, 1),
                         {}};
  problem.a << 0.0, 3.0, 0.0, -3.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  problem.q(2, 2) = 1.0;
  EXPECT_THAT(reference::Call([&] { solve_riccati(problem); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("(A, Q) is not detectable"), HasSubstr("+- 3 j"))));
  problem.q.setIdentity();
  expect_solution(problem, false, solve_riccati(problem));
  problem.b.topRows(2).setZero();
  EXPECT_THAT(reference::Call([&] { solve_riccati(problem); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("(A, B) is not stabilisable"), HasSubstr("+- 3 j"))));
  // Sampled: the same on the unit circle.
  problem.a << 0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 0.3;
  EXPECT_THAT(reference::Call([&] { solve_discrete_riccati(problem); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("solve_discrete_riccati: (A, B)"), HasSubstr("0.6 +- 0.8 j"))));
  problem.b.setOnes();
  problem.q.topLeftCorner(2, 2).setZero();
  EXPECT_THAT(reference::Call([&] { solve_discrete_riccati(problem); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("(A, Q) is not detectable")));
}

TEST(Riccati, RefusesShapesNumbersAndWeights) {
  const RiccatiProblem good{-MatrixXd::Identity(2, 2),
                            MatrixXd::Ones(2, 1),
                            MatrixXd::Identity(2, 2),
                            MatrixXd::Identity(1, 1),
                            {}};
  const auto expect_refusal = [](const RiccatiProblem& problem, const char* message) {
    EXPECT_THAT(reference::Call([&] { solve_riccati(problem); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
    EXPECT_THAT(reference::Call([&] { solve_discrete_riccati(problem); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  RiccatiProblem bad = good;
  bad.a = MatrixXd::Ones(2, 3);
  expect_refusal(bad, "expected A as 2 x 2, found 2 x 3");
  bad = good;
  bad.q = MatrixXd::Ones(1, 1);
  expect_refusal(bad, "expected Q as 2 x 2");
  bad = good;
  bad.s = MatrixXd::Ones(1, 1);
  expect_refusal(bad, "expected S as 2 x 1");
  bad = good;
  bad.b = MatrixXd(2, 0);
  bad.r = MatrixXd(0, 0);
  expect_refusal(bad, "at least one state and one input");
  bad = good;
  bad.b(1, 0) = std::nan("");
  expect_refusal(bad, "B has elements that are not finite");
  bad = good;
  bad.r(0, 0) = 0.0;
  expect_refusal(bad, "R positive definite");
  bad.r(0, 0) = -1.0;
  expect_refusal(bad, "R: expected a positive semidefinite");
  bad = good;
  bad.q(0, 0) = -1.0;
  expect_refusal(bad, "Q: expected a positive semidefinite");
  bad = good;
  bad.q(0, 1) = 0.5;
  expect_refusal(bad, "Q: expected a symmetric matrix");
  bad = good;
  bad.s = 2.0 * MatrixXd::Ones(2, 1);
  expect_refusal(bad, "Q - S R^-1 S'");
}

}  // namespace
}  // namespace boresight::control
