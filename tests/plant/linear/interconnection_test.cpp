#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_systems.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::plant {
namespace {

using reference::random_system;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

StateSpace gain(double value, const char* input, const char* output) {
  return static_gain(Eigen::MatrixXd::Constant(1, 1, value), {input}, {output});
}

Eigen::MatrixXcd at(const StateSpace& system, double w) {
  return frequency_response(system, w);
}

Eigen::MatrixXcd identity(Eigen::Index n) {
  return Eigen::MatrixXcd::Identity(n, n);
}

Eigen::Matrix2cd inverse(const Eigen::Matrix2cd& m) {
  Eigen::Matrix2cd adjugate;
  adjugate << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return adjugate / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
}

void expect_equal(const Eigen::MatrixXcd& found, const Eigen::MatrixXcd& expected) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LT((found - expected).norm(), 1e-12 * (1.0 + expected.norm()));
}

constexpr double frequencies[] = {0.0, 0.31, 2.0, 45.0};

TEST(Subsystem, PicksAndReordersSignalsByName) {
  reference::RandomNumbers random(1);
  const auto all = random_system(random, 4, {"a", "b", "c"}, {"x", "y"}, "s");
  const auto some = subsystem(all, {"c", "a"}, {"y"});
  for (const double w : frequencies) {
    const Eigen::MatrixXcd h = at(all, w), part = at(some, w);
    EXPECT_EQ(part(0, 0), h(1, 2));
    EXPECT_EQ(part(0, 1), h(1, 0));
  }
  EXPECT_THAT(some.inputs, ElementsAre("c", "a"));
  EXPECT_EQ(some.states, all.states);
  EXPECT_THAT(reference::Call([&] { subsystem(all, {"d"}, {"y"}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("inputs among a, b, c, found 'd'")));
  EXPECT_THAT(reference::Call([&] {
                subsystem(all, {"a"}, {"y", "y"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("the output 'y' is given twice")));
  EXPECT_EQ(subsystem(all, {}, {"y"}).b.cols(), 0);
}

TEST(Renamed, ChangesNamesOnly) {
  reference::RandomNumbers random(2);
  const auto before = random_system(random, 2, {"u"}, {"y"}, "x");
  const auto after = renamed(before, {{"u", "torque"}, {"x2", "rate"}});
  EXPECT_THAT(after.inputs, ElementsAre("torque"));
  EXPECT_THAT(after.outputs, ElementsAre("y"));
  EXPECT_THAT(after.states, ElementsAre("x1", "rate"));
  EXPECT_EQ(after.a, before.a);
  EXPECT_THAT(reference::Call([&] {
                renamed(before, {{"v", "w"}});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'v'")));
  EXPECT_THAT(reference::Call([&] {
                renamed(before, {{"x1", "x2"}});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'x2' twice")));
}

TEST(Series, MultipliesResponsesWhateverTheOrderOfTheSignals) {
  reference::RandomNumbers random(3);
  const auto first = random_system(random, 3, {"u"}, {"a", "b", "unused"}, "f");
  const auto second = random_system(random, 2, {"b", "a"}, {"y", "z"}, "s");
  const auto both = series(first, second);
  for (const double w : frequencies) {
    Eigen::MatrixXcd middle(2, 1);
    middle << at(first, w)(1, 0), at(first, w)(0, 0);
    expect_equal(at(both, w), at(second, w) * middle);
  }
  EXPECT_THAT(both.states, ElementsAre("f1", "f2", "f3", "s1", "s2"));
  EXPECT_THAT(
      reference::Call([&] { series(second, first); }),
      ThrowsMessage<InvalidInput>(HasSubstr("input of the second systems among y, z, found 'u'")));
}

TEST(Parallel, AddsResponsesOfSignalsOfOneName) {
  reference::RandomNumbers random(4);
  const auto one = random_system(random, 3, {"u", "v"}, {"y", "z"}, "f");
  const auto two = random_system(random, 2, {"v", "u"}, {"z", "y"}, "s");
  const auto both = parallel(one, two);
  for (const double w : frequencies) {
    const Eigen::MatrixXcd h = at(two, w);
    Eigen::MatrixXcd turned(2, 2);
    turned << h(1, 1), h(1, 0), h(0, 1), h(0, 0);
    expect_equal(at(both, w), at(one, w) + turned);
  }
  EXPECT_EQ(both.inputs, one.inputs);
  EXPECT_EQ(both.outputs, one.outputs);
  EXPECT_THAT(reference::Call([&] {
                parallel(one, subsystem(two, {"v"}, {"y", "z"}));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'u'")));
  EXPECT_THAT(reference::Call([&] {
                parallel(subsystem(one, {"u", "v"}, {"y"}), two);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'z'")));
}

TEST(Feedback, HasTheClosedLoopsSixTransferMatrices) {
  reference::RandomNumbers random(5);
  const auto forward = random_system(random, 4, {"u", "v"}, {"y", "z"}, "f");
  const auto back = random_system(random, 3, {"z", "y"}, {"v", "u"}, "b");
  for (const double sign : {-1.0, 1.0}) {
    const auto loop = feedback(forward, back, {sign, {"dy", "dz"}, {"nz", "ny"}, {"ut", "vt"}});
    EXPECT_THAT(loop.inputs, ElementsAre("u", "v", "dy", "dz", "nz", "ny"));
    EXPECT_THAT(loop.outputs, ElementsAre("y", "z", "ut", "vt"));
    Eigen::MatrixXcd swap(2, 2);
    swap << 0.0, 1.0, 1.0, 0.0;
    for (const double w : frequencies) {
      const Eigen::MatrixXcd p = at(forward, w), k = swap * at(back, w) * swap;
      const Eigen::MatrixXcd s = inverse(identity(2) - sign * p * k);
      Eigen::MatrixXcd expected(4, 6);
      expected.topLeftCorner(2, 2) = s * p;
      expected.block(0, 2, 2, 2) = s;
      expected.topRightCorner(2, 2) = sign * s * p * k * swap;
      expected.bottomLeftCorner(2, 2) = inverse(identity(2) - sign * k * p);
      expected.block(2, 2, 2, 2) = sign * k * s;
      expected.bottomRightCorner(2, 2) = sign * k * s * swap;
      expect_equal(at(loop, w), expected);
    }
  }
}

TEST(Feedback, AroundPartOfTheSignals) {
  reference::RandomNumbers random(6);
  const auto forward = random_system(random, 3, {"u", "w"}, {"y", "z"}, "f");
  const auto back = random_system(random, 1, {"y"}, {"u"}, "b");
  const auto loop = feedback(forward, back);
  for (const double w : frequencies) {
    const Eigen::MatrixXcd p = at(forward, w);
    const auto k = at(back, w)(0, 0);
    // u = r - k y
    const Eigen::MatrixXcd correction = p.col(0) * (k / (1.0 + p(0, 0) * k)) * p.row(0);
    expect_equal(at(loop, w), p - correction);
  }
}

TEST(Feedback, OfSampledSystemsTakesAStaticGain) {
  StateSpace delay{Eigen::MatrixXd::Zero(1, 1),
                   Eigen::MatrixXd::Ones(1, 1),
                   Eigen::MatrixXd::Ones(1, 1),
                   Eigen::MatrixXd::Zero(1, 1),
                   {"u"},
                   {"y"},
                   {"x"},
                   0.01};
  const auto loop = feedback(delay, gain(0.5, "y", "u"));
  EXPECT_EQ(loop.sample_time, 0.01);
  EXPECT_DOUBLE_EQ(loop.a(0, 0), -0.5);
  StateSpace other = renamed(delay, {{"u", "y"}, {"y", "u"}, {"x", "other"}});
  EXPECT_EQ(feedback(delay, other).states.size(), 2u);
  other.sample_time = 0.02;
  EXPECT_THAT(reference::Call([&] { feedback(delay, other); }),
              ThrowsMessage<InvalidInput>(
                  AllOf(HasSubstr("one sample time"), HasSubstr("0.01"), HasSubstr("0.02"))));
}

TEST(Feedback, NamesWhatItRefuses) {
  const auto lag = rational({1.0}, {1.0, 1.0}, "u", "y", "lag");
  const auto refused = [&](const StateSpace& back, const FeedbackOptions& options,
                           const char* message) {
    EXPECT_THAT(reference::Call([&] { feedback(lag, back, options); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused(gain(1.0, "x", "u"), {}, "found 'x'");
  refused(gain(1.0, "y", "v"), {}, "found 'v'");
  refused(gain(1.0, "y", "u"), {0.5, {}, {}, {}}, "found 0.5");
  refused(gain(1.0, "y", "u"), {-1.0, {"d", "e"}, {}, {}}, "found 2 (d, e)");
  refused(gain(1.0, "y", "u"), {-1.0, {}, {"d", "e"}, {}}, "measurement noises");
  refused(gain(1.0, "y", "u"), {-1.0, {}, {}, {"d", "e"}}, "total inputs");
  refused(gain(1.0, "y", "u"), {-1.0, {"u"}, {}, {}}, "found 'u' twice");
  refused(rational({1.0}, {2.0, 1.0}, "y", "u", "lag"), {}, "found 'lag.1' twice");
}

TEST(Feedback, NamesTheAlgebraicLoopWithoutSolution) {
  const auto bold = rational({1.0, 2.0}, {1.0, 1.0}, "u", "y", "lead");
  EXPECT_THAT(reference::Call([&] { feedback(bold, gain(-0.5, "y", "u")); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("feedback: the algebraic loop through"), HasSubstr("u (total)"),
                        HasSubstr("y"), HasSubstr("delay"))));
  // Any other gain has one.
  EXPECT_NEAR(feedback(bold, gain(-0.25, "y", "u")).d(0, 0), 4.0, 1e-14);
}

TEST(LowerFractionalTransformation, IsTheFormulaOfItsBlocks) {
  reference::RandomNumbers random(7);
  const auto p = random_system(random, 4, {"w1", "u1", "w2", "u2"}, {"m1", "z", "m2"}, "p");
  const auto k = random_system(random, 2, {"m2", "m1"}, {"u1", "u2"}, "k");
  const auto closed = lower_fractional_transformation(p, k);
  EXPECT_THAT(closed.inputs, ElementsAre("w1", "w2"));
  EXPECT_THAT(closed.outputs, ElementsAre("z"));
  for (const double w : frequencies) {
    const Eigen::MatrixXcd all = at(subsystem(p, {"w1", "w2", "u1", "u2"}, {"z", "m2", "m1"}), w);
    const Eigen::MatrixXcd gain_k = at(k, w);
    const Eigen::MatrixXcd p22 = all.bottomRightCorner(2, 2);
    expect_equal(at(closed, w), all.topLeftCorner(1, 2) + all.topRightCorner(1, 2) * gain_k *
                                                              inverse(identity(2) - p22 * gain_k) *
                                                              all.bottomLeftCorner(2, 2));
  }
  EXPECT_THAT(reference::Call([&] {
                lower_fractional_transformation(p, renamed(k, {{"m1", "m3"}}));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'm3'")));
  EXPECT_THAT(reference::Call([&] {
                lower_fractional_transformation(p, renamed(k, {{"u1", "u3"}}));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'u3'")));
  const auto through = static_gain(Eigen::MatrixXd::Ones(2, 2), {"w", "u"}, {"z", "y"});
  EXPECT_THAT(
      reference::Call([&] { lower_fractional_transformation(through, gain(1.0, "y", "u")); }),
      ThrowsMessage<NumericalFailure>(HasSubstr("loop through u, y has no solution")));
}

}  // namespace
}  // namespace boresight::plant
