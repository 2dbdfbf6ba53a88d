#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include <boresight/control/equations/mode_distance.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/eigenvalues.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double tolerance = 1e-12;

ModeDistance distance_of(const MatrixXd& a, const MatrixXd& b,
                         TimeDomain domain = TimeDomain::continuous) {
  return {numerics::real_schur(a), b, a.norm(), domain};
}

// A random orthogonal matrix: the product of reflections.
MatrixXd rotation(reference::RandomNumbers& random, Index n) {
  MatrixXd q = MatrixXd::Identity(n, n);
  for (Index k = 0; k < n; ++k) {
    const Eigen::VectorXd v = random.matrix(n, 1).normalized();
    q -= (2.0 * q * v) * v.transpose();
  }
  return q;
}

TEST(ModeDistance, FindsTheUnreachedUnstablePartInAnyBasis) {
  reference::RandomNumbers random(91);
  for (int trial = 0; trial < 40; ++trial) {
    const Index reached = random.integer(1, 7);
    const Index out = random.integer(1, 4);
    const Index n = reached + out;
    MatrixXd a = random.matrix(n, n);
    a.bottomLeftCorner(out, reached).setZero();
    MatrixXd b = MatrixXd::Zero(n, random.integer(1, 2));
    b.topRows(reached) = random.matrix(reached, b.cols());
    const MatrixXd q = rotation(random, n);
    const Eigen::VectorXcd expected = numerics::eigenvalues(a.bottomRightCorner(out, out));
    Index listed = 0;
    for (const auto& mode :
         distance_of(q * a * q.transpose(), q * b).unreached_unstable(tolerance)) {
      EXPECT_LT((expected.array() - mode.eigenvalue).abs().minCoeff(), 1e-11);
      listed += mode.eigenvalue.imag() == 0.0 ? 1 : 2;
    }
    EXPECT_EQ(listed, (expected.array().real() > 0.0).count());
  }
}

TEST(ModeDistance, SeesThroughAChainSharedByBothParts) {
  // A double integrator that nothing drives feeds one that the input drives: four equal
  // eigenvalues in one chain. Computed, they scatter by the fourth root of rounding; their mean
  // does not.
  reference::RandomNumbers random(92);
  MatrixXd a = MatrixXd::Zero(4, 4), b = MatrixXd::Zero(4, 1);
  a(0, 1) = a(1, 2) = a(2, 3) = 1.0;
  b(1, 0) = 1.0;
  for (int trial = 0; trial < 20; ++trial) {
    const MatrixXd q = rotation(random, 4);
    const double shift = trial % 2 == 0 ? 0.0 : 0.5;
    const MatrixXd turned = q * a * q.transpose() + shift * MatrixXd::Identity(4, 4);
    const auto unreached = distance_of(turned, q * b).unreached_unstable(tolerance);
    ASSERT_FALSE(unreached.empty()) << trial;
    for (const auto& mode : unreached) EXPECT_LT(std::abs(mode.eigenvalue - shift), 1e-12);
    b(3, 0) = 1.0;
    EXPECT_TRUE(distance_of(turned, q * b).unreached_unstable(tolerance).empty());
    b(3, 0) = 0.0;
  }
}

TEST(ModeDistance, IsTheSmallestSingularValue) {
  reference::RandomNumbers random(93);
  for (int trial = 0; trial < 30; ++trial) {
    const Index n = random.integer(2, 9);
    const MatrixXd a = random.matrix(n, n);
    MatrixXd b = random.matrix(n, random.integer(1, 3));
    auto distance = distance_of(a, b);
    for (Index j = 0; j < b.cols(); ++j) b.col(j) *= a.norm() / b.col(j).norm();
    for (const Complex s : numerics::eigenvalues(a)) {
      // sigma^2 as the smallest eigenvalue of the real form of M M^H.
      MatrixXcd m(n, n + b.cols());
      m.leftCols(n) = a.cast<Complex>() - s * MatrixXcd::Identity(n, n);
      m.rightCols(b.cols()) = b.cast<Complex>();
      const MatrixXcd square = m * m.adjoint();
      MatrixXd real(2 * n, 2 * n);
      real << square.real(), -square.imag(), square.imag(), square.real();
      const double smallest = std::sqrt(numerics::eigenvalues(real).real().minCoeff()) / a.norm();
      // Inverse iteration ends within 1 % of itself, not of the limit.
      EXPECT_NEAR(distance.test(s).distance / smallest, 1.0, 0.1);
    }
  }
}

