#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_systems.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using reference::random_system;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Complex response(const StateSpace& system, double w) {
  return frequency_response(system, w)(0, 0);
}

void expect_matrix(const Eigen::MatrixXd& found, const nlohmann::json& expected) {
  const Eigen::MatrixXd reference = reference::matrix(expected);
  ASSERT_EQ(found.rows(), reference.rows());
  for (Eigen::Index i = 0; i < found.rows(); ++i) {
    for (Eigen::Index j = 0; j < found.cols(); ++j) {
      const double digit =
          reference::printed_number(
              expected.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)))
              .half_unit;
      EXPECT_NEAR(found(i, j), reference(i, j), std::max(digit, 1e-14)) << i << ", " << j;
    }
  }
}

TEST(Sample, MatchesTheReferencesElementByElement) {
  const auto file = reference::reference_values("c2d");
  auto continuous = file.at("C_222_d");
  const double period = continuous.at("Ts");
  continuous.erase("Ts");
  const auto system = reference::matrices_of(continuous);
  const auto held = sample(system, period);
  expect_matrix(held.a, file.at("zoh").at("A"));
  expect_matrix(held.b, file.at("zoh").at("B"));
  EXPECT_EQ(held.c, system.c);
  EXPECT_EQ(held.d, system.d);
  EXPECT_EQ(held.sample_time, period);
  const auto straight = sample(system, period, SamplingMethod::first_order_hold);
  expect_matrix(straight.a, file.at("foh").at("A"));
  expect_matrix(straight.b, file.at("foh").at("B"));
  EXPECT_EQ(straight.c, system.c);
  expect_matrix(straight.d, file.at("foh").at("D"));
  for (const auto& [name, prewarp] :
       {std::pair{"tustin_matlab", 0.0}, {"tustin_prewarp_10rad_matlab", 10.0}}) {
    const auto trapezoid = sample(system, period, SamplingMethod::tustin, {prewarp, {}});
    expect_matrix(trapezoid.a, file.at(name).at("A"));
    expect_matrix(trapezoid.b, file.at(name).at("B"));
    expect_matrix(trapezoid.c, file.at(name).at("C"));
    expect_matrix(trapezoid.d, file.at(name).at("D"));
  }
}

TEST(Sample, OfATransferFunctionHasTheReferencesResponse) {
  const auto file = reference::reference_values("c2d").at("tf_zoh");
  const double period = file.at("Ts");
  const auto system = sample(rational(reference::ascending(file.at("num")),
                                      reference::ascending(file.at("den")), "u", "y", "x"),
                             period);
  const auto numerator = reference::ascending(file.at("num_d"));
  const auto denominator = reference::ascending(file.at("den_d"));
  const auto value = [](const std::vector<double>& ascending, Complex z) {
    Complex sum = 0.0;
    for (auto c = ascending.rbegin(); c != ascending.rend(); ++c) sum = sum * z + *c;
    return sum;
  };
  for (const double w : {0.1, 1.0, 5.0, 15.0}) {
    const Complex z = std::polar(1.0, w * period);
    EXPECT_LT(
        reference::relative_error(response(system, w), value(numerator, z) / value(denominator, z)),
        1e-11);
  }
}

TEST(Sample, OfTheAntennaFamilyMatchesThePeers) {
  const auto peers = reference::peer_values().at("c2d");
  for (const int modes : {5, 50}) {
    const auto sampled =
        sample(reference::channel(reference::peer_closed_loop(modes), "n", "y"), 1e-3);
    const auto expected = peers.at(std::to_string(modes)).at("val");
    EXPECT_LT(reference::relative_error(sampled.a.norm(), expected.at(0)), 1e-10);
    EXPECT_LT(reference::relative_error(sampled.b.norm(), expected.at(1)), 1e-10);
  }
}

TEST(ZeroOrderHold, OfALagAndOfADoubleIntegratorIsTheClosedForm) {
  const double period = 0.3;
  const auto lag = sample(rational({5.0}, {2.0, 1.0}, "u", "y", "lag"), period);
  EXPECT_DOUBLE_EQ(lag.a(0, 0), std::exp(-0.6));
  EXPECT_NEAR(lag.c(0, 0) * lag.b(0, 0), 2.5 * (1.0 - std::exp(-0.6)), 1e-15);
  const auto mass = sample(rational({1.0}, {0.0, 0.0, 1.0}, "u", "y", "m"), period);
  // T^2 (z + 1)/(2 (z - 1)^2)
  for (const double w : {0.5, 3.0, 9.0}) {
    const Complex z = std::polar(1.0, w * period);
    EXPECT_LT(
        std::abs(response(mass, w) - period * period * (z + 1.0) / (2.0 * (z - 1.0) * (z - 1.0))),
        1e-13);
  }
}

