#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

StateSpace random_system(reference::RandomNumbers& random, Eigen::Index n,
                         std::vector<std::string> inputs, std::vector<std::string> outputs,
                         const std::string& name) {
  const auto m = static_cast<Eigen::Index>(inputs.size());
  const auto p = static_cast<Eigen::Index>(outputs.size());
  StateSpace system{random.matrix(n, n),
                    random.matrix(n, m),
                    random.matrix(p, n),
                    0.3 * random.matrix(p, m),
                    std::move(inputs),
                    std::move(outputs),
                    {}};
  for (Eigen::Index i = 0; i < n; ++i) system.states.push_back(name + std::to_string(i));
  return system;
}

Complex polynomial(const std::vector<double>& ascending, Complex s) {
  Complex value = 0.0;
  for (auto c = ascending.rbegin(); c != ascending.rend(); ++c) value = value * s + *c;
  return value;
}

TEST(Rational, HasTheResponseOfItsPolynomials) {
  reference::RandomNumbers random(41);
  for (int order = 0; order <= 6; ++order) {
    std::vector<double> numerator, denominator;
    for (int i = 0; i <= order; ++i) {
      numerator.push_back(random.uniform(-2.0, 2.0));
      denominator.push_back(random.uniform(0.5, 2.0));
    }
    if (order % 2 == 1) numerator.pop_back();  // strictly proper
    const auto system = rational(numerator, denominator, "in", "out", "filter");
    EXPECT_EQ(system.a.rows(), order);
    for (const double w : {0.0, 0.1, 1.3, 25.0}) {
      const Complex s{0.0, w};
      const Complex expected = polynomial(numerator, s) / polynomial(denominator, s);
      EXPECT_LT(std::abs(frequency_response(system, w)(0, 0) - expected),
                1e-12 * (1.0 + std::abs(expected)));
    }
  }
}

