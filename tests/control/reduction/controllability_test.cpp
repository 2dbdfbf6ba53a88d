#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/chain_with_rounding_error.hpp"
#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/control/reduction/controllability.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using testing::ElementsAre;
using testing::HasSubstr;

plant::StateSpace system_of(const MatrixXd& a, const MatrixXd& b, double sample_time = 0.0) {
  return reference::state_space(a, b, MatrixXd::Identity(a.rows(), a.rows()),
                                MatrixXd::Zero(a.rows(), b.cols()), sample_time);
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

TEST(Controllability, OfAParallelPairOfEqualLags) {
  // Two equal lags on one input: their difference is out of reach.
  const MatrixXd a = -3.0 * MatrixXd::Identity(2, 2);
  const Access access = controllability(system_of(a, MatrixXd::Ones(2, 1)));
  ASSERT_EQ(access.unreached.size(), 1U);
  EXPECT_EQ(access.unreached[0].eigenvalue, Complex(-3.0));
  EXPECT_LT(access.unreached[0].distance, 1e-15);
  EXPECT_TRUE(access.unreached[0].stable);
  EXPECT_FALSE(access.complete());
  EXPECT_TRUE(access.leaves_only_stable());
  EXPECT_THAT(access.unreached[0].states, testing::UnorderedElementsAre("x1", "x2"));
  EXPECT_EQ(access.description, "the input u does not reach the eigenvalue -3 (states x1, x2)");
  // A second input apart from the first reaches the rest.
  MatrixXd b(2, 2);
  b << 1.0, 1.0, 1.0, -1.0;
  EXPECT_TRUE(controllability(system_of(a, b)).complete());
  EXPECT_EQ(controllability(system_of(a, b)).description, "");
}

TEST(Controllability, FindsTheUnreachedPartInAnyBasis) {
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
    const Access access = controllability(system_of(q * a * q.transpose(), q * b));
    const Eigen::VectorXcd expected = numerics::eigenvalues(a.bottomRightCorner(out, out));
    Index listed = 0;
    for (const auto& mode : access.unreached) {
      EXPECT_LT((expected.array() - mode.eigenvalue).abs().minCoeff(), 1e-11);
      listed += mode.eigenvalue.imag() == 0.0 ? 1 : 2;
    }
    EXPECT_EQ(listed, out);
    EXPECT_EQ(access.leaves_only_stable(), expected.real().maxCoeff() < 0.0);
  }
}

TEST(Controllability, SeesThroughAChainSharedByBothParts) {
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
    const Access access = controllability(system_of(turned, q * b));
    ASSERT_EQ(access.unreached.size(), 1U) << trial;
    EXPECT_LT(std::abs(access.unreached[0].eigenvalue - shift), 1e-12);
    EXPECT_FALSE(access.leaves_only_stable());
    b(3, 0) = 1.0;
    EXPECT_TRUE(controllability(system_of(turned, q * b)).complete());
    b(3, 0) = 0.0;
  }
}

TEST(Controllability, DistanceIsTheSmallestSingularValue) {
  reference::RandomNumbers random(93);
  for (int trial = 0; trial < 30; ++trial) {
    const Index n = random.integer(2, 9);
    const MatrixXd a = random.matrix(n, n);
    MatrixXd b = random.matrix(n, random.integer(1, 3));
    const Access access = controllability(system_of(a, b));
    for (Index j = 0; j < b.cols(); ++j) b.col(j) *= a.norm() / b.col(j).norm();
    Eigen::VectorXcd values = numerics::eigenvalues(a);
    for (const auto& mode : access.modes) {
      EXPECT_LT((values.array() - mode.eigenvalue).abs().minCoeff(), 1e-12);
      // sigma^2 as the smallest eigenvalue of the real form of M M^H. Random matrices are nearly
      // balanced, so that balancing changes little.
      MatrixXcd m(n, n + b.cols());
      m.leftCols(n) = a.cast<Complex>() - mode.eigenvalue * MatrixXcd::Identity(n, n);
      m.rightCols(b.cols()) = b.cast<Complex>();
      const MatrixXcd square = m * m.adjoint();
      MatrixXd real(2 * n, 2 * n);
      real << square.real(), -square.imag(), square.imag(), square.real();
      const double smallest = std::sqrt(numerics::eigenvalues(real).real().minCoeff()) / a.norm();
      EXPECT_GT(mode.distance, 0.3 * smallest);
      EXPECT_LT(mode.distance, 3.0 * smallest);
    }
  }
}

TEST(Controllability, GrowsInProportionToTheCoupling) {
  // [A - 2, B] is [-3 0 r; 0 0 c r] with r = |A| = sqrt(5): for small c its smallest singular value
  // is c r sqrt(9/14), on the combination -5 c/14 x1 + x2.
  for (const double coupling : {1e-3, 1e-6, 1e-9}) {
    MatrixXd a = MatrixXd::Zero(2, 2), b(2, 1);
    a(0, 0) = -1.0;
    a(1, 1) = 2.0;
    b << 1.0, coupling;
    const Access access = controllability(system_of(a, b));
    EXPECT_TRUE(access.complete());
    EXPECT_EQ(access.modes[0].eigenvalue, Complex(2.0));
    EXPECT_NEAR(access.modes[0].distance / coupling, std::sqrt(9.0 / 14.0), 1e-5);
    EXPECT_NEAR(access.modes[0].by_port[0] / coupling, 9.0 / 14.0, 1e-5);
    EXPECT_THAT(access.modes[0].states, ElementsAre("x2"));
  }
}

