#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

// sum of kron(left, right): the operator X -> right X left' on the columns of X.
MatrixXd kronecker(const MatrixXd& left, const MatrixXd& right) {
  MatrixXd result(left.rows() * right.rows(), left.cols() * right.cols());
  for (Index i = 0; i < left.rows(); ++i) {
    for (Index j = 0; j < left.cols(); ++j) {
      result.block(i * right.rows(), j * right.cols(), right.rows(), right.cols()) =
          left(i, j) * right;
    }
  }
  return result;
}

// The operator P -> A P + P A' or A P A' - P as a matrix.
MatrixXd lyapunov_operator(const MatrixXd& a, bool sampled) {
  const MatrixXd identity = MatrixXd::Identity(a.rows(), a.rows());
  if (sampled) return kronecker(a, a) - kronecker(identity, identity);
  return kronecker(identity, a) + kronecker(a, identity);
}

MatrixXd by_elimination(const MatrixXd& a, const MatrixXd& q, bool sampled) {
  const MatrixXd p =
      numerics::linear_solve(lyapunov_operator(a, sampled), -q.reshaped(q.size(), 1), "test");
  return p.reshaped(a.rows(), a.rows());
}

MatrixXd stable(reference::RandomNumbers& random, Index n, double margin) {
  MatrixXd a = random.matrix(n, n);
  a.diagonal().array() -= numerics::spectral_abscissa(a) + margin;
  return a;
}

MatrixXd within_unit_circle(reference::RandomNumbers& random, Index n, double radius) {
  const MatrixXd a = random.matrix(n, n);
  return a * (radius / numerics::eigenvalues(a).cwiseAbs().maxCoeff());
}

TEST(Lyapunov, OfOneState) {
  const auto solution =
      solve_lyapunov(MatrixXd::Constant(1, 1, -2.0), MatrixXd::Constant(1, 1, 3.0));
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
  const auto solution = solve_lyapunov(a, noise);
  const MatrixXd& p = solution.covariance;
  EXPECT_NEAR(p(0, 0), q / (4.0 * z * w * w * w), 1e-12 * p(0, 0));
  EXPECT_NEAR(p(1, 1), q / (4.0 * z * w), 1e-12 * p(1, 1));
  EXPECT_NEAR(p(0, 1), 0.0, 1e-12 * p(1, 1));
  EXPECT_NEAR(solution.stability_margin, z * w, 1e-12);
}

TEST(Lyapunov, SolvesItsEquationForRandomStableMatrices) {
  reference::RandomNumbers random(31);
  for (const Index n : {1, 2, 3, 8, 20, 35}) {
    MatrixXd a = random.matrix(n, n);
    a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.01, 1.0);
    const MatrixXd b = random.matrix(n, 2);
    const MatrixXd q = b * b.transpose();
    const auto solution = solve_lyapunov(a, q);
    const MatrixXd& p = solution.covariance;
    EXPECT_LT((a * p + p * a.transpose() + q).norm(), 1e-12 * (a.norm() * p.norm() + q.norm()));
    EXPECT_LT(solution.relative_residual, 1e-14);
    EXPECT_EQ((p - p.transpose()).norm(), 0.0);
    EXPECT_NEAR(solution.stability_margin, -numerics::spectral_abscissa(a), 1e-9);
    // A covariance is positive semidefinite.
    EXPECT_GT(numerics::eigenvalues(p).real().minCoeff(), -1e-12 * p.norm());
  }
}

TEST(Lyapunov, FollowsAChangeOfBasisAndScalesWithTheNoise) {
  reference::RandomNumbers random(32);
  MatrixXd a = random.matrix(6, 6);
  a.diagonal().array() -= numerics::spectral_abscissa(a) + 0.3;
  const MatrixXd b = random.matrix(6, 1);
  const MatrixXd q = b * b.transpose();
  const MatrixXd p = solve_lyapunov(a, q).covariance;
  EXPECT_LT((solve_lyapunov(a, 9.0 * q).covariance - 9.0 * p).norm(), 1e-12 * p.norm());
  const Eigen::VectorXd scale = Eigen::VectorXd::LinSpaced(6, -2.0, 2.0).array().exp();
  const MatrixXd scaled = scale.asDiagonal() * a * scale.cwiseInverse().asDiagonal();
  const MatrixXd expected = scale.asDiagonal() * p * scale.asDiagonal();
  const MatrixXd found =
      solve_lyapunov(scaled, scale.asDiagonal() * q * scale.asDiagonal()).covariance;
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
}