TEST(Rational, NamesItsStatesAndRefusesWhatIsNotProper) {
  EXPECT_THAT(rational({1.0}, {1.0, 0.5, 2.0}, "in", "out", "lag").states,
              ElementsAre("lag.1", "lag.2"));
  EXPECT_THAT(reference::Call([] {
                rational({0.0, 0.0, 1.0}, {1.0, 1.0}, "in", "out", "lead");
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("'lead': expected a proper function")));
  EXPECT_THAT(reference::Call([] {
                rational({1.0}, {1.0, 0.0}, "in", "out", "lag");
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("leading denominator coefficient")));
  EXPECT_THROW(rational({}, {}, "in", "out", "lag"), InvalidInput);
}

TEST(Connect, ClosesALoopAsByHand) {
  // Plant 1/(s (s + 2)), PI 3 (1 + 0.5/s), error = reference - angle, by hand:
  // states angle, rate, integral; u = 3 (e + 0.5 integral of e).
  const auto plant = rational({1.0}, {0.0, 2.0, 1.0}, "u", "angle", "plant");
  const auto pi = rational({1.5, 3.0}, {0.0, 1.0}, "error", "u", "integral");
  Eigen::MatrixXd difference(1, 2);
  difference << 1.0, -1.0;
  const auto sum = static_gain(difference, {"reference", "angle"}, {"error"});
  const auto loop = connect({plant, pi, sum}, {"reference"}, {"angle", "error"});
  Eigen::Matrix3d a;
  a << 0, 1, 0, -3, -2, 1.5, -1, 0, 0;
  EXPECT_LT((loop.a - a).norm(), 1e-14);
  EXPECT_LT((loop.b - Eigen::Vector3d(0, 3, 1)).norm(), 1e-14);
  EXPECT_LT((loop.c.row(1) + Eigen::RowVector3d(1, 0, 0)).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(loop.d(1, 0), 1.0);
  EXPECT_THAT(loop.states, ElementsAre("plant.1", "plant.2", "integral.1"));
  EXPECT_THAT(loop.outputs, ElementsAre("angle", "error"));
}

TEST(Connect, OfFeedthroughSystemsHasTheClosedLoopsResponse) {
  reference::RandomNumbers random(42);
  const auto forward = random_system(random, 4, {"e"}, {"y"}, "f");
  const auto back = random_system(random, 3, {"y"}, {"z"}, "b");
  const auto sum = static_gain(Eigen::MatrixXd::Ones(1, 2), {"r", "z"}, {"e"});
  const auto loop = connect({back, sum, forward}, {"r"}, {"y", "e", "z"});
  for (const double w : {0.0, 0.4, 3.0, 60.0}) {
    const Complex f = frequency_response(forward, w)(0, 0), b = frequency_response(back, w)(0, 0);
    const Eigen::MatrixXcd found = frequency_response(loop, w);
    const Complex e = 1.0 / (1.0 - f * b);
    EXPECT_LT(std::abs(found(0, 0) - f * e), 1e-11 * (1.0 + std::abs(f * e)));
    EXPECT_LT(std::abs(found(1, 0) - e), 1e-11 * (1.0 + std::abs(e)));
    EXPECT_LT(std::abs(found(2, 0) - f * b * e), 1e-11 * (1.0 + std::abs(f * b * e)));
  }
}

TEST(Connect, DoesNotDependOnTheOrderOfTheSystems) {
  reference::RandomNumbers random(43);
  const auto one = random_system(random, 3, {"a", "z"}, {"y"}, "one");
  const auto two = random_system(random, 2, {"y", "a"}, {"z"}, "two");
  const auto ab = connect({one, two}, {"a"}, {"y", "z"});
  const auto ba = connect({two, one}, {"a"}, {"y", "z"});
  EXPECT_LT((frequency_response(ab, 0.7) - frequency_response(ba, 0.7)).norm(), 1e-12);
  EXPECT_LT((numerics::eigenvalues(ab.a) - numerics::eigenvalues(ba.a)).norm(), 1e-10);
}

TEST(Connect, FeedsSeveralSystemsFromOneExternalInput) {
  const auto one = static_gain(Eigen::MatrixXd::Constant(1, 1, 2.0), {"r"}, {"x"});
  const auto two = static_gain(Eigen::MatrixXd::Constant(1, 1, 5.0), {"r"}, {"y"});
  const auto both = connect({one, two}, {"r"}, {"y", "x"});
  EXPECT_DOUBLE_EQ(both.d(0, 0), 5.0);
  EXPECT_DOUBLE_EQ(both.d(1, 0), 2.0);
}

TEST(Connect, NamesTheSignalItRefuses) {
  const auto gain = [](const char* input, const char* output, double value = 1.0) {
    return static_gain(Eigen::MatrixXd::Constant(1, 1, value), {input}, {output});
  };
  const auto lag = rational({1.0}, {1.0, 1.0}, "u", "y", "lag");
  EXPECT_THAT(reference::Call([&] {
                connect({gain("a", "y"), gain("b", "y")}, {"a", "b"}, {"y"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("output names, found 'y' twice")));
  EXPECT_THAT(reference::Call([&] {
                connect({gain("a", "y"), gain("b", "z")}, {"a"}, {"y"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("nothing feeds the input 'b'")));
  EXPECT_THAT(reference::Call([&] {
                connect({gain("a", "y")}, {"a", "idle"}, {"y"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("external input 'idle'")));
  EXPECT_THAT(reference::Call([&] {
                connect({gain("a", "y"), gain("y", "z")}, {"a", "y"}, {"z"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("'y' is also an output")));
  EXPECT_THAT(reference::Call([&] { connect({gain("a", "y")}, {"a"}, {"x"}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'x'")));
  EXPECT_THAT(reference::Call([&] {
                connect({lag, rational({1.0}, {1.0, 2.0}, "u", "z", "lag")}, {"u"}, {"y"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'lag.1' twice")));
  EXPECT_THAT(reference::Call([&] {
                connect({gain("a", "y")}, {"a", "a"}, {"y"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'a' twice")));
  // y = u + r, u = y: no solution.
  const auto sum = static_gain(Eigen::MatrixXd::Ones(1, 2), {"u", "r"}, {"y"});
  EXPECT_THAT(reference::Call([&] {
                connect({sum, gain("y", "u")}, {"r"}, {"y"});
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("connect: the matrix is singular")));
  // With gain 1/2 it has one: y = 2 r.
  EXPECT_DOUBLE_EQ(connect({sum, gain("y", "u", 0.5)}, {"r"}, {"y"}).d(0, 0), 2.0);
}

TEST(Validate, NamesTheMatrixThatDoesNotFit) {
  reference::RandomNumbers random(44);
  const StateSpace sound = random_system(random, 3, {"u", "v"}, {"y"}, "x");
  EXPECT_NO_THROW(validate(sound));
  const auto refused = [&](auto change, const char* message) {
    StateSpace system = sound;
    change(system);
    EXPECT_THAT(reference::Call([&] { validate(system); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused([](StateSpace& s) { s.a = Eigen::MatrixXd::Zero(3, 2); }, "expected A as 3 x 3");
  refused([](StateSpace& s) { s.b = Eigen::MatrixXd::Zero(3, 1); }, "expected B as 3 x 2");
  refused([](StateSpace& s) { s.c = Eigen::MatrixXd::Zero(2, 3); }, "expected C as 1 x 3");
  refused([](StateSpace& s) { s.d = Eigen::MatrixXd::Zero(1, 1); }, "expected D as 1 x 2");
  refused([](StateSpace& s) { s.a(0, 1) = std::nan(""); }, "A has elements that are not finite");
  refused([](StateSpace& s) { s.inputs[1] = "u"; }, "input names, found 'u' twice");
  refused([](StateSpace& s) { s.states[1] = "x0"; }, "state names, found 'x0' twice");
}

TEST(SignalIndex, FindsANameOrListsWhatThereIs) {
  reference::RandomNumbers random(45);
  const StateSpace system = random_system(random, 2, {"u", "v"}, {"y", "z"}, "x");
  EXPECT_EQ(input_index(system, "v"), 1);
  EXPECT_EQ(output_index(system, "y"), 0);
  EXPECT_THAT(reference::Call([&] { input_index(system, "w"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("inputs u, v, found 'w'")));
  EXPECT_THAT(reference::Call([&] { output_index(system, "w"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("outputs y, z, found 'w'")));
}

TEST(Connect, LeavesNoCouplingWhereNothingLeads) {
  // First-order sections with feedthrough in cascade, given in any order: strictly triangular.
  std::vector<StateSpace> sections;
  for (int i = 0; i < 6; ++i) {
    const auto name = [](int k) { return "s" + std::to_string(k); };
    const double pole = 0.01 * std::pow(4.3, i), zero = 0.0035 * std::pow(5.1, i);
    sections.push_back(rational({1.0 / 3.0, 1.0 / (3.0 * zero)}, {1.0, 1.0 / pole}, name(i),
                                name(i + 1), "section" + std::to_string(i)));
  }
  std::swap(sections[1], sections[4]);
  std::swap(sections[0], sections[2]);
  const auto whole = connect(sections, {"s0"}, {"s6"});
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      const char to = whole.states[static_cast<std::size_t>(i)][7];
      const char from = whole.states[static_cast<std::size_t>(j)][7];
      EXPECT_EQ(whole.a(i, j) != 0.0, from <= to) << from << " to " << to;
    }
  }
}

}  // namespace
}  // namespace boresight::plant
