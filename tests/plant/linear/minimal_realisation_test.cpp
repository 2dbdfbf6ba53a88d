#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_systems.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/minimal_realisation.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using reference::random_system;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

void expect_same_response(const StateSpace& found, const StateSpace& expected, double tolerance) {
  for (const double w : {0.03, 0.4, 2.0, 30.0}) {
    const Eigen::MatrixXcd h = frequency_response(expected, w);
    EXPECT_LT((frequency_response(found, w) - h).norm(), tolerance * (1.0 + h.norm())) << w;
  }
}

TEST(MinimalRealisation, LeavesAMinimalSystemAsItIs) {
  reference::RandomNumbers random(61);
  const auto system = random_system(random, 6, 2, 2);
  const auto result = minimal_realisation(system);
  EXPECT_EQ(result.system.a, system.a);
  EXPECT_EQ(result.system.states, system.states);
  EXPECT_EQ(result.uncontrollable.size() + result.unobservable.size(), 0);
  EXPECT_EQ(result.largest_neglected, 0.0);
  EXPECT_GT(result.smallest_kept, 1e-4);
}

// The core with an uncontrollable, an unobservable part and one that is both, hidden by a random
// change of states.
TEST(MinimalRealisation, FindsTheCoreInAKalmanDecomposition) {
  reference::RandomNumbers random(62);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Index m = random.integer(1, 3), p = random.integer(1, 3);
    const Eigen::Index core = random.integer(0, 5), unreached = random.integer(0, 3),
                       unseen = random.integer(0, 3), n = core + unreached + unseen;
    const auto inner = random_system(random, core, m, p);
    StateSpace all = random_system(random, n, m, p);
    // Order: core, unseen (driven by all, seen by none), unreached (drives all, driven by none).
    all.a.topLeftCorner(core, core) = inner.a;
    all.a.block(0, core, core, unseen).setZero();
    all.a.block(n - unreached, 0, unreached, n - unreached).setZero();
    all.b.topRows(core) = inner.b;
    all.b.bottomRows(unreached).setZero();
    all.c.leftCols(core) = inner.c;
    all.c.middleCols(core, unseen).setZero();
    all.d = inner.d;
    const Eigen::VectorXcd unreached_poles =
        numerics::eigenvalues(all.a.bottomRightCorner(unreached, unreached));
    const Eigen::VectorXcd unseen_poles =
        numerics::eigenvalues(all.a.block(core, core, unseen, unseen));
    for (int i = 0; i < 3 && n > 0; ++i) {  // reflections: orthogonal and exactly inverted
      const Eigen::VectorXd v = random.matrix(n, 1).stableNormalized();
      const Eigen::MatrixXd q = Eigen::MatrixXd::Identity(n, n) - 2.0 * v * v.transpose();
      all.a = (q * all.a * q).eval();
      all.b = (q * all.b).eval();
      all.c = (all.c * q).eval();
    }
    const auto result = minimal_realisation(all);
    ASSERT_EQ(result.system.a.rows(), core) << trial;
    expect_same_response(result.system, inner, 1e-10);
    ASSERT_EQ(result.uncontrollable.size(), unreached);
    ASSERT_EQ(result.unobservable.size(), unseen);
    EXPECT_LT((result.uncontrollable - unreached_poles).norm(), 1e-8);
    EXPECT_LT((result.unobservable - unseen_poles).norm(), 1e-8);
    EXPECT_LT(result.largest_neglected, 1e-13);
    EXPECT_GT(result.smallest_kept, 1e-9);
  }
}