TEST(ModeDistance, GrowsInProportionToTheCoupling) {
  // [A - 2, B] is [-3 0 r; 0 0 c r] with r = |A| = sqrt(5): for small c its smallest singular value
  // is c r sqrt(9/14).
  for (const double coupling : {1e-3, 1e-6, 1e-9}) {
    MatrixXd a = MatrixXd::Zero(2, 2), b(2, 1);
    a(0, 0) = -1.0;
    a(1, 1) = 2.0;
    b << 1.0, coupling;
    auto distance = distance_of(a, b);
    EXPECT_TRUE(distance.unreached_unstable(tolerance).empty());
    EXPECT_NEAR(distance.test(2.0).distance / coupling, std::sqrt(9.0 / 14.0), 1e-5);
  }
}

TEST(ModeDistance, TellsStableByTheDomain) {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  const auto continuous = distance_of(one, one);
  EXPECT_TRUE(continuous.stable({-0.1, 5.0}));
  EXPECT_FALSE(continuous.stable({0.0, 5.0}));
  EXPECT_FALSE(continuous.stable(0.5));
  const auto sampled = distance_of(one, one, TimeDomain::sampled);
  EXPECT_TRUE(sampled.stable({0.5, -0.5}));
  EXPECT_FALSE(sampled.stable({0.6, 0.8}));
  EXPECT_FALSE(sampled.stable(-2.0));
}

TEST(ModeDistance, OfExtremes) {
  // Integrators, one of them reached.
  MatrixXd b = MatrixXd::Zero(30, 1);
  b(0, 0) = 1.0;
  EXPECT_FALSE(distance_of(MatrixXd::Zero(30, 30), b).unreached_unstable(tolerance).empty());
  // A long chain without any input, and with one at its head.
  MatrixXd chain = MatrixXd::Zero(40, 40);
  for (Index i = 0; i + 1 < 40; ++i) chain(i, i + 1) = 1.0;
  b = MatrixXd::Zero(40, 1);
  EXPECT_FALSE(distance_of(chain, b).unreached_unstable(tolerance).empty());
  EXPECT_FALSE(distance_of(chain, MatrixXd(40, 0)).unreached_unstable(tolerance).empty());
  b(39, 0) = 1.0;
  EXPECT_TRUE(distance_of(chain, b).unreached_unstable(tolerance).empty());
}

// Balancing takes a rounding error within a chain of lags for a coupling and scales the head's
// input out of sight; in the states as given every mode is reached.
TEST(ModeDistance, IsConfirmedInTheStatesAsGiven) {
  constexpr Index stages = 6, n = stages + 2;
  MatrixXd a = MatrixXd::Zero(n, n), b = MatrixXd::Zero(n, 1);
  for (Index i = 0; i < stages; ++i) {
    a(i, i) = -0.01 * std::pow(5.0, static_cast<double>(i));
    for (Index j = 0; j < i; ++j) {
      a(i, j) = -0.2 * a(i, i) / (1.0 + static_cast<double>(i - j));
    }
  }
  a(0, 1) = 1e-18;
  a(stages, stages - 1) = 70.0;
  a(stages, stages) = a(stages + 1, stages + 1) = -0.5;
  a(stages, stages + 1) = 3.0;
  a(stages + 1, stages) = -3.0;
  b(0, 0) = 1.0;
  const Eigen::VectorXd scale = numerics::balancing_scale(a);
  auto balanced = distance_of(scale.cwiseInverse().asDiagonal() * a * scale.asDiagonal(),
                              scale.cwiseInverse().asDiagonal() * b);
  std::vector<ModeDistance::Mode> suspected;
  for (const Complex s : numerics::eigenvalues(a)) {
    const auto mode = balanced.test(s);
    if (mode.distance <= tolerance) suspected.push_back(mode);
  }
  EXPECT_FALSE(suspected.empty());
  EXPECT_TRUE(confirm_unreached(suspected, a, b, TimeDomain::continuous, tolerance).empty());
}

}  // namespace
}  // namespace boresight::control