// Response at z = exp(j w T) of the sampled delayed system, from its impulse response: a held unit
// pulse, delayed, through the continuous system, sampled finely and exactly.
TEST(ZeroOrderHold, WithADeadTimeIsTheDelayedHeldPulse) {
  reference::RandomNumbers random(21);
  for (int trial = 0; trial < 30; ++trial) {
    const double period = 0.1;
    const int fine = 20;
    const int late = random.integer(0, 70);  // in units of T/20
    Eigen::MatrixXd a = random.matrix(3, 3);
    a.diagonal().array() -= 2.0;
    const auto system =
        reference::state_space(a, random.matrix(3, 1), random.matrix(1, 3), random.matrix(1, 1));
    const auto delayed =
        sample(system, period, SamplingMethod::zero_order_hold, {0.0, {late * period / fine}});
    const int samples = late / fine, rest = late % fine;
    EXPECT_EQ(delayed.a.rows(), 3 + samples + (rest > 0 ? 1 : 0));
    const auto fast = sample(system, period / fine);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(delayed.a.rows());
    for (int k = 0; k < 12 * fine; ++k) {
      if (k % fine == 0) {
        const double u = k == 0 ? 1.0 : 0.0;
        const double old = k >= late && k < late + fine ? 1.0 : 0.0;
        // At a change of the input that falls onto a sample the new value counts.
        const double expected = (system.c * x)(0) + system.d(0, 0) * old;
        EXPECT_NEAR((delayed.c * z)(0) + delayed.d(0, 0) * u, expected, 1e-13)
            << trial << ", " << k << ", " << late;
        z = delayed.a * z + delayed.b.col(0) * u;
      }
      x = fast.a * x + fast.b.col(0) * (k >= late && k < late + fine ? 1.0 : 0.0);
    }
  }
}

TEST(ZeroOrderHold, NamesTheHeldInputsAndDelaysEachByItsOwn) {
  reference::RandomNumbers random(22);
  const auto system = random_system(random, 2, 2, 1);
  const auto delayed =
      sample(system, 0.1, SamplingMethod::zero_order_hold, {0.0, {0.25, 0.1 * (1.0 - 1e-12)}});
  EXPECT_THAT(delayed.states,
              ElementsAre("x1", "x2", "u1_held_1", "u1_held_2", "u1_held_3", "u2_held_1"));
  // A whole sample late: the response times 1/z.
  const auto prompt = sample(system, 0.1);
  for (const double w : {0.3, 4.0, 20.0}) {
    const Complex expected = frequency_response(prompt, w)(0, 1) * std::polar(1.0, -0.1 * w);
    EXPECT_LT(std::abs(frequency_response(delayed, w)(0, 1) - expected), 1e-12);
  }
  const auto none = sample(system, 0.1, SamplingMethod::zero_order_hold, {0.0, {0.0, 0.0}});
  EXPECT_EQ(none.a, prompt.a);
  EXPECT_EQ(none.b, prompt.b);
  EXPECT_EQ(none.d, prompt.d);
}

TEST(FirstOrderHold, IsExactForStraightInputs) {
  // y of u = t^1 between samples: compare with a held input sampled ever finer, which converges.
  reference::RandomNumbers random(23);
  Eigen::MatrixXd a = random.matrix(4, 4);
  a.diagonal().array() -= 2.0;
  const auto system =
      reference::state_space(a, random.matrix(4, 1), random.matrix(1, 4), random.matrix(1, 1));
  const double period = 0.5;
  const auto straight = sample(system, period, SamplingMethod::first_order_hold);
  // A ramp u = t: for a ramp the hold has no corners, and y = (D + G0) t + G1 with
  // G(s) = G0 + G1 s + ...: steady part C A^-2 B, transient by the exponential.
  StateSpace ramp = system;  // augmented by du/dt = r
  ramp.a = Eigen::MatrixXd::Zero(6, 6);
  ramp.a.topLeftCorner(4, 4) = system.a;
  ramp.a.block(0, 4, 4, 1) = system.b;
  ramp.a(4, 5) = 1.0;
  ramp.b = Eigen::MatrixXd::Zero(6, 1);
  ramp.c = Eigen::MatrixXd::Zero(1, 6);
  ramp.c.leftCols(4) = system.c;
  ramp.c(0, 4) = system.d(0, 0);
  ramp.d.setZero();
  ramp.states = {"x1", "x2", "x3", "x4", "u", "r"};
  const auto exact = sample(ramp, period);
  Eigen::VectorXd x = Eigen::VectorXd::Unit(6, 5);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(4);
  for (int k = 0; k < 20; ++k) {
    const double u = period * k;
    EXPECT_NEAR((straight.c * z)(0) + straight.d(0, 0) * u, (exact.c * x)(0), 1e-13);
    z = straight.a * z + straight.b * u;
    x = exact.a * x;
  }
}

