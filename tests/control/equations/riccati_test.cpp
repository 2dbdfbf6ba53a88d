#include <cmath>
#include <complex>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/riccati_solution.hpp"
#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/equations/riccati.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

MatrixXd inverse(const MatrixXd& matrix) {
  return numerics::linear_solve(matrix, MatrixXd::Identity(matrix.rows(), matrix.rows()), "test");
}

TEST(Riccati, OfTheReferenceCases) {
  const auto file = reference::reference_values("riccati_scaling");
  int solved = 0, refused = 0;
  for (const auto& entry : file.at("care_dare")) {
    const std::string id = entry.at("id");
    SCOPED_TRACE(id);
    const bool sampled = entry.at("kind") == "dare";
    RiccatiProblem problem;
    problem.a = reference::matrix(entry.at("A"));
    problem.b = reference::matrix(entry.at("B"));
    problem.q = reference::matrix(entry.at("Q"));
    problem.r = reference::matrix(entry.at("R"));
    if (id == "drake_care_undetectable") {
      ++refused;
      EXPECT_THAT(reference::Call([&] { solve_riccati(problem); }),
                  ThrowsMessage<NumericalFailure>(
                      AllOf(HasSubstr("(A, Q) is not detectable"), HasSubstr("eigenvalue 1 "))));
      continue;
    }
    if (id == "drake_care_unstabilizable") {
      ++refused;
      EXPECT_THAT(reference::Call([&] { solve_riccati(problem); }),
                  ThrowsMessage<NumericalFailure>(
                      AllOf(HasSubstr("(A, B) is not stabilisable"), HasSubstr("eigenvalue 1 "))));
      continue;
    }
    const RiccatiSolution solution = solve(problem, sampled);
    expect_solution(problem, sampled, solution);
    if (entry.contains("X_octave")) {
      ++solved;
      const MatrixXd expected = reference::matrix(entry.at("X_octave"));
      EXPECT_LE((solution.x - expected).cwiseAbs().maxCoeff(), 0.5e-4);
    } else {
      ++solved;
      const MatrixXd expected =
          id == "drake8034b" ? MatrixXd(0.5 * (1.0 + std::sqrt(5.0)) * MatrixXd::Identity(2, 2))
                             : reference::matrix(entry.at("X"));
      EXPECT_LT((solution.x - expected).norm(), 1e-14);
    }
  }
  EXPECT_EQ(solved, 5);
  EXPECT_EQ(refused, 2);
}

