#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_systems.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr auto zoh = Interpolation::zero_order_hold;
constexpr auto foh = Interpolation::first_order_hold;
// No eigenvectors are that good: the dense route.
constexpr double none = 0.0;

StateSpace stable_system(reference::RandomNumbers& random, Eigen::Index n, Eigen::Index inputs,
                         Eigen::Index outputs) {
  StateSpace system = reference::random_system(random, n, inputs, outputs);
  if (n > 0) system.a.diagonal().array() -= numerics::spectral_abscissa(system.a) + 0.2;
  return system;
}

TEST(ModalRecursion, GivesTheSameBitsWhateverTheWidth) {
  if (!available(LaneWidth::four)) GTEST_SKIP() << "this processor has no wide lanes";
  reference::RandomNumbers random(31);
  for (const auto& [modes, inputs, outputs] :
       {std::array<Eigen::Index, 3>{13, 1, 1}, {8, 2, 3}, {1, 1, 2}, {30, 3, 1}, {0, 1, 1}}) {
    const auto complex = [&](Eigen::Index rows, Eigen::Index columns) {
      return Eigen::MatrixXcd::NullaryExpr(rows, columns, [&] {
        return std::complex<double>(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      });
    };
    const Eigen::VectorXcd factor = 0.7 * complex(modes, 1);
    const Eigen::MatrixXcd input = complex(modes, inputs), output = complex(outputs, modes);
    const Eigen::MatrixXd feedthrough = random.matrix(outputs, inputs);
    const Eigen::MatrixXd u = random.matrix(700, inputs);
    const Eigen::VectorXcd start = complex(modes, 1);
    Eigen::MatrixXd two(700, outputs), four(700, outputs);
    ModalRecursion one(factor, input, output, feedthrough), other = one;
    one.set_state(start);
    other.set_state(start);
    one.run(u, two, LaneWidth::two);
    other.run(u, four, LaneWidth::four);
    EXPECT_EQ(two, four);
    EXPECT_EQ(one.state(), other.state());
    // And the right ones.
    Eigen::VectorXcd z = start;
    double worst = 0.0;
    for (Eigen::Index k = 0; k < u.rows(); ++k) {
      const Eigen::VectorXd y = feedthrough * u.row(k).transpose() + (output * z).real();
      worst = std::max(worst, (two.row(k).transpose() - y).norm());
      z = factor.cwiseProduct(z) + input * u.row(k).transpose();
    }
    EXPECT_LT(worst, 1e-12);
  }
}

TEST(LinearSimulation, OfALagAndAnOscillatorIsTheClosedForm) {
  // dy/dt = -2 y + 3 u, u = 1: y = 1.5 (1 - e^-2t); from y(0) = 1.
  LinearSimulation lag(
      reference::state_space(Eigen::MatrixXd::Constant(1, 1, -2.0),
                             Eigen::MatrixXd::Constant(1, 1, 3.0), Eigen::MatrixXd::Ones(1, 1),
                             Eigen::MatrixXd::Zero(1, 1)),
      0.01);
  lag.start_from(Eigen::VectorXd::Ones(1));
  const Eigen::MatrixXd y = lag.simulate(Eigen::MatrixXd::Ones(500, 1));
  for (Eigen::Index k = 0; k < 500; ++k) {
    EXPECT_NEAR(y(k, 0), 1.5 - 0.5 * std::exp(-0.02 * static_cast<double>(k)), 1e-13);
  }
  // Undamped, resonant: x'' + w^2 x = 0 from x = 1 keeps its amplitude for 1e5 samples.
  const double w = 7.0;
  Eigen::Matrix2d a;
  a << 0.0, 1.0, -w * w, 0.0;
  LinearSimulation oscillator(
      reference::state_space(a, Eigen::Vector2d(0.0, 1.0), Eigen::RowVector2d(1.0, 0.0),
                             Eigen::MatrixXd::Zero(1, 1)),
      0.01);
  oscillator.start_from(Eigen::Vector2d(1.0, 0.0));
  const Eigen::MatrixXd x = oscillator.simulate(Eigen::MatrixXd::Zero(100000, 1));
  for (const Eigen::Index k : {0, 1, 999, 50000, 99999}) {
    EXPECT_NEAR(x(k, 0), std::cos(0.01 * w * static_cast<double>(k)), 1e-10);
  }
}

TEST(LinearSimulation, AgreesByModesAndDensely) {
  reference::RandomNumbers random(32);
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::Index n = random.integer(0, 12), m = random.integer(1, 3),
                       p = random.integer(1, 3);
    const auto system = stable_system(random, n, m, p);
    const double step = random.log_uniform(1e-3, 3.0);
    const Eigen::MatrixXd u = random.matrix(600, m);
    const Eigen::VectorXd start = random.matrix(n, 1);
    for (const auto interpolation : {zoh, foh}) {
      LinearSimulation modes(system, step, {interpolation});
      LinearSimulation dense(system, step, {interpolation, none});
      EXPECT_TRUE(modes.by_modes());
      EXPECT_FALSE(dense.by_modes());
      modes.start_from(start);
      dense.start_from(start);
      const Eigen::MatrixXd one = modes.simulate(u), two = dense.simulate(u);
      EXPECT_LT((one - two).cwiseAbs().maxCoeff(),
                1e-12 * modes.modal_condition() * (1.0 + two.cwiseAbs().maxCoeff()))
          << trial;
    }
  }
}