TEST(Tustin, IsTheContinuousResponseAtTheWarpedFrequency) {
  reference::RandomNumbers random(24);
  const double period = 0.2;
  for (const double prewarp : {0.0, 0.7, 12.0}) {
    const auto system = random_system(random, 5, 1, 1);
    const auto sampled = sample(system, period, SamplingMethod::tustin, {prewarp, {}});
    const double slope = prewarp > 0.0 ? prewarp / std::tan(0.5 * prewarp * period) : 2.0 / period;
    for (const double w : {0.01, 0.7, 5.0, 14.0}) {
      const double warped = slope * std::tan(0.5 * w * period);
      EXPECT_LT(reference::relative_error(response(sampled, w), response(system, warped)), 1e-11);
    }
    if (prewarp > 0.0) {
      EXPECT_LT(reference::relative_error(response(sampled, prewarp), response(system, prewarp)),
                1e-12);
    }
  }
}

TEST(Sample, DoesNotCareForTheUnitsOfTheStates) {
  reference::RandomNumbers random(25);
  const auto system = random_system(random, 5, 1, 1);
  Eigen::VectorXd unit(5);
  unit << 1e-9, 1e6, 1.0, 1e12, 1e-3;
  StateSpace scaled = system;
  scaled.a = unit.asDiagonal() * system.a * unit.cwiseInverse().asDiagonal();
  scaled.b = unit.asDiagonal() * system.b;
  scaled.c = system.c * unit.cwiseInverse().asDiagonal();
  for (const auto method : {SamplingMethod::zero_order_hold, SamplingMethod::first_order_hold,
                            SamplingMethod::tustin}) {
    const auto plain = sample(system, 0.1, method), other = sample(scaled, 0.1, method);
    const Eigen::MatrixXd back = unit.cwiseInverse().asDiagonal() * other.a * unit.asDiagonal();
    EXPECT_LT((back - plain.a).norm(), 1e-13 * plain.a.norm());
    EXPECT_LT((unit.cwiseInverse().asDiagonal() * other.b - plain.b).norm(), 1e-13);
    EXPECT_LT((other.c * unit.asDiagonal() - plain.c).norm(), 1e-12);
    EXPECT_LT((other.d - plain.d).norm(), 1e-13);
  }
}

TEST(Sample, OfAStaticGainOnlyGetsTheClock) {
  const auto gain = static_gain(Eigen::MatrixXd::Constant(1, 1, 3.0), {"u"}, {"y"});
  for (const auto method : {SamplingMethod::zero_order_hold, SamplingMethod::first_order_hold,
                            SamplingMethod::tustin}) {
    const auto sampled = sample(gain, 0.1, method);
    EXPECT_EQ(sampled.d, gain.d);
    EXPECT_EQ(sampled.sample_time, 0.1);
  }
  const auto late = sample(gain, 0.1, SamplingMethod::zero_order_hold, {0.0, {0.15}});
  EXPECT_THAT(late.states, ElementsAre("u_held_1", "u_held_2"));
  EXPECT_LT(std::abs(response(late, 2.0) - 3.0 * std::polar(1.0, -0.4)), 1e-14);
}

TEST(Sample, NamesWhatItRefuses) {
  const auto lag = rational({1.0}, {1.0, 1.0}, "u", "y", "lag");
  const auto zoh = SamplingMethod::zero_order_hold, foh = SamplingMethod::first_order_hold,
             tustin = SamplingMethod::tustin;
  const auto refused = [&](double period, SamplingMethod method, const SamplingOptions& options,
                           const char* message) {
    EXPECT_THAT(reference::Call([&] { sample(lag, period, method, options); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  for (const double bad : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
    refused(bad, zoh, {}, "sample time above 0");
  }
  refused(0.1, foh, {1.0, {}}, "prewarp_frequency applies to Tustin");
  refused(0.1, tustin, {-1.0, {}}, "found -1 rad/s");
  refused(0.1, tustin, {std::numbers::pi / 0.1, {}}, "between 0 and pi/T = 31.4159");
  refused(0.1, tustin, {0.0, {0.1}}, "dead_times go with the zero-order hold");
  refused(0.1, zoh, {0.0, {0.1, 0.1}}, "found 2");
  refused(0.1, zoh, {0.0, {-0.1}}, "-0.1 s at the input 'u'");
  refused(0.1, zoh, {0.0, {1e9}}, "10000 samples at most");
  refused(0.1, zoh, {0.0, {std::nan("")}}, "at the input 'u'");
  EXPECT_THAT(reference::Call([&] { sample(sample(lag, 0.1), 0.1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found one with a sample time of 0.1 s")));
  EXPECT_THAT(reference::Call([] {
                sample(rational({1.0}, {-20.0, 1.0}, "u", "y", "x"), 0.1, SamplingMethod::tustin);
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("a pole at 20 1/s")));
  EXPECT_THROW(sample(rational({1.0}, {-1e5, 1.0}, "u", "y", "x"), 0.1), NumericalFailure);
}

}  // namespace
}  // namespace boresight::plant
