#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(MatrixExponential, OfARotationAGrowthAndAChain) {
  Eigen::Matrix2d rotation;
  rotation << 0.0, 3.0, -3.0, 0.0;
  Eigen::Matrix2d expected;
  expected << std::cos(3.0), std::sin(3.0), -std::sin(3.0), std::cos(3.0);
  EXPECT_LT((numerics::matrix_exponential(rotation) - expected).norm(), 1e-14);
  Eigen::Matrix3d chain;
  chain << -2.0, 1.0, 0.0, 0.0, -2.0, 1.0, 0.0, 0.0, -2.0;
  Eigen::Matrix3d powers;
  powers << 1.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0;
  EXPECT_LT((numerics::matrix_exponential(chain) - std::exp(-2.0) * powers).norm(), 1e-15);
  EXPECT_EQ(numerics::matrix_exponential(Eigen::MatrixXd(0, 0)).size(), 0);
  EXPECT_EQ(numerics::matrix_exponential(Eigen::MatrixXd::Zero(2, 2)),
            Eigen::MatrixXd::Identity(2, 2));
}

TEST(MatrixExponential, DoesNotCareForTheUnitsOfTheStates) {
  reference::RandomNumbers random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd a = 3.0 * random.matrix(6, 6);
    const Eigen::MatrixXd expected = numerics::matrix_exponential(a);
    // Pressures in Pa beside angles in rad: factors up to 1e12, here exact ones.
    const Eigen::VectorXd unit =
        Eigen::VectorXd::NullaryExpr(6, [&] { return std::exp2(random.integer(-20, 20)); });
    const Eigen::MatrixXd found =
        numerics::matrix_exponential(unit.asDiagonal() * a * unit.cwiseInverse().asDiagonal());
    const Eigen::MatrixXd back = unit.cwiseInverse().asDiagonal() * found * unit.asDiagonal();
    EXPECT_LT((back - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST(MatrixExponential, OfBadlyScaledPairsIsTheClosedForm) {
  // [p c; 0 q]: exp has (e^p - e^q)/(p - q) c in the corner, and c costs no digits.
  for (const double c : {1e-9, 1.0, 1e6, 1e12}) {
    Eigen::Matrix2d a;
    a << -1.0, c, 0.0, -3.0;
    const Eigen::MatrixXd found = numerics::matrix_exponential(a);
    EXPECT_NEAR(found(0, 0), std::exp(-1.0), 1e-12);
    EXPECT_NEAR(found(0, 1) / (c * 0.5 * (std::exp(-1.0) - std::exp(-3.0))), 1.0, 1e-11) << c;
    EXPECT_EQ(found(1, 0), 0.0);
  }
}

TEST(HeldTransition, AddsUpOverTwoTimes) {
  // x(s + t) of held and of rising inputs, by one step and by two.
  reference::RandomNumbers random(12);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Index n = random.integer(1, 7), m = random.integer(1, 3);
    const Eigen::MatrixXd a = random.matrix(n, n);
    const Eigen::MatrixXd b = random.log_uniform(1e-8, 1e8) * random.matrix(n, m);
    const double s = random.uniform(0.1, 2.0), t = random.uniform(0.1, 2.0);
    const auto one = numerics::held_transition(a, b, s), two = numerics::held_transition(a, b, t);
    const auto both = numerics::held_transition(a, b, s + t);
    const double size = both.step.norm() + both.ramp.norm();
    EXPECT_LT((two.state * one.state - both.state).norm(), 1e-13 * both.state.norm());
    EXPECT_LT((two.state * one.step + two.step - both.step).norm(), 1e-13 * size);
    const double part = s / (s + t);
    EXPECT_LT(
        (part * (two.state * one.ramp + two.step) + (1.0 - part) * two.ramp - both.ramp).norm(),
        1e-13 * size);
  }
}

TEST(HeldTransition, OfIntegratorsArePowersOfTime) {
  Eigen::Matrix2d a;
  a << 0.0, 1.0, 0.0, 0.0;
  const auto held = numerics::held_transition(a, Eigen::Vector2d(0.0, 1.0), 0.25);
  EXPECT_EQ(held.state(0, 1), 0.25);
  EXPECT_DOUBLE_EQ(held.step(0, 0), 0.25 * 0.25 / 2.0);
  EXPECT_DOUBLE_EQ(held.step(1, 0), 0.25);
  EXPECT_DOUBLE_EQ(held.ramp(0, 0), 0.25 * 0.25 / 6.0);
  EXPECT_DOUBLE_EQ(held.ramp(1, 0), 0.25 / 2.0);
  const auto none = numerics::held_transition(a, Eigen::Vector2d(0.0, 1.0), 0.0);
  EXPECT_EQ(none.state, Eigen::MatrixXd::Identity(2, 2));
  EXPECT_EQ(none.step.norm(), 0.0);
}

TEST(HeldTransition, OfTheSlicotExampleMatchesItsPrintedDigits) {
  reference::SlicotData file("MB05ND.dat");
  const auto n = static_cast<Eigen::Index>(file.scalar(0));
  const Eigen::MatrixXd a = file.next_matrix(n, n);
  const auto held = numerics::held_transition(a, Eigen::MatrixXd::Identity(n, n), file.scalar(1));
  const auto expect = [&](const Eigen::MatrixXd& found, const char* heading) {
    const auto rows = reference::slicot_result("MB05ND.res", heading);
    ASSERT_EQ(static_cast<Eigen::Index>(rows.size()), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto printed = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
        EXPECT_NEAR(found(i, j), printed.value, printed.half_unit * (1.0 + 1e-9))
            << heading << i << ", " << j;
      }
    }
  };
  expect(held.state, "exp(A*DELTA) is");
  expect(held.step, "integral is");
}

TEST(HeldTransition, OfTheAntennaFamilyMatchesThePeers) {
  const auto peers = reference::peer_values();
  for (const int modes : {5, 50}) {
    const auto system = reference::channel(reference::peer_closed_loop(modes), "n", "y");
    const auto held = numerics::held_transition(system.a, system.b, 1e-3);
    const auto expm = peers.at("expm").at(std::to_string(modes)).at("val");
    EXPECT_LT(reference::relative_error(held.state.norm(), expm.at(0)), 1e-10);
    EXPECT_LT(reference::relative_error(held.state.trace(), expm.at(1)), 1e-12);
    const auto c2d = peers.at("c2d").at(std::to_string(modes)).at("val");
    EXPECT_LT(reference::relative_error(held.step.norm(), c2d.at(1)), 1e-10);
  }
}

TEST(HeldTransition, RefusesWhatHasNoMeaning) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(2, 2), b = Eigen::MatrixXd::Ones(2, 1);
  EXPECT_THAT(reference::Call([&] { numerics::held_transition(a, b, -1.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found -1 s")));
  EXPECT_THROW(numerics::held_transition(a, b, std::nan("")), InvalidInput);
  EXPECT_THAT(
      reference::Call([&] { numerics::held_transition(a, Eigen::MatrixXd::Ones(3, 1), 1.0); }),
      ThrowsMessage<InvalidInput>(HasSubstr("found 2 x 2 and 3 x 1")));
  EXPECT_THROW(numerics::held_transition(a * HUGE_VAL, b, 1.0), InvalidInput);
  EXPECT_THAT(reference::Call([&] { numerics::held_transition(1e4 * a, b, 1.0); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("overflows")));
  EXPECT_THROW(numerics::matrix_exponential(Eigen::MatrixXd::Ones(2, 3)), InvalidInput);
  EXPECT_THROW(numerics::matrix_exponential(a * 1e300), NumericalFailure);
  EXPECT_EQ(
      numerics::held_transition(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), 1.0).step.cols(), 2);
}

}  // namespace
}  // namespace boresight::plant