TEST(MinimalRealisation, CancelsAPoleAtTheOriginAgainstAZero) {
  const auto file = reference::case_of(reference::reference_values("step_info").at("cases"),
                                       "pc640_origin_cancellation")
                        .at("system");
  const auto result = minimal_realisation(reference::system_of(file), {.states = "rest"});
  // The numerator is s times a cubic that divides the denominator as well, to its last digit: by
  // polynomial division 1/(s^2/0.95 + 2 s + 1) remains.
  EXPECT_THAT(result.system.states, ElementsAre("rest_1", "rest_2"));
  for (const double w : {0.0, 0.5, 2.0, 30.0}) {
    const Complex s{0.0, w};
    EXPECT_LT(reference::relative_error(frequency_response(result.system, w)(0, 0),
                                        1.0 / (1.0 + s * (2.0 + s / 0.95))),
              1e-11);
  }
  ASSERT_EQ(result.unobservable.size(), 4);
  EXPECT_LT(std::abs(result.unobservable[0]), 1e-13);
  EXPECT_NEAR(result.unobservable[1].real(), -0.34254046, 1e-8);
  EXPECT_NEAR(result.unobservable[2].real(), -0.821, 1e-8);
  // With the zero at the origin alone, only that is removed.
  auto numerator = reference::ascending(file.at("num"));
  numerator.back() += 1e-3;
  const auto one =
      minimal_realisation(rational(numerator, reference::ascending(file.at("den")), "u", "y", "x"));
  EXPECT_EQ(one.system.a.rows(), 5);
  EXPECT_EQ(one.unobservable.size(), 1);
}

TEST(MinimalRealisation, DoesNotTakeAnAlmostCancelledPoleForACancelledOne) {
  const auto file = reference::case_of(reference::reference_values("step_info").at("cases"),
                                       "pc440_fast_plus_slow")
                        .at("system");
  EXPECT_EQ(minimal_realisation(reference::system_of(file)).system.a.rows(), 2);
  // (s + 1 + 1e-8)/((s + 1)(s + 2)): kept, unless told otherwise.
  const auto close = rational({1.0 + 1e-8, 1.0}, {2.0, 3.0, 1.0}, "u", "y", "x");
  EXPECT_EQ(minimal_realisation(close).system.a.rows(), 2);
  const auto rough = minimal_realisation(close, {.tolerance = 1e-6});
  EXPECT_EQ(rough.system.a.rows(), 1);
  EXPECT_GT(rough.largest_neglected, 1e-10);
}

TEST(MinimalRealisation, DoesNotCareForUnits) {
  reference::RandomNumbers random(63);
  for (int trial = 0; trial < 20; ++trial) {
    auto system = random_system(random, 5, 2, 2);
    system.a.block(4, 0, 1, 4).setZero();
    system.b.row(4).setZero();
    const auto plain = minimal_realisation(system);
    ASSERT_EQ(plain.system.a.rows(), 4);
    for (Eigen::Index i = 0; i < 5; ++i) {
      const double unit = random.log_uniform(1e-9, 1e9);
      system.a.row(i) *= unit;
      system.a.col(i) /= unit;
      system.b.row(i) *= unit;
      system.c.col(i) /= unit;
    }
    system.b.col(1) *= 1e12;
    system.c.row(0) *= 1e-12;
    EXPECT_EQ(minimal_realisation(system).system.a.rows(), 4) << trial;
  }
}

TEST(MinimalRealisation, OfNothingIsNothing) {
  const auto gain = static_gain(Eigen::MatrixXd::Ones(2, 1), {"u"}, {"y", "z"});
  EXPECT_EQ(minimal_realisation(gain).system.d, gain.d);
  auto deaf = rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  deaf.b.setZero();
  const auto empty = minimal_realisation(deaf);
  EXPECT_EQ(empty.system.a.rows(), 0);
  EXPECT_EQ(empty.system.c.rows(), 1);
  EXPECT_NEAR(empty.uncontrollable[0].real(), -1.0, 1e-15);
  for (const double bad : {-1e-3, 1.0, std::nan("")}) {
    EXPECT_THAT(reference::Call([&] { minimal_realisation(gain, {.tolerance = bad}); }),
                ThrowsMessage<InvalidInput>(HasSubstr("tolerance between 0 and 1")));
  }
}

}  // namespace
}  // namespace boresight::plant
