#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

void expect_schur_form(const MatrixXd& a) {
  const numerics::RealSchur schur = numerics::real_schur(a);
  const Index n = a.rows();
  ASSERT_EQ(schur.t.rows(), n);
  ASSERT_EQ(schur.u.rows(), n);
  const double tolerance = 1e-14 * std::sqrt(static_cast<double>(n) + 1.0);
  EXPECT_LE((schur.u * schur.t * schur.u.transpose() - a).norm(), tolerance * a.norm());
  EXPECT_LE((schur.u.transpose() * schur.u - MatrixXd::Identity(n, n)).norm(),
            tolerance * std::sqrt(static_cast<double>(n)));
  for (Index j = 0; j < n; ++j) {
    for (Index i = j + 2; i < n; ++i) ASSERT_EQ(schur.t(i, j), 0.0);
    if (j + 1 == n || schur.t(j + 1, j) == 0.0) continue;
    EXPECT_EQ(schur.t(j, j), schur.t(j + 1, j + 1));
    EXPECT_LT(schur.t(j, j + 1) * schur.t(j + 1, j), 0.0);
    if (j + 2 < n) {
      EXPECT_EQ(schur.t(j + 2, j + 1), 0.0);
    }
  }
  const numerics::RealSchur other = numerics::transposed(schur);
  EXPECT_LE((other.u * other.t * other.u.transpose() - a.transpose()).norm(), tolerance * a.norm());
  for (Index j = 0; j + 1 < n; ++j) {
    if (other.t(j + 1, j) != 0.0) {
      EXPECT_EQ(other.t(j, j), other.t(j + 1, j + 1));
    }
  }
  const numerics::ComplexSchur split = numerics::complex_schur(schur);
  EXPECT_LE((split.u * split.t * split.u.adjoint() - a).norm(), 2.0 * tolerance * a.norm());
  EXPECT_EQ(split.t.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm(), 0.0);
  EXPECT_EQ((split.t.diagonal() - numerics::schur_eigenvalues(schur.t)).norm(), 0.0);
}

TEST(RealSchur, OfRandomMatrices) {
  reference::RandomNumbers random(41);
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = random.integer(1, 30);
    expect_schur_form(random.matrix(n, n));
  }
  expect_schur_form(random.matrix(90, 90));
}

TEST(RealSchur, OfMatricesThatAreHardOnTheIteration) {
  reference::RandomNumbers random(42);
  for (const Index n : {2, 3, 4, 5, 8, 13, 30}) {
    // Every eigenvalue on one circle: shifts from the last block do not move at first.
    MatrixXd cyclic = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) cyclic(i, (i + 1) % n) = 1.0;
    expect_schur_form(cyclic);
    MatrixXd chain = cyclic;
    chain(n - 1, 0) = 0.0;
    expect_schur_form(chain);
    expect_schur_form(chain.transpose());
    expect_schur_form(MatrixXd::Ones(n, n));
    expect_schur_form(MatrixXd::Identity(n, n));
    expect_schur_form(MatrixXd::Zero(n, n));
    const MatrixXd any = random.matrix(n, n);
    expect_schur_form(any + any.transpose());
    expect_schur_form(any - any.transpose());
    // Repeated and nearly repeated eigenvalues in a basis of their own.
    const MatrixXd close = any * chain * any.transpose() + 1e-9 * any;
    expect_schur_form(close);
    // Elements of a few values only: exact cancellations.
    expect_schur_form(any.unaryExpr([](double x) { return std::round(x); }));
  }
}

TEST(RealSchur, OfManyEqualEigenvaluesFarBelowTheNorm) {
  // As an observer's copies of its plant bring them. Rounding of the norm's size stands in the
  // place of subdiagonal elements that would have to fall to that of the eigenvalues.
  for (std::uint64_t seed = 500; seed < 560; ++seed) {
    reference::RandomNumbers random(seed);
    constexpr Index copies = 6, size = 8, n = copies * size;
    const MatrixXd one = 0.05 * random.matrix(size, size);
    MatrixXd a = MatrixXd::Zero(n, n);
    for (Index i = 0; i < copies; ++i) a.block(size * i, size * i, size, size) = one;
    a(0, n - 1) = 20.0;
    for (int turn = 0; turn < 8; ++turn) {
      const Eigen::VectorXd v = random.matrix(n, 1).normalized();
      a -= 2.0 * v * (v.transpose() * a).eval();
      a -= 2.0 * (a * v).eval() * v.transpose();
    }
    expect_schur_form(a);
  }
}

