#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/chain_with_rounding_error.hpp"
#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/control/reduction/pole_placement.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

plant::StateSpace system_of(const MatrixXd& a, const MatrixXd& b) {
  return reference::state_space(a, b, MatrixXd::Identity(a.rows(), a.rows()),
                                MatrixXd::Zero(a.rows(), b.cols()));
}

std::vector<Complex> random_poles(reference::RandomNumbers& random, Index n) {
  std::vector<Complex> poles;
  while (static_cast<Index>(poles.size()) < n) {
    const double real = -random.uniform(0.2, 2.0);
    if (static_cast<Index>(poles.size()) + 2 <= n && random.integer(0, 1) == 0) {
      const double imaginary = random.uniform(0.1, 2.0);
      // Apart in the list: pairs are found.
      poles.insert(poles.begin(), Complex(real, imaginary));
      poles.emplace_back(real, -imaginary);
    } else {
      poles.emplace_back(real, 0.0);
    }
  }
  return poles;
}

// Largest distance of an eigenvalue of A - B K from the pole asked for that is nearest to it.
double error_of(const plant::StateSpace& system, const MatrixXd& gain,
                const std::vector<Complex>& poles) {
  std::vector<Complex> left = poles;
  double worst = 0.0;
  for (const Complex value : numerics::eigenvalues(system.a - system.b * gain)) {
    const auto nearest = std::min_element(left.begin(), left.end(), [&](Complex a, Complex b) {
      return std::abs(a - value) < std::abs(b - value);
    });
    worst = std::max(worst, std::abs(*nearest - value));
    left.erase(nearest);
  }
  return worst;
}