TEST(Riccati, OfSlicotsDoubleIntegrator) {
  reference::SlicotData data("SB02MD.dat");
  RiccatiProblem problem;
  problem.a = data.next_matrix(2, 2);
  problem.q = data.next_matrix(2, 2);
  const MatrixXd g = data.next_matrix(2, 2);
  ASSERT_EQ(g(0, 0), 0.0);
  problem.b = g.col(1);
  problem.r = MatrixXd::Identity(1, 1);
  const auto printed = reference::slicot_result("SB02MD.res", "The solution matrix X is");
  const RiccatiSolution solution = solve_riccati(problem);
  for (Index i = 0; i < 2; ++i) {
    for (Index j = 0; j < 2; ++j) {
      const auto& number = printed[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      EXPECT_NEAR(solution.x(i, j), number.value, 1e-14);
    }
  }
}

TEST(Riccati, OfOneStateInClosedForm) {
  for (const double a : {-3.0, 0.0, 0.7, 1e-6}) {
    for (const double q : {1e-8, 1.0, 1e10}) {
      for (const double r : {1e-8, 1.0, 1e8}) {
        const double b = 0.3;
        const RiccatiProblem problem{MatrixXd::Constant(1, 1, a),
                                     MatrixXd::Constant(1, 1, b),
                                     MatrixXd::Constant(1, 1, q),
                                     MatrixXd::Constant(1, 1, r),
                                     {}};
        // x b^2/r = a + sqrt(a^2 + q b^2/r), free of cancellation for a < 0
        const double root = std::hypot(a, b * std::sqrt(q / r));
        const double expected = a >= 0.0 ? (a + root) * r / (b * b) : q / (root - a);
        const auto solution = solve_riccati(problem);
        EXPECT_NEAR(solution.x(0, 0), expected, 1e-12 * expected) << a << " " << q << " " << r;
        EXPECT_NEAR(solution.eigenvalues[0].real(), -root, 1e-12 * root);
        EXPECT_NEAR(solution.gain(0, 0), b * expected / r, 1e-12 * b * expected / r);
        // x^2 b^2 - x (b^2 q + (a^2 - 1) r) - q r = 0
        const double half = 0.5 * (b * b * q + (a * a - 1.0) * r);
        const double discriminant = std::hypot(half, b * std::sqrt(q) * std::sqrt(r));
        const double sampled_expected =
            half >= 0.0 ? (half + discriminant) / (b * b) : q * r / (discriminant - half);
        const auto sampled = solve_discrete_riccati(problem);
        EXPECT_NEAR(sampled.x(0, 0), sampled_expected, 1e-11 * sampled_expected)
            << a << " " << q << " " << r;
      }
    }
  }
}

TEST(Riccati, OfTheDoubleIntegratorInClosedForm) {
  for (const double position : {1e-6, 1.0, 1e6}) {
    for (const double rate : {0.0, 1.0, 1e4}) {
      for (const double r : {1e-8, 1.0, 1e8}) {
        RiccatiProblem problem{MatrixXd::Zero(2, 2),
                               MatrixXd::Zero(2, 1),
                               MatrixXd::Zero(2, 2),
                               MatrixXd::Constant(1, 1, r),
                               {}};
        problem.a(0, 1) = 1.0;
        problem.b(1, 0) = 1.0;
        problem.q(0, 0) = position;
        problem.q(1, 1) = rate;
        const double x12 = std::sqrt(position * r);
        const double x22 = std::sqrt(r * (rate + 2.0 * x12));
        const double x11 = x12 * x22 / r;
        const auto solution = solve_riccati(problem);
        EXPECT_NEAR(solution.x(0, 0), x11, 1e-12 * x11);
        EXPECT_NEAR(solution.x(0, 1), x12, 1e-12 * x12);
        EXPECT_NEAR(solution.x(1, 1), x22, 1e-12 * x22);
        expect_solution(problem, false, solution);
      }
    }
  }
}

// Decoupled scalar problems in a basis T: X = T^-T diag T^-1 is known.
struct KnownProblem {
  RiccatiProblem problem;
  MatrixXd x;
};

KnownProblem known_problem(reference::RandomNumbers& random, Index n, const MatrixXd& basis,
                           bool sampled) {
  MatrixXd a = MatrixXd::Zero(n, n), b = a, q = a, r = a, x = a;
  for (Index i = 0; i < n; ++i) {
    a(i, i) = random.uniform(-1.0, 1.0) * (sampled ? 1.5 : 3.0);
    b(i, i) = random.log_uniform(0.1, 10.0);
    q(i, i) = random.log_uniform(0.01, 100.0);
    r(i, i) = random.log_uniform(0.01, 100.0);
    if (sampled) {
      const double half = 0.5 * (b(i, i) * b(i, i) * q(i, i) + (a(i, i) * a(i, i) - 1.0) * r(i, i));
      const double root = std::sqrt(half * half + b(i, i) * b(i, i) * q(i, i) * r(i, i));
      x(i, i) =
          half >= 0.0 ? (half + root) / (b(i, i) * b(i, i)) : q(i, i) * r(i, i) / (root - half);
    } else {
      const double root = std::sqrt(a(i, i) * a(i, i) + b(i, i) * b(i, i) * q(i, i) / r(i, i));
      x(i, i) = a(i, i) >= 0.0 ? (a(i, i) + root) * r(i, i) / (b(i, i) * b(i, i))
                               : q(i, i) / (root - a(i, i));
    }
  }
  const MatrixXd back = inverse(basis);
  const auto symmetric = [&](const MatrixXd& diagonal) {
    const MatrixXd half = back.transpose() * diagonal.cwiseSqrt();
    return MatrixXd(half * half.transpose());
  };
  return {{basis * a * back, basis * b, symmetric(q), r, {}}, symmetric(x)};
}

TEST(Riccati, OfDecoupledProblemsInAnyBasis) {
  reference::RandomNumbers random(101);
  for (int trial = 0; trial < 60; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = random.integer(1, 12);
    MatrixXd basis = random.matrix(n, n) + 2.0 * MatrixXd::Identity(n, n);
    const auto [problem, x] = known_problem(random, n, basis, sampled);
    const auto solution = solve(problem, sampled);
    expect_solution(problem, sampled, solution);
    const double error = (solution.x - x).norm() / x.norm();
    // The data themselves are rounded.
    EXPECT_LT(error, 1e-14 * solution.condition + solution.error_bound) << trial;
    EXPECT_LT(error, 1e-9);
  }
}

TEST(Riccati, DoesNotDependOnUnits) {
  reference::RandomNumbers random(102);
  for (int trial = 0; trial < 20; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = 6;
    const MatrixXd basis = random.matrix(n, n) + 2.0 * MatrixXd::Identity(n, n);
    const auto [problem, x] = known_problem(random, n, basis, sampled);
    // States, inputs and the cost in units of 1e-8 to 1e8, powers of two so that nothing rounds.
    Eigen::VectorXd state(n), input(n);
    for (Index i = 0; i < n; ++i) {
      state[i] = std::exp2(random.integer(-27, 27));
      input[i] = std::exp2(random.integer(-27, 27));
    }
    const double cost = std::exp2(random.integer(-27, 27));
    const auto s = state.asDiagonal();
    const MatrixXd back = state.cwiseInverse().asDiagonal();
    const RiccatiProblem scaled{
        s * problem.a * back,
        s * problem.b * input.asDiagonal(),
        cost * back * problem.q * back,
        cost * MatrixXd(input.asDiagonal() * problem.r * input.asDiagonal()),
        {}};
    const auto plain = solve(problem, sampled);
    const auto solution = solve(scaled, sampled);
    EXPECT_LT((s * solution.x * s / cost - plain.x).norm(),
              1e-14 * plain.condition * plain.x.norm());
    EXPECT_LT((input.asDiagonal() * solution.gain * s - plain.gain).norm(),
              1e-14 * plain.condition * plain.gain.norm());
  }
}

// The stable invariant subspace of the Hamiltonian matrix by its eigenvectors.
MatrixXd by_hamiltonian(const RiccatiProblem& problem) {
  const Index n = problem.a.rows();
  const MatrixXd g = problem.b * inverse(problem.r) * problem.b.transpose();
  MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << problem.a, -g, -problem.q, -problem.a.transpose();
  const auto eigen = numerics::eigen_decomposition(hamiltonian);
  MatrixXcd upper(n, n), lower(n, n);
  Index found = 0;
  for (Index i = 0; i < 2 * n; ++i) {
    if (eigen.values[i].real() >= 0.0) continue;
    upper.col(found) = eigen.right.col(i).head(n);
    lower.col(found++) = eigen.right.col(i).tail(n);
  }
  EXPECT_EQ(found, n);
  // X = lower upper^-1, as a real system of twice the size.
  MatrixXd real(2 * n, 2 * n), right(2 * n, n);
  real << upper.real().transpose(), -upper.imag().transpose(), upper.imag().transpose(),
      upper.real().transpose();
  right << lower.real().transpose(), lower.imag().transpose();
  return numerics::linear_solve(real, right, "test").topRows(n).transpose();
}

TEST(Riccati, AgreesWithTheHamiltonianEigenvectors) {
  reference::RandomNumbers random(103);
  for (int trial = 0; trial < 40; ++trial) {
    const Index n = random.integer(2, 10);
    const MatrixXd c = random.matrix(random.integer(1, 2), n);
    const MatrixXd root = random.matrix(2, 2) + 2.0 * MatrixXd::Identity(2, 2);
    const RiccatiProblem problem{
        random.matrix(n, n), random.matrix(n, 2), c.transpose() * c, root * root.transpose(), {}};
    const auto solution = solve_riccati(problem);
    expect_solution(problem, false, solution);
    const MatrixXd expected = by_hamiltonian(problem);
    EXPECT_LT((solution.x - expected).norm() / expected.norm(), 1e-12 * solution.condition);
  }
}

TEST(Riccati, KeepsTheReturnDifferenceIdentity) {
  // (1 + L)^H R' (1 + L) = R + H^H Q H + H^H S + S'H with H = (s - A)^-1 B, L = K H, and R' = R or
  // R + B'XB: an equation in which X does not appear.
  reference::RandomNumbers random(104);
  for (int trial = 0; trial < 20; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = random.integer(2, 8);
    const MatrixXd c = random.matrix(3, n), d = random.matrix(3, 2);
    const RiccatiProblem problem{random.matrix(n, n), random.matrix(n, 2), c.transpose() * c,
                                 d.transpose() * d, c.transpose() * d};
    const auto solution = solve(problem, sampled);
    expect_solution(problem, sampled, solution);
    MatrixXd r = problem.r;
    if (sampled) r += problem.b.transpose() * solution.x * problem.b;
    for (const double w : {0.01, 0.3, 1.0, 2.5}) {
      const Complex s = sampled ? std::polar(1.0, w) : Complex(0.0, w);
      const MatrixXcd h = numerics::transfer_matrix(problem.a, problem.b, MatrixXd::Identity(n, n),
                                                    MatrixXd::Zero(n, 2), s);
      const MatrixXcd difference = MatrixXcd::Identity(2, 2) + solution.gain * h;
      const MatrixXcd seen = c * h + d;
      const MatrixXcd expected = seen.adjoint() * seen;
      EXPECT_LT((difference.adjoint() * r * difference - expected).norm(),
                1e-13 * solution.condition * expected.norm());
    }
  }
}

TEST(Riccati, CostIsTheLeast) {
  reference::RandomNumbers random(105);
  for (int trial = 0; trial < 10; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = 4;
    const RiccatiProblem problem{random.matrix(n, n),
                                 random.matrix(n, 1),
                                 MatrixXd::Identity(n, n),
                                 MatrixXd::Identity(1, 1),
                                 {}};
    const auto solution = solve(problem, sampled);
    const auto cost = [&](const MatrixXd& gain) {
      const MatrixXd closed = (problem.a - problem.b * gain).transpose();
      const MatrixXd weight = problem.q + gain.transpose() * gain;
      return (sampled ? solve_discrete_lyapunov(closed, weight) : solve_lyapunov(closed, weight))
          .covariance.trace();
    };
    const double minimum = cost(solution.gain);
    EXPECT_NEAR(minimum, solution.x.trace(), 1e-10 * minimum);
    for (int k = 0; k < 5; ++k) {
      EXPECT_GT(cost(solution.gain + 1e-3 * random.matrix(1, n)), minimum);
    }
  }
}

TEST(Riccati, OfTheSampledProblemTendsToTheContinuousOne) {
  reference::RandomNumbers random(106);
  const Index n = 4;
  const MatrixXd a = random.matrix(n, n), b = random.matrix(n, 1);
  const RiccatiProblem problem{a, b, MatrixXd::Identity(n, n), MatrixXd::Identity(1, 1), {}};
  const MatrixXd x = solve_riccati(problem).x;
  const auto system = reference::state_space(a, b, MatrixXd::Identity(n, n), MatrixXd::Zero(n, 1));
  double previous = 0.0;
  for (const double step : {1e-2, 1e-3, 1e-4}) {
    const auto held = reference::zero_order_hold(system, step);
    const RiccatiProblem sampled{held.a, held.b, step * problem.q, step * problem.r, {}};
    const double error = (solve_discrete_riccati(sampled).x - x).norm() / x.norm();
    if (previous > 0.0) {
      EXPECT_NEAR(error / previous, 0.1, 0.01);  // first order
    }
    previous = error;
  }
}

TEST(Riccati, OfLightlyDampedBadlyScaledAndNearlyUnreachedModes) {
  reference::RandomNumbers random(107);
  int too_slow = 0;
  for (int trial = 0; trial < 60; ++trial) {
    // Oscillators of 0.01 to 1000 rad/s, some undamped or slowly unstable, reached down to 1e-5.
    const Index modes = random.integer(1, 8);
    const Index n = 2 * modes;
    MatrixXd a = MatrixXd::Zero(n, n), b = MatrixXd::Zero(n, 2), c = MatrixXd::Zero(2, n);
    for (Index i = 0; i < modes; ++i) {
      const double w = random.log_uniform(1e-2, 1e3);
      const double damping = trial % 3 == 0 ? 0.0 : random.uniform(-1e-3, 1e-2);
      a(2 * i, 2 * i + 1) = 1.0;
      a(2 * i + 1, 2 * i) = -w * w;
      a(2 * i + 1, 2 * i + 1) = -2.0 * damping * w;
      for (Index j = 0; j < 2; ++j) {
        b(2 * i + 1, j) = random.log_uniform(1e-5, 1.0) * (random.integer(0, 1) == 0 ? 1.0 : -1.0);
        c(j, 2 * i) = random.log_uniform(1e-3, 1.0);
      }
    }
    const RiccatiProblem problem{
        a, b, c.transpose() * c, random.log_uniform(1e-8, 1e8) * MatrixXd::Identity(2, 2), {}};
    const auto solution = solve_riccati(problem);
    expect_solution(problem, false, solution);
    const auto system = reference::state_space(a, b, c, MatrixXd::Zero(2, 2));
    const auto held = reference::zero_order_hold(system, 1e-3);
    const RiccatiProblem sampled{held.a, held.b, problem.q, problem.r, {}};
    if (solution.stability_margin * 1e-3 > 1e-13) {
      expect_solution(sampled, true, solve_discrete_riccati(sampled));
      continue;
    }
    // A loop that slow is on the unit circle to rounding.
    ++too_slow;
    EXPECT_THAT(reference::Call([&] { solve_discrete_riccati(sampled); }),
                ThrowsMessage<NumericalFailure>(HasSubstr("not above rounding")));
  }
  EXPECT_LE(too_slow, 2);
}

TEST(Riccati, OfThePeersAntennaWithLittleAndMuchEffort) {
  const auto loop = reference::peer_closed_loop(5);
  const MatrixXd b = loop.b.col(plant::input_index(loop, "d"));
  const MatrixXd c = loop.c.row(plant::output_index(loop, "y"));
  for (const double r : {1e-8, 1e-4, 1.0, 1e4, 1e8}) {
    const RiccatiProblem problem{loop.a, b, c.transpose() * c, MatrixXd::Constant(1, 1, r), {}};
    const auto solution = solve_riccati(problem);
    expect_solution(problem, false, solution);
    const auto held = reference::zero_order_hold(loop, 1e-3);
    const RiccatiProblem sampled{
        held.a, held.b.col(plant::input_index(held, "d")), c.transpose() * c, problem.r, {}};
    expect_solution(sampled, true, solve_discrete_riccati(sampled));
  }
}

TEST(Riccati, TakesInputsOfVeryDifferentWeight) {
  // Two inputs on two integrators with weights 16 powers of ten apart: each is a problem of its
  // own.
  RiccatiProblem problem{MatrixXd::Zero(2, 2),
                         MatrixXd::Identity(2, 2),
                         MatrixXd::Identity(2, 2),
                         MatrixXd::Zero(2, 2),
                         {}};
  problem.r(0, 0) = 1e-8;
  problem.r(1, 1) = 1e8;
  const auto solution = solve_riccati(problem);
  EXPECT_NEAR(solution.x(0, 0), 1e-4, 1e-16);
  EXPECT_NEAR(solution.x(1, 1), 1e4, 1e-8);
  EXPECT_NEAR(solution.x(0, 1), 0.0, 1e-12);
  problem.a.setIdentity();
  const auto sampled = solve_discrete_riccati(problem);
  for (Index i = 0; i < 2; ++i) {
    const double r = problem.r(i, i);
    EXPECT_NEAR(sampled.x(i, i), 0.5 + std::sqrt(0.25 + r), 1e-11 * sampled.x(i, i));
  }
}

TEST(Riccati, CrossTermIsAShiftOfTheInput) {
  // With u = v - R^-1 S' x the cross term is gone: X is the same, K differs by R^-1 S'.
  reference::RandomNumbers random(108);
  for (int trial = 0; trial < 10; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = 5;
    const MatrixXd c = random.matrix(4, n), d = random.matrix(4, 2);
    const RiccatiProblem problem{random.matrix(n, n), random.matrix(n, 2), c.transpose() * c,
                                 d.transpose() * d, c.transpose() * d};
    const MatrixXd shift = inverse(problem.r) * problem.s.transpose();
    const MatrixXd q = problem.q - problem.s * shift;
    const RiccatiProblem plain{
        problem.a - problem.b * shift, problem.b, 0.5 * (q + q.transpose()), problem.r, {}};
    const auto with = solve(problem, sampled);
    const auto without = solve(plain, sampled);
    EXPECT_LT((with.x - without.x).norm(), 1e-13 * with.condition * with.x.norm());
    EXPECT_LT((with.gain - without.gain - shift).norm(), 1e-13 * with.condition * with.gain.norm());
  }
}

TEST(Riccati, ConditionCoversSmallChanges) {
  reference::RandomNumbers random(109);
  for (int trial = 0; trial < 30; ++trial) {
    const bool sampled = trial % 2 == 1;
    const Index n = random.integer(1, 6);
    const MatrixXd c = random.matrix(n, n);
    RiccatiProblem problem{
        random.matrix(n, n), random.matrix(n, 1), c.transpose() * c, MatrixXd::Identity(1, 1), {}};
    const auto solution = solve(problem, sampled);
    const double size = 1e-7;
    MatrixXd change = random.matrix(n, n);
    problem.a += change * (size * problem.a.norm() / change.norm());
    change += change.transpose().eval();
    problem.q += change * (size * problem.q.norm() / std::max(change.norm(), 1e-3));
    const double moved = (solve(problem, sampled).x - solution.x).norm() / solution.x.norm();
    // Norms are taken in scaled states, which differ by small factors here.
    EXPECT_LT(moved, 10.0 * size * solution.condition) << trial;
    EXPECT_GT(solution.condition, 0.5);
    EXPECT_EQ(solve(problem, sampled, {.estimate_condition = false}).condition, 0.0);
  }
}

}  // namespace
}  // namespace boresight::control