TEST(LinearSimulation, GoesOnWhereThePieceBeforeEnded) {
  reference::RandomNumbers random(33);
  const auto system = stable_system(random, 7, 2, 2);
  const Eigen::MatrixXd u = random.matrix(1000, 2);
  for (const auto interpolation : {zoh, foh}) {
    for (const double largest_condition : {1e8, none}) {
      LinearSimulation whole(system, 0.05, {interpolation, largest_condition});
      LinearSimulation pieces = whole;
      const Eigen::MatrixXd expected = whole.simulate(u);
      Eigen::MatrixXd found(1000, 2);
      for (Eigen::Index start = 0, length = 1; start < 1000; start += length, length *= 3) {
        length = std::min(length, 1000 - start);
        pieces.simulate(u.middleRows(start, length), found.middleRows(start, length));
      }
      EXPECT_EQ(found, expected);
      // Starting again forgets.
      pieces.start_from(Eigen::VectorXd::Zero(7));
      EXPECT_EQ(pieces.simulate(u), expected);
      EXPECT_EQ(pieces.simulate(Eigen::MatrixXd(0, 2)).rows(), 0);
    }
  }
}

TEST(LinearSimulation, WithAFirstOrderHoldStartsFromTheStateItself) {
  // y = x must begin with the start whatever the first input.
  reference::RandomNumbers random(34);
  auto system = stable_system(random, 4, 1, 4);
  system.c.setIdentity();
  system.d.setZero();
  const Eigen::VectorXd start = random.matrix(4, 1);
  for (const double largest_condition : {1e8, none}) {
    LinearSimulation simulation(system, 0.1, {foh, largest_condition});
    simulation.start_from(start);
    const Eigen::MatrixXd y = simulation.simulate(random.matrix(3, 1));
    EXPECT_LT((y.row(0).transpose() - start).norm(), 1e-13);
  }
}

TEST(LinearSimulation, OfAChainOfEqualPolesTakesTheDenseRouteAndIsExact) {
  // 1/(s + 1)^3: step response 1 - e^-t (1 + t + t^2/2).
  LinearSimulation chain(rational({1.0}, {1.0, 3.0, 3.0, 1.0}, "u", "y", "x"), 0.1);
  EXPECT_FALSE(chain.by_modes());
  EXPECT_GT(chain.modal_condition(), 1e8);
  const Eigen::MatrixXd y = chain.simulate(Eigen::MatrixXd::Ones(200, 1));
  for (Eigen::Index k = 0; k < 200; ++k) {
    const double t = 0.1 * static_cast<double>(k);
    EXPECT_NEAR(y(k, 0), 1.0 - std::exp(-t) * (1.0 + t + 0.5 * t * t), 1e-13);
  }
  // Straight input u = t to a double integrator: t^3/6.
  LinearSimulation mass(rational({1.0}, {0.0, 0.0, 1.0}, "u", "y", "x"), 0.5, {foh});
  EXPECT_FALSE(mass.by_modes());
  const Eigen::MatrixXd x = mass.simulate(Eigen::VectorXd::LinSpaced(41, 0.0, 20.0));
  for (Eigen::Index k = 0; k <= 40; ++k) {
    const double t = 0.5 * static_cast<double>(k);
    EXPECT_NEAR(x(k, 0), t * t * t / 6.0, 1e-12 * (1.0 + t * t * t));
  }
}

