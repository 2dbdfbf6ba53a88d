#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Companion matrix of the monic polynomial with these roots (closed under conjugation).
Eigen::MatrixXd companion(const std::vector<Complex>& roots) {
  std::vector<Complex> coefficients{1.0};  // ascending powers
  for (const Complex root : roots) {
    coefficients.insert(coefficients.begin(), 0.0);
    for (std::size_t i = 0; i + 1 < coefficients.size(); ++i) {
      coefficients[i] -= root * coefficients[i + 1];
    }
  }
  const auto n = static_cast<Eigen::Index>(roots.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i + 1 < n) matrix(i, i + 1) = 1.0;
    matrix(n - 1, i) = -coefficients[static_cast<std::size_t>(i)].real();
  }
  return matrix;
}

TEST(Eigenvalues, AreTheRootsOfACompanionMatrixInOrder) {
  // Sorted by magnitude, the lower half plane first.
  const std::vector<Complex> roots{0.0, {0.5, 0.0}, {-0.6, -0.8}, {-0.6, 0.8}, {-3.0, 0.0}};
  const Eigen::VectorXcd values = numerics::eigenvalues(companion(roots));
  ASSERT_EQ(values.size(), 5);
  for (Eigen::Index i = 0; i < 5; ++i) {
    EXPECT_LT(std::abs(values[i] - roots[static_cast<std::size_t>(i)]), 1e-13) << i;
  }
}

TEST(Eigenvalues, KeepTraceAndFollowAShift) {
  reference::RandomNumbers random(21);
  const Eigen::MatrixXd matrix = random.matrix(12, 12);
  const Eigen::VectorXcd values = numerics::eigenvalues(matrix);
  EXPECT_NEAR(values.sum().real(), matrix.trace(), 1e-12);
  EXPECT_NEAR(values.sum().imag(), 0.0, 1e-12);
  EXPECT_NEAR(numerics::spectral_abscissa(matrix - 2.5 * Eigen::MatrixXd::Identity(12, 12)),
              numerics::spectral_abscissa(matrix) - 2.5, 1e-12);
  EXPECT_DOUBLE_EQ(numerics::spectral_radius(matrix), values.cwiseAbs().maxCoeff());
  EXPECT_EQ(numerics::spectral_radius(Eigen::MatrixXd(0, 0)), 0.0);
}

TEST(EigenDecomposition, HasVectorsOnBothSidesThatAreBiorthogonal) {
  reference::RandomNumbers random(22);
  for (const Eigen::Index n : {1, 2, 7, 16}) {
    const Eigen::MatrixXd matrix = random.matrix(n, n);
    const auto [values, right, left, reciprocal_condition] = numerics::eigen_decomposition(matrix);
    const double size = matrix.norm() * right.norm() * left.norm();
    EXPECT_GT(reciprocal_condition, 0.01 / size);
    EXPECT_LE(reciprocal_condition, 1.0);
    EXPECT_LT((matrix * right - right * values.asDiagonal()).norm(), 1e-13 * size);
    EXPECT_LT((left.adjoint() * matrix - values.asDiagonal() * left.adjoint()).norm(),
              1e-13 * size);
    EXPECT_LT((left.adjoint() * right - Eigen::MatrixXcd::Identity(n, n)).norm(), 1e-13 * size);
    // Put together again they are the matrix.
    EXPECT_LT((right * values.asDiagonal() * left.adjoint() - matrix).norm(), 1e-12 * size);
    const Eigen::VectorXcd alone = numerics::eigenvalues(matrix);
    EXPECT_LT((values - alone).norm(), 1e-12 * matrix.norm());
  }
}

TEST(EigenDecomposition, RefusesADefectiveMatrix) {
  Eigen::MatrixXd jordan = Eigen::MatrixXd::Zero(2, 2);
  jordan(0, 1) = 1.0;
  EXPECT_THAT(reference::Call([&] { numerics::eigen_decomposition(jordan); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("defective")));
  Eigen::MatrixXd three = -2.0 * Eigen::MatrixXd::Identity(3, 3);
  three(0, 1) = three(1, 2) = 1.0;
  EXPECT_THROW(numerics::eigen_decomposition(three), NumericalFailure);
  EXPECT_EQ(numerics::eigenvalues(jordan).norm(), 0.0);  // values alone are no problem
}

TEST(EigenDecomposition, TakesARepeatedEigenvalueWithItsOwnVectors) {
  const auto result = numerics::eigen_decomposition(3.0 * Eigen::MatrixXd::Identity(4, 4));
  EXPECT_LT((result.values.array() - 3.0).matrix().norm(), 1e-14);
}

TEST(Eigenvalues, RefuseWhatIsNotASquareFiniteMatrix) {
  const Eigen::MatrixXd wide = Eigen::MatrixXd::Ones(2, 3);
  EXPECT_THAT(reference::Call([&] { numerics::eigenvalues(wide); }),
              ThrowsMessage<InvalidInput>(HasSubstr("eigenvalues: expected a square matrix")));
  EXPECT_THAT(reference::Call([&] { numerics::eigen_decomposition(wide); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2 x 3")));
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3);
    matrix(1, 2) = bad;
    EXPECT_THAT(reference::Call([&] { numerics::eigenvalues(matrix); }),
                ThrowsMessage<InvalidInput>(HasSubstr("not finite")));
    EXPECT_THROW(numerics::eigen_decomposition(matrix), InvalidInput);
    EXPECT_THROW(numerics::spectral_abscissa(matrix), InvalidInput);
  }
}

TEST(Eigenvalues, OfNothingAreNone) {
  EXPECT_EQ(numerics::eigenvalues(Eigen::MatrixXd(0, 0)).size(), 0);
  EXPECT_EQ(numerics::eigen_decomposition(Eigen::MatrixXd(0, 0)).values.size(), 0);
  EXPECT_THROW(numerics::spectral_abscissa(Eigen::MatrixXd(0, 0)), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