TEST(Lyapunov, AgreesWithEliminationInTheKroneckerForm) {
  reference::RandomNumbers random(33);
  for (int trial = 0; trial < 30; ++trial) {
    const Index n = random.integer(1, 8);
    const MatrixXd any = random.matrix(n, n);
    const MatrixXd q = any + any.transpose();  // indefinite: not only covariances
    const MatrixXd a = stable(random, n, random.log_uniform(1e-3, 1.0));
    const auto solution = solve_lyapunov(a, q);
    const MatrixXd expected = by_elimination(a, q, false);
    EXPECT_LT((solution.covariance - expected).norm(), 1e-11 * expected.norm());
    const MatrixXd b = within_unit_circle(random, n, random.uniform(0.1, 0.999));
    const auto sampled = solve_discrete_lyapunov(b, q);
    const MatrixXd sampled_expected = by_elimination(b, q, true);
    EXPECT_LT((sampled.covariance - sampled_expected).norm(), 1e-11 * sampled_expected.norm());
  }
}

TEST(Lyapunov, OfSlicotsExample) {
  // op(A) = A there: A' X + X A = -B' B, X printed as whole numbers.
  reference::SlicotData data("SB03OD.dat");
  const MatrixXd a = data.next_matrix(4, 4);
  const MatrixXd b = data.next_matrix(5, 4);
  MatrixXd expected(4, 4);
  expected << 1, 3, 2, -1, 3, 10, 5, -2, 2, 5, 6, -5, -1, -2, -5, 7;
  const auto solution = solve_lyapunov(a.transpose(), b.transpose() * b);
  EXPECT_LT((solution.covariance - expected).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Lyapunov, GivesThePeersRms) {
  const auto peers = reference::peer_values();
  for (const int modes : {5, 50}) {
    const plant::StateSpace loop = reference::peer_closed_loop(modes);
    const MatrixXd b = loop.b.col(plant::input_index(loop, "n"));
    const auto solution = solve_lyapunov(loop.a, b * b.transpose());
    const MatrixXd c = loop.c.row(plant::output_index(loop, "y"));
    const double rms = std::sqrt((c * solution.covariance * c.transpose())(0, 0));
    const double expected = peers.at("h2").at(std::to_string(modes)).at("val").at(0);
    EXPECT_NEAR(rms, expected, 1e-9 * expected);
  }
}

TEST(Lyapunov, ConditionBoundsTheChangeOfTheSolutionAndIsReached) {
  reference::RandomNumbers random(34);
  const auto norm = [](const MatrixXd& matrix) {
    return numerics::eigenvalues(matrix).cwiseAbs().maxCoeff();  // symmetric: the 2-norm
  };
  for (int trial = 0; trial < 20; ++trial) {
    const bool sampled = trial % 2 == 1;
    const auto solve = [&](const MatrixXd& a, const MatrixXd& q) {
      return sampled ? solve_discrete_lyapunov(a, q) : solve_lyapunov(a, q);
    };
    const Index n = random.integer(2, 6);
    const MatrixXd a = sampled ? within_unit_circle(random, n, random.uniform(0.5, 0.999))
                               : stable(random, n, random.log_uniform(1e-3, 1.0));
    const MatrixXd factor = random.matrix(n, n);
    const MatrixXd q = factor * factor.transpose();
    const auto solution = solve(a, q);
    // A residual changes P by no more than |H| times it, and by just that where it is the identity.
    const MatrixXd h = by_elimination(a, MatrixXd::Identity(n, n), sampled);
    const MatrixXd change = factor + factor.transpose();
    EXPECT_LE(norm(by_elimination(a, change, sampled)), norm(h) * norm(change) * (1.0 + 1e-10));
    // Random perturbations of A and Q of one relative size keep to the condition.
    const double size = 1e-7;
    MatrixXd e = random.matrix(n, n);
    e *= size * a.norm() / e.norm();
    MatrixXd f = change * (size * q.norm() / change.norm());
    const MatrixXd perturbed = by_elimination(a + e, q + f, sampled);
    const double relative = norm(perturbed - solution.covariance) / norm(solution.covariance);
    // Balancing changes norms a little in matrices as even as these.
    EXPECT_LT(relative, 4.0 * solution.condition * size);
    EXPECT_LT(relative, solution.condition);
    EXPECT_LT(norm(by_elimination(a, q, sampled) - solution.covariance),
              (solution.error_bound + 1e-11) * norm(solution.covariance));
    EXPECT_GT(solution.condition, 1.0);
  }
}

TEST(Lyapunov, ConditionOfOneStateIsThatOfItsFormula) {
  // p = -q/(2a): a relative change of a and of q each change p by as much. Sampled p = q/(1 - a^2).
  const MatrixXd a = MatrixXd::Constant(1, 1, -0.5);
  const MatrixXd q = MatrixXd::Constant(1, 1, 3.0);
  EXPECT_NEAR(solve_lyapunov(a, q).condition, 2.0, 1e-12);
  EXPECT_NEAR(solve_discrete_lyapunov(a, q).condition, 1.0 + 2.0 * 0.25 / 0.75, 1e-12);
  const auto without = solve_lyapunov(a, q, {.estimate_condition = false});
  EXPECT_EQ(without.condition, 0.0);
  EXPECT_EQ(without.error_bound, 0.0);
  EXPECT_EQ(without.covariance, solve_lyapunov(a, q).covariance);
}

TEST(Lyapunov, ScalesOfStatesDoNotCostAccuracy) {
  // A well-behaved system in units from 1e-9 to 1e9: every element keeps its digits.
  reference::RandomNumbers random(35);
  const Index n = 8;
  const Eigen::VectorXd unit =
      (Eigen::ArrayXd::LinSpaced(n, -9.0, 9.0) * std::log(10.0)).exp().matrix();
  for (const bool sampled : {false, true}) {
    const MatrixXd a = sampled ? within_unit_circle(random, n, 0.9) : stable(random, n, 0.2);
    const MatrixXd q = MatrixXd::Identity(n, n);
    const MatrixXd p = by_elimination(a, q, sampled);
    const MatrixXd scaled_a = unit.asDiagonal() * a * unit.cwiseInverse().asDiagonal();
    const MatrixXd scaled_q = unit.asDiagonal() * q * unit.asDiagonal();
    const auto solution =
        sampled ? solve_discrete_lyapunov(scaled_a, scaled_q) : solve_lyapunov(scaled_a, scaled_q);
    const MatrixXd found =
        unit.cwiseInverse().asDiagonal() * solution.covariance * unit.cwiseInverse().asDiagonal();
    EXPECT_LT((found - p).norm(), 1e-12 * p.norm());
  }
}

TEST(Lyapunov, TakesTheSymmetricPartOfQ) {
  reference::RandomNumbers random(36);
  const MatrixXd a = stable(random, 5, 0.1);
  const MatrixXd q = random.matrix(5, 5);
  EXPECT_EQ(solve_lyapunov(a, q).covariance,
            solve_lyapunov(a, 0.5 * (q + q.transpose())).covariance);
  EXPECT_EQ(solve_lyapunov(a, MatrixXd::Zero(5, 5)).covariance.norm(), 0.0);
}

TEST(DiscreteLyapunov, OfOneStateAndOfADeadBeatChain) {
  const auto one =
      solve_discrete_lyapunov(MatrixXd::Constant(1, 1, 0.8), MatrixXd::Constant(1, 1, 0.5));
  EXPECT_NEAR(one.covariance(0, 0), 0.5 / (1.0 - 0.64), 1e-15);
  EXPECT_NEAR(one.stability_margin, 0.2, 1e-15);
  // A delay line: what enters at the end passes every state once.
  MatrixXd chain = MatrixXd::Zero(4, 4), q = MatrixXd::Zero(4, 4);
  for (Index i = 0; i < 3; ++i) chain(i, i + 1) = 1.0;
  q(3, 3) = 2.0;
  const auto line = solve_discrete_lyapunov(chain, q);
  EXPECT_LT((line.covariance - 2.0 * MatrixXd::Identity(4, 4)).norm(), 1e-14);
  EXPECT_EQ(line.stability_margin, 1.0);
}

TEST(DiscreteLyapunov, IsTheSumOverAllPastNoise) {
  reference::RandomNumbers random(37);
  for (const Index n : {1, 2, 3, 8, 20, 35}) {
    const MatrixXd a = within_unit_circle(random, n, 0.97);
    const MatrixXd b = random.matrix(n, 2);
    const auto solution = solve_discrete_lyapunov(a, b * b.transpose());
    // sum A^k B B' A'^k, the number of terms doubled in each step.
    MatrixXd sum = b * b.transpose(), power = a;
    for (int i = 0; i < 16; ++i) {
      sum += (power * sum * power.transpose()).eval();
      power = (power * power).eval();
    }
    EXPECT_LT((solution.covariance - sum).norm(), 1e-12 * sum.norm());
    EXPECT_LT(solution.relative_residual, 1e-14);
  }
}

TEST(DiscreteLyapunov, OfAContinuousSystemSampledFinely) {
  // Noise held over short steps T with covariance Q/T tends to white noise of intensity Q.
  reference::RandomNumbers random(38);
  const MatrixXd a = stable(random, 4, 0.5);
  const MatrixXd b = random.matrix(4, 1);
  const auto system = reference::state_space(a, b, MatrixXd::Identity(4, 4), MatrixXd::Zero(4, 1));
  const double step = 1e-4;
  const auto held = reference::zero_order_hold(system, step);
  const MatrixXd p = solve_lyapunov(a, b * b.transpose()).covariance;
  const MatrixXd sampled =
      solve_discrete_lyapunov(held.a, held.b * held.b.transpose() / step).covariance;
  EXPECT_LT((sampled - p).norm(), 1e-7 * p.norm());
}

TEST(DiscreteLyapunov, RefusesWhatIsNotStable) {
  const MatrixXd q = MatrixXd::Identity(2, 2);
  Eigen::Matrix2d outside;
  outside << 1.25, 1.0, 0.0, 0.5;
  EXPECT_THAT(reference::Call([&] { solve_discrete_lyapunov(outside, q); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("magnitude 1 + 0.25")));
  EXPECT_THROW(solve_discrete_lyapunov(MatrixXd::Identity(2, 2), q), NumericalFailure);
  Eigen::Matrix2d turning;
  turning << 0.6, 0.8, -0.8, 0.6;
  EXPECT_THROW(solve_discrete_lyapunov(turning, q), NumericalFailure);
  EXPECT_THAT(reference::Call([&] { solve_discrete_lyapunov(outside, MatrixXd::Ones(3, 3)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("solve_discrete_lyapunov")));
}

TEST(Lyapunov, RefusesAMatrixThatIsNotStableAndSaysByHowMuch) {
  const MatrixXd q = MatrixXd::Identity(2, 2);
  Eigen::Matrix2d unstable;
  unstable << 0.25, 1.0, 0.0, -1.0;
  EXPECT_THAT(reference::Call([&] { solve_lyapunov(unstable, q); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("0.25")));
  Eigen::Matrix2d integrator;
  integrator << 0.0, 1.0, 0.0, -1.0;
  EXPECT_THAT(reference::Call([&] { solve_lyapunov(integrator, q); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("remove integrators")));
  Eigen::Matrix2d oscillator;
  oscillator << 0.0, 1.0, -4.0, 0.0;
  EXPECT_THROW(solve_lyapunov(oscillator, q), NumericalFailure);
}

TEST(Lyapunov, RefusesShapesAndNumbersThatDoNotFit) {
  const MatrixXd stable = -MatrixXd::Identity(2, 2);
  EXPECT_THAT(reference::Call([&] { solve_lyapunov(stable, MatrixXd::Identity(3, 3)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("2 x 2 and 3 x 3")));
  EXPECT_THROW(solve_lyapunov(MatrixXd::Ones(2, 3), stable), InvalidInput);
  EXPECT_THROW(solve_lyapunov(MatrixXd(0, 0), MatrixXd(0, 0)), InvalidInput);
  EXPECT_THROW(solve_lyapunov(stable * std::nan(""), stable), InvalidInput);
  EXPECT_THROW(solve_lyapunov(stable, stable * HUGE_VAL), InvalidInput);
}

TEST(Lyapunov, IsNotLedAstrayByACouplingThatIsARoundingError) {
  // A filter in front of an oscillator, and a rounding error back within the filter that balancing
  // takes for a coupling: scales run apart by 10^50 and more with enough stages.
  constexpr Eigen::Index stages = 6, n = stages + 2;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < stages; ++i) {
    a(i, i) = -0.01 * std::pow(5.0, static_cast<double>(i));
    for (Eigen::Index j = 0; j < i; ++j)
      a(i, j) = -0.2 * a(i, i) / (1.0 + static_cast<double>(i - j));
  }
  a(stages, stages - 1) = 70.0;
  a(stages, stages) = a(stages + 1, stages + 1) = -0.5;
  a(stages, stages + 1) = 3.0;
  a(stages + 1, stages) = -3.0;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  b[0] = 1.0;
  const Eigen::MatrixXd clean = solve_lyapunov(a, b * b.transpose()).covariance;
  a(0, 1) = 1e-18;
  const Eigen::MatrixXd found = solve_lyapunov(a, b * b.transpose()).covariance;
  for (Eigen::Index i = 0; i < n; ++i) EXPECT_NEAR(found(i, i) / clean(i, i), 1.0, 1e-9) << i;
}

}  // namespace
}  // namespace boresight::control