TEST(LinearSimulation, OfASampledSystemIsItsOwnRecursion) {
  reference::RandomNumbers random(35);
  const auto continuous = stable_system(random, 5, 1, 2);
  const Eigen::MatrixXd u = random.matrix(300, 1);
  const Eigen::MatrixXd expected = LinearSimulation(continuous, 0.2).simulate(u);
  EXPECT_LT((LinearSimulation(sample(continuous, 0.2), 0.2).simulate(u) - expected).norm(), 1e-11);
  EXPECT_LT(
      (LinearSimulation(sample(continuous, 0.2), 0.2, {zoh, none}).simulate(u) - expected).norm(),
      1e-11);
}

TEST(LinearSimulation, OfTheAntennaFamilyMatchesThePeers) {
  const Eigen::Index samples = 600000;
  const double step = 1e-3;
  const Eigen::MatrixXd u = reference::peer_noise(samples) / std::sqrt(step);
  const auto system = reference::channel(reference::peer_closed_loop(5), "n", "y");
  const auto peers = reference::peer_values();
  for (const auto& [item, interpolation] : {std::pair{"lsim", zoh}, {"lsim_foh", foh}}) {
    LinearSimulation simulation(system, step, {interpolation});
    EXPECT_TRUE(simulation.by_modes());
    const Eigen::MatrixXd y = simulation.simulate(u);
    const auto expected = peers.at(item).at("5").at("val");
    EXPECT_LT(reference::relative_error(std::sqrt(y.squaredNorm() / static_cast<double>(samples)),
                                        expected.at(0)),
              1e-8);
    EXPECT_LT(reference::relative_error(y(samples - 1, 0), expected.at(1)), 1e-8);
    EXPECT_LT(reference::relative_error(y.cwiseAbs().maxCoeff(), expected.at(2)), 1e-8);
  }
}

TEST(LinearSimulation, OfADecayThroughTheSmallestNumbersEndsAtZero) {
  LinearSimulation lag(rational({1.0}, {1.0, 1.0}, "u", "y", "x"), 1.0);
  lag.start_from(Eigen::VectorXd::Ones(1));
  const Eigen::MatrixXd y = lag.simulate(Eigen::MatrixXd::Zero(2000, 1));
  EXPECT_NEAR(y(600, 0) / std::exp(-600.0), 1.0, 1e-12);
  EXPECT_EQ(y(1999, 0), 0.0);
}

TEST(LinearSimulation, NamesWhatItRefuses) {
  const auto lag = rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THAT(reference::Call([&] { LinearSimulation(lag, bad); }),
                ThrowsMessage<InvalidInput>(HasSubstr("a step above 0")));
  }
  EXPECT_THAT(reference::Call([&] { LinearSimulation(sample(lag, 0.1), 0.2); }),
              ThrowsMessage<InvalidInput>(HasSubstr("the sample time of the system, 0.1 s")));
  EXPECT_THAT(reference::Call([&] { LinearSimulation(sample(lag, 0.1), 0.1, {foh}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("for continuous systems")));
  for (const double largest_condition : {1e8, none}) {
    LinearSimulation simulation(lag, 0.1, {zoh, largest_condition});
    EXPECT_THAT(reference::Call([&] { simulation.simulate(Eigen::MatrixXd::Ones(5, 2)); }),
                ThrowsMessage<InvalidInput>(HasSubstr("found 5 x 2")));
    Eigen::MatrixXd gap = Eigen::MatrixXd::Ones(5, 1), y(4, 1);
    EXPECT_THROW(simulation.simulate(gap, y), InvalidInput);
    gap(3, 0) = std::nan("");
    EXPECT_THAT(reference::Call([&] { simulation.simulate(gap); }),
                ThrowsMessage<InvalidInput>(HasSubstr("not finite")));
    EXPECT_THAT(reference::Call([&] { simulation.start_from(Eigen::VectorXd::Ones(2)); }),
                ThrowsMessage<InvalidInput>(HasSubstr("found 2")));
    EXPECT_THROW(simulation.start_from(Eigen::VectorXd::Constant(1, HUGE_VAL)), InvalidInput);
    LinearSimulation runaway(rational({1.0}, {-5.0, 1.0}, "u", "y", "x"), 0.1,
                             {zoh, largest_condition});
    EXPECT_THAT(reference::Call([&] { runaway.simulate(Eigen::MatrixXd::Ones(2000, 1)); }),
                ThrowsMessage<NumericalFailure>(HasSubstr("overflows within the record")));
    EXPECT_THROW(LinearSimulation(rational({1.0}, {-5.0, 1.0}, "u", "y", "x"), 1e3,
                                  {zoh, largest_condition}),
                 NumericalFailure);
  }
}

}  // namespace
}  // namespace boresight::plant
