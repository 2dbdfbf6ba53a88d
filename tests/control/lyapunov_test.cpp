#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../random_numbers.hpp"
#include <boresight/control/lyapunov.hpp>
#include <boresight/plant/eigenvalues.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Lyapunov, OfOneState) {
  const auto solution =
      solve_lyapunov(Eigen::MatrixXd::Constant(1, 1, -2.0), Eigen::MatrixXd::Constant(1, 1, 3.0));
  EXPECT_DOUBLE_EQ(solution.covariance(0, 0), 0.75);
  EXPECT_DOUBLE_EQ(solution.stability_margin, 2.0);
}

TEST(Lyapunov, OfAnOscillatorInWhiteNoise) {
  // x'' + 2 z w x' + w^2 x = n with intensity q: E x^2 = q/(4 z w^3), E x'^2 = q/(4 z w), E xx' =
  // 0.
  const double w = 3.7, z = 0.01, q = 2.0;
  Eigen::Matrix2d a, noise = Eigen::Matrix2d::Zero();
  a << 0.0, 1.0, -w * w, -2.0 * z * w;
  noise(1, 1) = q;
  const auto [p, residual, margin] = solve_lyapunov(a, noise);
  EXPECT_NEAR(p(0, 0), q / (4.0 * z * w * w * w), 1e-12 * p(0, 0));
  EXPECT_NEAR(p(1, 1), q / (4.0 * z * w), 1e-12 * p(1, 1));
  EXPECT_NEAR(p(0, 1), 0.0, 1e-12 * p(1, 1));
  EXPECT_NEAR(margin, z * w, 1e-12);
}

TEST(Lyapunov, SolvesItsEquationForRandomStableMatrices) {
  reference::RandomNumbers random(31);
  for (const Eigen::Index n : {1, 2, 3, 8, 20, 35}) {
    Eigen::MatrixXd a = random.matrix(n, n);
    a.diagonal().array() -= plant::spectral_abscissa(a) + random.log_uniform(0.01, 1.0);
    const Eigen::MatrixXd b = random.matrix(n, 2);
    const Eigen::MatrixXd q = b * b.transpose();
    const auto [p, residual, margin] = solve_lyapunov(a, q);
    EXPECT_LT((a * p + p * a.transpose() + q).norm(), 1e-12 * (a.norm() * p.norm() + q.norm()));
    EXPECT_LT(residual, 1e-13);
    EXPECT_EQ((p - p.transpose()).norm(), 0.0);
    EXPECT_NEAR(margin, -plant::spectral_abscissa(a), 1e-9);
    // A covariance is positive semidefinite.
    EXPECT_GT(plant::eigenvalues(p).real().minCoeff(), -1e-12 * p.norm());
  }
}

TEST(Lyapunov, FollowsAChangeOfBasisAndScalesWithTheNoise) {
  reference::RandomNumbers random(32);
  Eigen::MatrixXd a = random.matrix(6, 6);
  a.diagonal().array() -= plant::spectral_abscissa(a) + 0.3;
  const Eigen::MatrixXd b = random.matrix(6, 1);
  const Eigen::MatrixXd q = b * b.transpose();
  const Eigen::MatrixXd p = solve_lyapunov(a, q).covariance;
  EXPECT_LT((solve_lyapunov(a, 9.0 * q).covariance - 9.0 * p).norm(), 1e-12 * p.norm());
  const Eigen::VectorXd scale = Eigen::VectorXd::LinSpaced(6, -2.0, 2.0).array().exp();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * a * scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd expected = scale.asDiagonal() * p * scale.asDiagonal();
  const Eigen::MatrixXd found =
      solve_lyapunov(scaled, scale.asDiagonal() * q * scale.asDiagonal()).covariance;
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
}

TEST(Lyapunov, RefusesAMatrixThatIsNotStableAndSaysByHowMuch) {
  const Eigen::MatrixXd q = Eigen::MatrixXd::Identity(2, 2);
  Eigen::Matrix2d unstable;
  unstable << 0.25, 1.0, 0.0, -1.0;
  EXPECT_THAT([&] { solve_lyapunov(unstable, q); },
              ThrowsMessage<NumericalFailure>(HasSubstr("0.25")));
  Eigen::Matrix2d integrator;
  integrator << 0.0, 1.0, 0.0, -1.0;
  EXPECT_THAT([&] { solve_lyapunov(integrator, q); },
              ThrowsMessage<NumericalFailure>(HasSubstr("remove integrators")));
  Eigen::Matrix2d oscillator;
  oscillator << 0.0, 1.0, -4.0, 0.0;
  EXPECT_THROW(solve_lyapunov(oscillator, q), NumericalFailure);
}

TEST(Lyapunov, RefusesShapesAndNumbersThatDoNotFit) {
  const Eigen::MatrixXd stable = -Eigen::MatrixXd::Identity(2, 2);
  EXPECT_THAT([&] { solve_lyapunov(stable, Eigen::MatrixXd::Identity(3, 3)); },
              ThrowsMessage<InvalidInput>(HasSubstr("2 x 2 and 3 x 3")));
  EXPECT_THROW(solve_lyapunov(Eigen::MatrixXd::Ones(2, 3), stable), InvalidInput);
  EXPECT_THROW(solve_lyapunov(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0)), InvalidInput);
  EXPECT_THROW(solve_lyapunov(stable * std::nan(""), stable), InvalidInput);
  EXPECT_THROW(solve_lyapunov(stable, stable * HUGE_VAL), InvalidInput);
}

}  // namespace
}  // namespace boresight::control