TEST(Controllability, DoesNotDependOnUnits) {
  reference::RandomNumbers random(94);
  MatrixXd a = random.matrix(5, 5), b = random.matrix(5, 2);
  const Eigen::VectorXd unit = Eigen::VectorXd::LinSpaced(5, -30.0, 30.0).array().exp();
  const auto plain = controllability(system_of(a, b));
  MatrixXd scaled_b = unit.asDiagonal() * b;
  scaled_b.col(1) *= 1e9;
  const auto scaled = controllability(
      system_of(unit.asDiagonal() * a * unit.cwiseInverse().asDiagonal(), scaled_b));
  ASSERT_EQ(scaled.modes.size(), plain.modes.size());
  for (const auto& mode : plain.modes) {
    const auto same = std::min_element(scaled.modes.begin(), scaled.modes.end(),
                                       [&](const auto& left, const auto& right) {
                                         return std::abs(left.eigenvalue - mode.eigenvalue) <
                                                std::abs(right.eigenvalue - mode.eigenvalue);
                                       });
    EXPECT_GT(same->distance, 0.2 * mode.distance);
    EXPECT_LT(same->distance, 5.0 * mode.distance);
  }
}

TEST(Controllability, OfTheAntennaNamesTheWindThatNoCommandReaches) {
  const auto loop = reference::peer_closed_loop(5);
  const auto from_command = controllability(reference::channel(loop, "d", "y"));
  ASSERT_EQ(from_command.unreached.size(), 2U);
  EXPECT_TRUE(from_command.leaves_only_stable());
  for (const auto& mode : from_command.unreached) {
    EXPECT_TRUE(mode.states[0] == "w1" || mode.states[0] == "w2") << mode.states[0];
  }
  EXPECT_THAT(from_command.description, HasSubstr("the input d does not reach the eigenvalues"));
  EXPECT_TRUE(controllability(reference::channel(loop, "n", "y")).complete());
  EXPECT_TRUE(observability(reference::channel(loop, "n", "y")).complete());
}

plant::StateSpace chain_system() {
  const auto [a, b] = chain_with_rounding_error();
  return system_of(a, b);
}

TEST(Controllability, IsNotLedAstrayByACouplingThatIsARoundingError) {
  auto system = chain_system();
  EXPECT_TRUE(controllability(system).complete()) << controllability(system).description;
  system.c = MatrixXd::Zero(1, 8);
  system.c(0, 7) = 1.0;
  system.d = MatrixXd::Zero(1, 1);
  system.outputs = {"y"};
  EXPECT_TRUE(observability(system).complete()) << observability(system).description;
}

TEST(Observability, IsTheControllabilityOfTheTransposedSystem) {
  // Two masses of which one is seen apart from the other.
  MatrixXd a(3, 3), c(1, 3);
  a << -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -4.0, 0.2;
  c << 1.0, 0.0, 0.0;
  auto system = reference::state_space(a, MatrixXd::Ones(3, 1), c, MatrixXd::Zero(1, 1));
  const Access access = observability(system);
  ASSERT_EQ(access.unreached.size(), 1U);
  EXPECT_NEAR(access.unreached[0].eigenvalue.real(), 0.1, 1e-14);
  EXPECT_NEAR(access.unreached[0].eigenvalue.imag(), std::sqrt(4.0 - 0.01), 1e-14);
  EXPECT_FALSE(access.leaves_only_stable());
  EXPECT_EQ(access.description,
            "the output y does not show the eigenvalue 0.1 +- 1.9975 j (states x2, x3)");
  EXPECT_TRUE(controllability(system).complete());
  // The same numbers as a sampled system: 2 is outside the unit circle.
  system.sample_time = 0.1;
  EXPECT_FALSE(observability(system).leaves_only_stable());
  system.a *= 0.4;
  EXPECT_TRUE(observability(system).leaves_only_stable());
}

TEST(Controllability, OfExtremes) {
  EXPECT_TRUE(controllability(plant::static_gain(MatrixXd::Ones(1, 1), {"u"}, {"y"})).complete());
  // Integrators, one of them reached.
  MatrixXd b = MatrixXd::Zero(30, 1);
  b(0, 0) = 1.0;
  EXPECT_EQ(controllability(system_of(MatrixXd::Zero(30, 30), b)).unreached.size(), 1U);
  // A long chain without any input.
  MatrixXd chain = MatrixXd::Zero(40, 40);
  for (Index i = 0; i + 1 < 40; ++i) chain(i, i + 1) = 1.0;
  EXPECT_EQ(controllability(system_of(chain, MatrixXd::Zero(40, 1))).unreached.size(), 1U);
  b = MatrixXd::Zero(40, 1);
  b(39, 0) = 1.0;
  EXPECT_TRUE(controllability(system_of(chain, b)).complete());
  EXPECT_EQ(controllability(system_of(chain, MatrixXd(40, 0))).unreached.size(), 1U);
  auto broken = system_of(chain, b);
  broken.a(3, 3) = std::nan("");
  EXPECT_THROW(controllability(broken), InvalidInput);
  EXPECT_THROW(observability(broken), InvalidInput);
}

}  // namespace
}  // namespace boresight::control
