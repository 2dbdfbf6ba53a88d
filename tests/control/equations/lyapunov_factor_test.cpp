#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/equations/lyapunov_factor.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LyapunovFactor, SquaredIsTheSolution) {
  reference::RandomNumbers random(71);
  for (int trial = 0; trial < 40; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = random.integer(1, 12);
    MatrixXd a = random.matrix(n, n);
    if (sampled) {
      a *= random.uniform(0.2, 0.99) / numerics::eigenvalues(a).cwiseAbs().maxCoeff();
    } else {
      a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.01, 1.0);
    }
    const MatrixXd b = random.matrix(n, random.integer(1, 15));
    const auto factor =
        lyapunov_factor("test", a, b, sampled ? TimeDomain::sampled : TimeDomain::continuous);
    const auto expected = sampled ? solve_discrete_lyapunov(a, b * b.transpose())
                                  : solve_lyapunov(a, b * b.transpose());
    const MatrixXd& p = expected.covariance;
    EXPECT_LT((factor.factor * factor.factor.adjoint() - p).norm(), 1e-12 * p.norm());
    EXPECT_DOUBLE_EQ(factor.stability_margin, expected.stability_margin);
    const MatrixXd lower = real_lyapunov_factor(factor);
    EXPECT_LT((lower * lower.transpose() - p).norm(), 1e-12 * p.norm());
    EXPECT_EQ(lower.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().norm(), 0.0);
  }
}

TEST(LyapunovFactor, OfSlicotsExampleIsItsCholeskyFactor) {
  reference::SlicotData data("SB03OD.dat");
  const MatrixXd a = data.next_matrix(4, 4);
  const MatrixXd b = data.next_matrix(5, 4);
  const auto factor = lyapunov_factor("test", a.transpose(), b.transpose(), TimeDomain::continuous);
  MatrixXd lower = real_lyapunov_factor(factor);
  const auto printed =
      reference::slicot_result("SB03OD.res", "The transpose of the Cholesky factor U is");
  for (Index j = 0; j < 4; ++j) {
    if (lower(j, j) < 0.0) lower.col(j) *= -1.0;  // each column up to its sign
    for (Index i = j; i < 4; ++i) {
      const auto& number = printed[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      EXPECT_NEAR(lower(i, j), number.value, number.half_unit);
    }
  }
}

TEST(LyapunovFactor, KeepsSmallSingularValuesThatTheProductLoses) {
  // A chain of lags far faster one than the other, each weakly driven by the last: the covariance
  // has eigenvalues down to 1e-24 of the largest. Scaling the last states by powers of two leaves
  // every element of the factor exact relative to itself.
  const Index n = 5;
  MatrixXd a = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    a(i, i) = -1.0 - static_cast<double>(i);
    if (i > 0) a(i, i - 1) = 1e-3;
  }
  MatrixXd b = MatrixXd::Zero(n, 1);
  b(0, 0) = 1.0;
  const auto factor = lyapunov_factor("test", a, b, TimeDomain::continuous);
  const MatrixXd lower = real_lyapunov_factor(factor);
  Eigen::VectorXd scale(n);
  MatrixXd scaled_a = a;
  for (Index i = 0; i < n; ++i) {
    scale[i] = std::pow(1e-3, static_cast<double>(i));
    if (i > 0) scaled_a(i, i - 1) = 1.0;
  }
  const MatrixXd well =
      real_lyapunov_factor(lyapunov_factor("test", scaled_a, b, TimeDomain::continuous));
  for (Index j = 0; j < n; ++j) {
    EXPECT_NEAR(std::abs(lower(j, j)), scale[j] * std::abs(well(j, j)),
                1e-9 * scale[j] * std::abs(well(j, j)));
  }
}

TEST(LyapunovFactor, IsTheSameInAnyUnits) {
  reference::RandomNumbers random(72);
  MatrixXd a = random.matrix(5, 5);
  a.diagonal().array() -= numerics::spectral_abscissa(a) + 0.2;
  const MatrixXd b = random.matrix(5, 2);
  Eigen::VectorXd unit(5);
  unit << 0x1p-30, 0x1p20, 1.0, 0x1p7, 0x1p33;
  const MatrixXd plain =
      lyapunov_factor("test", a, b, Eigen::VectorXd::Ones(5), TimeDomain::continuous)
          .factor.cwiseAbs();
  const MatrixXd scaled =
      lyapunov_factor("test", unit.asDiagonal() * a * unit.cwiseInverse().asDiagonal(),
                      unit.asDiagonal() * b, unit, TimeDomain::continuous)
          .factor.cwiseAbs();
  EXPECT_EQ((unit.cwiseInverse().asDiagonal() * scaled - plain).norm(), 0.0);
}

TEST(LyapunovFactor, OfAnUndrivenSystemIsZero) {
  const MatrixXd a = -MatrixXd::Identity(3, 3);
  const auto none = lyapunov_factor("test", a, MatrixXd(3, 0), TimeDomain::continuous);
  EXPECT_EQ(none.factor.norm(), 0.0);
  const auto dead_beat =
      lyapunov_factor("test", MatrixXd::Zero(2, 2), MatrixXd::Identity(2, 2), TimeDomain::sampled);
  EXPECT_LT((dead_beat.factor * dead_beat.factor.adjoint() - MatrixXcd::Identity(2, 2)).norm(),
            1e-15);
}

TEST(LyapunovFactor, RefusesShapesNumbersAndInstability) {
  const MatrixXd a = -MatrixXd::Identity(2, 2);
  EXPECT_THAT(reference::Call([&] {
                lyapunov_factor("caller", a, MatrixXd::Ones(3, 1), TimeDomain::continuous);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("caller: expected a square A")));
  EXPECT_THROW(lyapunov_factor("caller", a, a, Eigen::VectorXd::Ones(3), TimeDomain::continuous),
               InvalidInput);
  EXPECT_THROW(lyapunov_factor("caller", MatrixXd(0, 0), MatrixXd(0, 1), TimeDomain::sampled),
               InvalidInput);
  EXPECT_THROW(lyapunov_factor("caller", a * std::nan(""), a, TimeDomain::sampled), InvalidInput);
  EXPECT_THAT(reference::Call([&] { lyapunov_factor("caller", -a, a, TimeDomain::continuous); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("found one at 1")));
  EXPECT_THAT(reference::Call([&] {
                triangular_lyapunov_factor(a.cast<std::complex<double>>(), MatrixXcd(1, 1),
                                           TimeDomain::continuous);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("as many rows of B")));
}

}  // namespace
}  // namespace boresight::control
