#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/reduction/gramians.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

plant::StateSpace random_system(reference::RandomNumbers& random, Index n, bool sampled) {
  MatrixXd a = random.matrix(n, n);
  if (sampled) {
    a *= random.uniform(0.3, 0.97) / numerics::eigenvalues(a).cwiseAbs().maxCoeff();
  } else {
    a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.05, 1.0);
  }
  return reference::state_space(a, random.matrix(n, 2), random.matrix(3, n), MatrixXd::Zero(3, 2),
                                sampled ? 0.1 : 0.0);
}

TEST(Gramians, SolveTheirEquations) {
  reference::RandomNumbers random(121);
  for (int trial = 0; trial < 20; ++trial) {
    const bool sampled = trial % 2 == 1;
    const auto system = random_system(random, random.integer(1, 10), sampled);
    const auto solve = [&](const MatrixXd& a, const MatrixXd& q) {
      return (sampled ? solve_discrete_lyapunov(a, q) : solve_lyapunov(a, q)).covariance;
    };
    const MatrixXd p = solve(system.a, system.b * system.b.transpose());
    const MatrixXd q = solve(system.a.transpose(), system.c.transpose() * system.c);
    EXPECT_LT((controllability_gramian(system) - p).norm(), 1e-12 * p.norm());
    EXPECT_LT((observability_gramian(system) - q).norm(), 1e-12 * q.norm());
    const auto factors = gramian_factors(system);
    EXPECT_LT((factors.controllability * factors.controllability.transpose() - p).norm(),
              1e-12 * p.norm());
    EXPECT_LT((factors.observability * factors.observability.transpose() - q).norm(),
              1e-12 * q.norm());
    // sigma^2 are the eigenvalues of P Q, in any basis.
    const Eigen::VectorXd sigma = hankel_singular_values(system);
    EXPECT_NEAR(sigma.squaredNorm(), (p * q).trace(), 1e-12 * (p * q).trace());
    EXPECT_NEAR(sigma[0] * sigma[0], numerics::eigenvalues(p * q).cwiseAbs().maxCoeff(),
                1e-11 * sigma[0] * sigma[0]);
  }
}

TEST(Gramians, GiveTheReferencesHankelSingularValues) {
  const auto entry = reference::reference_values("norms_gramians").at("hsv").at(0);
  const MatrixXd c = reference::matrix(entry.at("C"));
  const auto system =
      reference::state_space(reference::matrix(entry.at("A")), reference::matrix(entry.at("B")), c,
                             MatrixXd::Zero(c.rows(), 1));
  const Eigen::VectorXd found = hankel_singular_values(system);
  for (Index i = 0; i < 2; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto verified = reference::printed_number(entry.at("hsv_verified").at(at));
    EXPECT_NEAR(found[i], verified.value, verified.half_unit);
  }
}

TEST(Gramians, OfOneLagInClosedForm) {
  // b/(s + a): P = b^2/(2 a), Q = 1/(2 a), sigma = b/(2 a), half the static gain.
  const auto lag = plant::rational({3.0}, {2.0, 1.0}, "u", "y", "x");
  EXPECT_NEAR(hankel_singular_values(lag)[0], 0.75, 1e-15);
  const auto all_pass = plant::rational({1.0, -1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_NEAR(hankel_singular_values(all_pass)[0], 1.0, 1e-15);
  EXPECT_EQ(hankel_singular_values(plant::static_gain(MatrixXd::Ones(1, 1), {"u"}, {"y"})).size(),
            0);
}

TEST(Gramians, KeepTheDigitsOfSmallHankelSingularValues) {
  // Ten lags in a row: sigma falls over seven powers of ten.
  const Index n = 10;
  MatrixXd a = MatrixXd::Zero(n, n), b = MatrixXd::Zero(n, 1), c = MatrixXd::Zero(1, n);
  for (Index i = 0; i < n; ++i) {
    a(i, i) = -1.0;
    if (i > 0) a(i, i - 1) = 1.0;
  }
  b(0, 0) = 1.0;
  c(0, n - 1) = 1.0;
  const auto system = reference::state_space(a, b, c, MatrixXd::Zero(1, 1));
  const auto dual =
      reference::state_space(a.transpose(), c.transpose(), b.transpose(), MatrixXd::Zero(1, 1));
  const Eigen::VectorXd sigma = hankel_singular_values(system);
  EXPECT_LT(sigma[n - 1], 1e-7);
  // The transposed system has the same values and another rounding.
  EXPECT_LT((sigma - hankel_singular_values(dual)).cwiseAbs().maxCoeff(), 1e-15);
  // With one input and one output they are, up to sign, the eigenvalues of the cross Gramian, whose
  // trace is half the static gain.
  double trace = 0.0;
  for (Index i = 0; i < n; ++i) trace += sigma[i] * (i % 2 == 0 ? 1.0 : -1.0);
  EXPECT_NEAR(trace, 0.5, 1e-14);
}

TEST(Gramians, RefuseWhatIsNotStable) {
  const auto integrator = plant::rational({1.0}, {0.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(reference::Call([&] { hankel_singular_values(integrator); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("hankel_singular_values")));
  EXPECT_THROW(gramian_factors(integrator), NumericalFailure);
  EXPECT_THAT(reference::Call([&] { controllability_gramian(integrator); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("remove integrators")));
  EXPECT_THROW(observability_gramian(integrator), NumericalFailure);
}

}  // namespace
}  // namespace boresight::control