TEST(RealSchur, OfSizesNearTheLimitsOfNumbers) {
  reference::RandomNumbers random(43);
  const MatrixXd any = random.matrix(7, 7);
  const numerics::RealSchur plain = numerics::real_schur(any);
  for (const double factor : {0x1p-900, 0x1p-300, 0x1p300, 0x1p1000}) {
    const numerics::RealSchur scaled = numerics::real_schur(factor * any);
    EXPECT_EQ((scaled.u - plain.u).norm(), 0.0);
    EXPECT_EQ((scaled.t / factor - plain.t).norm(), 0.0);
  }
}

TEST(RealSchur, KeepsTheSmallEigenvaluesOfAGradedMatrix) {
  Eigen::Matrix3d graded;
  graded << 1.0, 1e-3, 0.0, 1e-9, 1e-6, 1e-9, 0.0, 1e-15, 1e-12;
  Eigen::VectorXcd values = numerics::schur_eigenvalues(numerics::real_schur(graded).t);
  std::sort(values.data(), values.data() + values.size(),
            [](auto left, auto right) { return std::abs(left) > std::abs(right); });
  // Perturbation theory to second order: each pair of neighbours repels by its product over its
  // distance.
  EXPECT_NEAR(values[0].real(), 1.0 + 1e-12, 1e-15);
  EXPECT_NEAR(values[1].real() / 1e-6, 1.0 - 1e-6, 1e-11);
  EXPECT_NEAR(values[2].real() / 1e-12, 1.0 - 1e-6, 1e-11);
}

TEST(RealSchur, EigenvaluesAgreeWithThoseOfAnotherAlgorithm) {
  reference::RandomNumbers random(44);
  for (int trial = 0; trial < 20; ++trial) {
    const MatrixXd any = random.matrix(9, 9);
    Eigen::VectorXcd values = numerics::schur_eigenvalues(numerics::real_schur(any).t);
    const Eigen::VectorXcd expected = numerics::eigenvalues(any);
    for (Index i = 0; i < 9; ++i) {
      EXPECT_LT((values.array() - expected[i]).abs().minCoeff(), 1e-11);
    }
    EXPECT_NEAR(values.sum().real(), any.trace(), 1e-13);
    EXPECT_NEAR(values.sum().imag(), 0.0, 1e-15);
  }
}

TEST(RealSchur, OfAKnownPairAndOfNothing) {
  Eigen::Matrix2d oscillator;
  oscillator << 0.0, 1.0, -100.0, -0.2;
  const Eigen::VectorXcd values = numerics::schur_eigenvalues(numerics::real_schur(oscillator).t);
  EXPECT_NEAR(values[0].real(), -0.1, 1e-14);
  EXPECT_NEAR(values[0].imag(), std::sqrt(100.0 - 0.01), 1e-13);
  EXPECT_EQ(values[1], std::conj(values[0]));
  EXPECT_EQ(numerics::real_schur(MatrixXd(0, 0)).t.size(), 0);
  EXPECT_EQ(numerics::schur_eigenvalues(MatrixXd(0, 0)).size(), 0);
  EXPECT_EQ(numerics::complex_schur(numerics::real_schur(MatrixXd(0, 0))).t.size(), 0);
}

TEST(RealSchur, RefusesWhatIsNotSquareOrNotFinite) {
  EXPECT_THAT(reference::Call([] { numerics::real_schur(MatrixXd::Ones(2, 3)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2 x 3")));
  MatrixXd matrix = MatrixXd::Identity(3, 3);
  matrix(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(reference::Call([&] { numerics::real_schur(matrix); }),
              ThrowsMessage<InvalidInput>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace boresight::plant