TEST(PolePlacement, OfTheReferenceCase) {
  const auto entry = reference::reference_values("riccati_place_scaling").at("place").at(0);
  const auto system = system_of(reference::matrix(entry.at("A")), reference::matrix(entry.at("B")));
  const auto poles = reference::complex_numbers(entry.at("poles"));
  const auto placed = place_poles(system, poles);
  const MatrixXd expected = reference::matrix(entry.at("K"));
  EXPECT_LT((placed.gain - expected).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(error_of(system, placed.gain, poles), 1e-13);
  EXPECT_LT(placed.backward_error, 1e-15);
  for (Index i = 0; i < 3; ++i) {
    const Complex value = placed.eigenvalues[i];
    EXPECT_LT(std::abs(value - poles[0]) * std::abs(value - poles[1]) * std::abs(value - poles[2]),
              1e-12);
  }
}

TEST(PolePlacement, WithOneInputIsAckermannsFormula) {
  // K = e_n' C^-1 p(A), C = [b, A b, ...]: another route, good for low orders.
  reference::RandomNumbers random(151);
  for (int trial = 0; trial < 40; ++trial) {
    const Index n = random.integer(1, 6);
    const MatrixXd a = random.matrix(n, n), b = random.matrix(n, 1);
    const auto poles = random_poles(random, n);
    MatrixXd reach(n, n);
    reach.col(0) = b;
    for (Index j = 1; j < n; ++j) reach.col(j) = a * reach.col(j - 1);
    Eigen::MatrixXcd polynomial = Eigen::MatrixXcd::Identity(n, n);
    for (const Complex pole : poles) {
      polynomial = polynomial * (a.cast<Complex>() - pole * Eigen::MatrixXcd::Identity(n, n));
    }
    const MatrixXd expected =
        numerics::linear_solve(reach, polynomial.real(), "test").bottomRows(1);
    const auto placed = place_poles(system_of(a, b), poles);
    EXPECT_LT((placed.gain - expected).norm(), 1e-8 * expected.norm()) << trial;
    EXPECT_LT(placed.backward_error, 1e-13);
  }
}

TEST(PolePlacement, PlacesRepeatedPolesWithOneInput) {
  // A chain of integrators with all poles at -1: K are the binomial coefficients.
  const Index n = 5;
  MatrixXd a = MatrixXd::Zero(n, n), b = MatrixXd::Zero(n, 1);
  for (Index i = 0; i + 1 < n; ++i) a(i, i + 1) = 1.0;
  b(n - 1, 0) = 1.0;
  const auto placed = place_poles(system_of(a, b), std::vector<Complex>(5, -1.0));
  Eigen::RowVectorXd expected(5);
  expected << 1.0, 5.0, 10.0, 10.0, 5.0;
  EXPECT_LT((placed.gain - expected).norm(), 1e-12);
  EXPECT_LT(placed.backward_error, 1e-14);
  EXPECT_GT(placed.eigenvector_condition, 1e6);  // one chain
}

TEST(PolePlacement, WithSeveralInputsReachesThePolesAndEvensTheEigenvectors) {
  reference::RandomNumbers random(152);
  for (int trial = 0; trial < 40; ++trial) {
    const Index inputs = random.integer(2, 4);
    const Index n = random.integer(static_cast<int>(inputs), 12);
    const auto system = system_of(random.matrix(n, n), random.matrix(n, inputs));
    const auto poles = random_poles(random, n);
    const auto placed = place_poles(system, poles);
    EXPECT_LT(placed.backward_error, 1e-12);
    EXPECT_LT(error_of(system, placed.gain, poles), 1e-10 * placed.eigenvector_condition);
    if (n == inputs) {
      EXPECT_NEAR(placed.eigenvector_condition, 1.0, 1e-6);
    }
    // More freedom than one of the inputs alone has.
    auto one = system;
    one.b = system.b.leftCols(1);
    one.d = system.d.leftCols(1);
    one.inputs.resize(1);
    const auto alone = place_poles(one, poles);
    EXPECT_LT(placed.eigenvector_condition, alone.eigenvector_condition * (1.0 + 1e-6));
    EXPECT_LT(placed.gain.norm(), 20.0 * alone.gain.norm());
  }
}

TEST(PolePlacement, OfTheExampleOfKautskyNicholsAndVanDooren) {
  // Their chemical reactor (example 1). SciPy's place_poles comes to |X| |X^-1| = 7.32 by their
  // method and to 7.00 by that of Tits and Yang, Frobenius norms.
  MatrixXd a(4, 4), b(4, 2);
  a << 1.38, -0.2077, 6.715, -5.676, -0.5814, -4.29, 0.0, 0.675, 1.067, 4.273, -6.654, 5.893, 0.048,
      4.273, 1.343, -2.104;
  b << 0.0, 0.0, 5.679, 0.0, 1.136, -3.146, 1.136, 0.0;
  const auto system = system_of(a, b);
  const std::vector<Complex> poles{-0.2, -0.5, -5.0566, -8.6659};
  const auto placed = place_poles(system, poles);
  EXPECT_LT(error_of(system, placed.gain, poles), 1e-12);
  EXPECT_LT(placed.eigenvector_condition * 4.0, 7.4);
  EXPECT_LT(placed.gain.norm(), 2.0);
}

TEST(PolePlacement, TakesInputsThatActAlikeAsOne) {
  reference::RandomNumbers random(153);
  const MatrixXd a = random.matrix(4, 4), b = random.matrix(4, 1);
  MatrixXd twice(4, 3);
  twice << b, -3e5 * b, MatrixXd::Zero(4, 1);
  const auto poles = random_poles(random, 4);
  const auto one = place_poles(system_of(a, b), poles);
  const auto three = place_poles(system_of(a, twice), poles);
  EXPECT_LT((twice * three.gain - b * one.gain).norm(), 1e-10 * (b * one.gain).norm());
  EXPECT_EQ(three.gain.row(2).norm(), 0.0);
}

TEST(PolePlacement, DoesNotDependOnUnits) {
  reference::RandomNumbers random(154);
  for (const Index inputs : {1, 2}) {
    const MatrixXd a = random.matrix(5, 5), b = random.matrix(5, inputs);
    const auto poles = random_poles(random, 5);
    const auto plain = place_poles(system_of(a, b), poles);
    Eigen::VectorXd unit(5);
    unit << 0x1p-30, 0x1p10, 0x1p20, 0x1p-5, 0x1p33;
    const MatrixXd scaled_b = unit.asDiagonal() * b * 0x1p40;
    const auto scaled = place_poles(
        system_of(unit.asDiagonal() * a * unit.cwiseInverse().asDiagonal(), scaled_b), poles);
    const MatrixXd back = 0x1p40 * scaled.gain * unit.asDiagonal();
    if (inputs == 1) {
      EXPECT_LT((back - plain.gain).norm(), 1e-9 * plain.gain.norm());
    }
    EXPECT_LT(error_of(system_of(a, b), back, poles), 1e-9);
  }
}

TEST(PolePlacement, PlacesAnObserverOnTheTransposedSystem) {
  reference::RandomNumbers random(155);
  const MatrixXd a = random.matrix(4, 4), c = random.matrix(1, 4);
  const auto poles = random_poles(random, 4);
  const MatrixXd l = place_poles(system_of(a.transpose(), c.transpose()), poles).gain.transpose();
  EXPECT_LT(error_of(system_of(a, l), c, poles), 1e-9);
}

plant::StateSpace chain_system() {
  const auto [a, b] = chain_with_rounding_error();
  return system_of(a, b);
}

TEST(PolePlacement, IsNotLedAstrayByACouplingThatIsARoundingError) {
  const auto system = chain_system();
  const std::vector<Complex> poles{-0.02, -0.1, -0.5, -1.0, -4.0, -30.0, {-1.0, 3.0}, {-1.0, -3.0}};
  const auto placed = place_poles(system, poles);
  EXPECT_LT(error_of(system, placed.gain, poles), 1e-9);
}

TEST(PolePlacement, RefusesWhatCannotBePlaced) {
  MatrixXd a(2, 2), b(2, 1);
  a << -1.0, 0.0, 0.0, 3.0;
  b << 1.0, 0.0;
  const auto unreached = system_of(a, b);
  EXPECT_THAT(
      [&] {
        place_poles(unreached, {-1.0, -2.0});
      },
      ThrowsMessage<NumericalFailure>(
          HasSubstr("the input u does not reach the eigenvalue 3 (states x2)")));
  b(1, 0) = 1.0;
  const auto system = system_of(a, b);
  EXPECT_THAT([&] { place_poles(system, {-1.0}); },
              ThrowsMessage<InvalidInput>(HasSubstr("expected 2 poles, one a state, found 1")));
  EXPECT_THAT(
      [&] {
        place_poles(system, {Complex(-1.0, 2.0), -3.0});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("found -1 + 2 j alone")));
  EXPECT_THAT(
      [&] {
        place_poles(system, {Complex(-1.0, -2.0), Complex(-1.0, -2.0)});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("found -1 - 2 j alone")));
  EXPECT_THROW(place_poles(system, {std::nan(""), -1.0}), InvalidInput);
  reference::RandomNumbers random(156);
  const MatrixXd wide_a = random.matrix(4, 4);
  const auto wide = system_of(wide_a, random.matrix(4, 2));
  EXPECT_THAT(
      [&] {
        place_poles(wide, {-1.0, -1.0, -1.0, -2.0});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("found -1 3 times")));
  EXPECT_LT(place_poles(wide, {-1.0, -1.0, -2.0, -2.0}).backward_error, 1e-12);
  const auto gain = plant::static_gain(MatrixXd::Ones(1, 1), {"u"}, {"y"});
  EXPECT_EQ(place_poles(gain, {}).gain.cols(), 0);
}

}  // namespace
}  // namespace boresight::control
