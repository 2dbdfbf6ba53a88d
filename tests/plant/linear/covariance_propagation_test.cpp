#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/covariance_propagation.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Eigen::MatrixXd one(double value) {
  return Eigen::MatrixXd::Constant(1, 1, value);
}

TEST(PropagatedCovariance, OfOneStateIsTheClosedForm) {
  // P(t) = e^(-2at) p + q (1 - e^(-2at))/(2a)
  for (const double a : {-3.0, -1e-6, 2.0, -1e5}) {
    const double p = 0.7, q = 5.0, t = 0.8;
    const auto found = propagate_covariance(one(a), one(q), one(p), t);
    const double grown = std::expm1(2.0 * a * t);
    const double end = p * (1.0 + grown) + q * grown / (2.0 * a);
    EXPECT_NEAR(found.end(0, 0), end, 1e-13 * end);
    const double mean = (p * grown + q * (grown / (2.0 * a) - t)) / (2.0 * a * t);
    // (The formula itself cancels for the slow pole.)
    EXPECT_NEAR(found.mean(0, 0), mean, (a == -1e-6 ? 1e-8 : 1e-12) * mean) << a;
  }
  // Brownian motion: p + q t, mean p + q t/2.
  const auto walk = propagate_covariance(one(0.0), one(2.0), one(3.0), 0.5);
  EXPECT_DOUBLE_EQ(walk.end(0, 0), 4.0);
  EXPECT_DOUBLE_EQ(walk.mean(0, 0), 3.5);
}

TEST(PropagatedCovariance, OfABodyPushedByNoiseIsThePolynomial) {
  Eigen::Matrix2d a = Eigen::Matrix2d::Zero(), w = Eigen::Matrix2d::Zero();
  a(0, 1) = 1.0;
  w(1, 1) = 3.0;
  const double t = 2.0;
  const auto found = propagate_covariance(a, w, Eigen::Matrix2d::Zero(), t);
  EXPECT_NEAR(found.end(0, 0), 3.0 * t * t * t / 3.0, 1e-13);
  EXPECT_NEAR(found.end(0, 1), 3.0 * t * t / 2.0, 1e-13);
  EXPECT_NEAR(found.end(1, 1), 3.0 * t, 1e-13);
  EXPECT_NEAR(found.mean(0, 0), 3.0 * t * t * t / 12.0, 1e-13);
  EXPECT_EQ(found.end, found.end.transpose());
}

TEST(PropagatedCovariance, SolvesItsEquationAndAddsUp) {
  reference::RandomNumbers random(91);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Index n = random.integer(1, 6);
    const Eigen::MatrixXd a = random.log_uniform(0.1, 30.0) * random.matrix(n, n);
    const Eigen::MatrixXd b = random.matrix(n, 2), s = random.matrix(n, n);
    const Eigen::MatrixXd w = b * b.transpose(), start = s * s.transpose();
    const double t = random.uniform(0.05, 0.3);
    const auto found = propagate_covariance(a, w, start, t);
    // The integral of P' = A P + P A' + W over 0..t.
    const Eigen::MatrixXd change = t * (a * found.mean + found.mean * a.transpose() + w);
    EXPECT_LT((found.end - start - change).norm(), 1e-11 * (found.end.norm() + change.norm()));
    // In two parts.
    const auto first = propagate_covariance(a, w, start, 0.3 * t);
    const auto second = propagate_covariance(a, w, first.end, 0.7 * t);
    EXPECT_LT((second.end - found.end).norm(), 1e-12 * found.end.norm());
    EXPECT_LT((0.3 * first.mean + 0.7 * second.mean - found.mean).norm(),
              1e-12 * found.mean.norm());
    EXPECT_GT(numerics::eigenvalues(found.end).real().minCoeff(), -1e-13 * found.end.norm());
  }
}

TEST(PropagatedCovariance, OfPolesFastAgainstTheTimeIsTheSteadyState) {
  // A textbook Van Loan exponential would hold e^2000 here.
  Eigen::Matrix2d a;
  a << -1000.0, 300.0, 0.0, -2000.0;
  Eigen::Matrix2d w;
  w << 2.0, 0.5, 0.5, 1.0;
  const auto found = propagate_covariance(a, w, 1e3 * Eigen::Matrix2d::Identity(), 1.0);
  EXPECT_LT((a * found.end + found.end * a.transpose() + w).norm(), 1e-13);
}

TEST(PropagatedCovariance, RefusesWhatHasNoMeaning) {
  EXPECT_THAT(reference::Call([] { propagate_covariance(one(1.0), one(1.0), one(1.0), 0.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 0 s")));
  EXPECT_THAT(
      reference::Call([] { propagate_covariance(one(1.0), Eigen::MatrixXd(2, 2), one(1.0), 1.0); }),
      ThrowsMessage<InvalidInput>(HasSubstr("2 x 2")));
  EXPECT_THROW(propagate_covariance(one(std::nan("")), one(1.0), one(1.0), 1.0), InvalidInput);
  EXPECT_THROW(propagate_covariance(one(1e4), one(1.0), one(1.0), 1.0), NumericalFailure);
  EXPECT_EQ(
      propagate_covariance(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0), 1.0)
          .end.size(),
      0);
}

}  // namespace
}  // namespace boresight::plant
