#include <algorithm>
#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/largest_difference.hpp"
#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/reduction/balanced_truncation.hpp>
#include <boresight/control/reduction/gramians.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using reference::largest_difference;
using testing::HasSubstr;
using testing::ThrowsMessage;

plant::StateSpace random_system(reference::RandomNumbers& random, Index n, bool sampled) {
  MatrixXd a = random.matrix(n, n);
  if (sampled) {
    a *= random.uniform(0.3, 0.97) / numerics::eigenvalues(a).cwiseAbs().maxCoeff();
  } else {
    a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.05, 1.0);
  }
  return reference::state_space(a, random.matrix(n, 2), random.matrix(2, n), random.matrix(2, 2),
                                sampled ? 0.1 : 0.0);
}

plant::StateSpace slicot_example() {
  reference::SlicotData data("AB09AD.dat");
  const MatrixXd a = data.next_matrix(7, 7);
  const MatrixXd b = data.next_matrix(7, 2);
  const MatrixXd c = data.next_matrix(3, 7);
  return reference::state_space(a, b, c, MatrixXd::Zero(3, 2));
}

TEST(BalancedTruncation, OfSlicotsExampleHasItsValuesAndItsResponse) {
  const auto system = slicot_example();
  const auto reduced = truncate_balanced(system, {.singular_value_above = 0.1});
  const auto printed = reference::slicot_result("AB09AD.res", "Hankel singular values HSV are")[0];
  ASSERT_EQ(reduced.hankel_singular_values.size(), 7);
  for (Index i = 0; i < 7; ++i) {
    const auto& number = printed[static_cast<std::size_t>(i)];
    EXPECT_NEAR(reduced.hankel_singular_values[i], number.value, number.half_unit);
  }
  const auto order = reference::slicot_result("AB09AD.res", "order of reduced model =")[0][0];
  ASSERT_EQ(reduced.system.a.rows(), static_cast<Index>(order.value));

  // The printed system is in other coordinates: compare responses, to what half a unit of each
  // printed digit makes of them.
  const auto matrix_of = [](const char* heading) {
    const auto rows = reference::slicot_result("AB09AD.res", heading);
    MatrixXd matrix(static_cast<Index>(rows.size()), static_cast<Index>(rows[0].size()));
    for (Index i = 0; i < matrix.rows(); ++i) {
      for (Index j = 0; j < matrix.cols(); ++j) {
        matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].value;
      }
    }
    return matrix;
  };
  const MatrixXd a = matrix_of("reduced state dynamics matrix Ar is");
  const MatrixXd b = matrix_of("reduced input/state matrix Br is");
  const MatrixXd c = matrix_of("reduced state/output matrix Cr is");
  const auto slicot = reference::state_space(a, b, c, MatrixXd::Zero(3, 2));
  const double half_unit = 0.5e-4;
  for (const double w : {0.0, 0.1, 0.5, 1.0, 2.0, 3.0, 10.0}) {
    const MatrixXcd from_states = plant::frequency_response(
        reference::state_space(a, MatrixXd::Identity(5, 5), c, MatrixXd::Zero(3, 5)), w);
    const MatrixXcd to_states = plant::frequency_response(
        reference::state_space(a, b, MatrixXd::Identity(5, 5), MatrixXd::Zero(5, 2)), w);
    const MatrixXd rounding =
        half_unit * (MatrixXd::Ones(3, 5) * to_states.cwiseAbs() +
                     from_states.cwiseAbs() * MatrixXd::Ones(5, 5) * to_states.cwiseAbs() +
                     from_states.cwiseAbs() * MatrixXd::Ones(5, 2));
    const MatrixXcd ours = plant::frequency_response(reduced.system, w);
    const MatrixXcd theirs = plant::frequency_response(slicot, w);
    for (Index i = 0; i < 3; ++i) {
      for (Index j = 0; j < 2; ++j) {
        EXPECT_LT(std::abs(ours(i, j) - theirs(i, j)), rounding(i, j)) << w;
      }
    }
  }
}

TEST(BalancedTruncation, ErrorIsWithinItsBoundAndNotBelowTheFirstNeglectedValue) {
  reference::RandomNumbers random(131);
  for (int trial = 0; trial < 16; ++trial) {
    const bool sampled = trial % 2 == 1;
    const auto system = random_system(random, random.integer(2, 8), sampled);
    for (const bool keep_static_gain : {false, true}) {
      const Index order = random.integer(0, static_cast<int>(system.a.rows()) - 1);
      const auto reduced =
          truncate_balanced(system, {.order = order, .keep_static_gain = keep_static_gain});
      ASSERT_EQ(reduced.system.a.rows(), order);
      const double error = largest_difference(system, reduced.system);
      EXPECT_LE(error, reduced.error_bound * (1.0 + 1e-9));
      // No system of that order is nearer than the first neglected value.
      EXPECT_GE(error, reduced.hankel_singular_values[order] * (1.0 - 1e-9));
    }
  }
}

TEST(BalancedTruncation, IsBalanced) {
  reference::RandomNumbers random(132);
  for (const bool sampled : {false, true}) {
    const auto system = random_system(random, 6, sampled);
    const auto whole = truncate_balanced(system, {.order = 6});
    const MatrixXd sigma = whole.hankel_singular_values.asDiagonal();
    EXPECT_LT((controllability_gramian(whole.system) - sigma).norm(), 1e-11 * sigma.norm());
    EXPECT_LT((observability_gramian(whole.system) - sigma).norm(), 1e-11 * sigma.norm());
    EXPECT_LT(largest_difference(system, whole.system), 1e-10);
    EXPECT_LT(whole.error_bound, 1e-300);
    EXPECT_EQ(whole.system.states[0], "balanced_1");
    EXPECT_EQ(whole.system.inputs, system.inputs);
    EXPECT_EQ(whole.system.sample_time, system.sample_time);
    // Cut from the balanced system itself: the same again.
    const auto once = truncate_balanced(system, {.order = 3});
    const auto twice = truncate_balanced(whole.system, {.order = 3});
    EXPECT_LT(largest_difference(once.system, twice.system), 1e-10);
  }
}

TEST(BalancedTruncation, KeepsTheStaticGainOrTheDirectOne) {
  reference::RandomNumbers random(133);
  for (const bool sampled : {false, true}) {
    const auto system = random_system(random, 7, sampled);
    const MatrixXcd gain = plant::frequency_response(system, 0.0);
    const auto settled = truncate_balanced(system, {.order = 3, .keep_static_gain = true}).system;
    EXPECT_LT((plant::frequency_response(settled, 0.0) - gain).norm(), 1e-12 * gain.norm());
    const auto dropped = truncate_balanced(system, {.order = 3}).system;
    EXPECT_EQ((dropped.d - system.d).norm(), 0.0);
    EXPECT_GT((plant::frequency_response(dropped, 0.0) - gain).norm(), 1e-6 * gain.norm());
  }
}

TEST(BalancedTruncation, ChoosesTheOrderByLimitOrBound) {
  const auto system = slicot_example();
  const Eigen::VectorXd sigma = hankel_singular_values(system);
  EXPECT_EQ(truncate_balanced(system, {.singular_value_above = 2.0}).system.a.rows(), 2);
  EXPECT_EQ(truncate_balanced(system, {.singular_value_above = 0.0}).system.a.rows(), 7);
  EXPECT_EQ(truncate_balanced(system, {.error_bound = 0.0}).system.a.rows(), 7);
  const double two = 2.0 * (sigma[5] + sigma[6]);
  const auto bounded = truncate_balanced(system, {.error_bound = two * 1.001});
  EXPECT_EQ(bounded.system.a.rows(), 5);
  EXPECT_NEAR(bounded.error_bound, two, 1e-14);
  EXPECT_EQ(truncate_balanced(system, {.error_bound = two * 0.999}).system.a.rows(), 6);
  EXPECT_EQ(truncate_balanced(system, {.error_bound = 1e3}).system.a.rows(), 0);
}

TEST(BalancedTruncation, StandsSystemsThatAreNotMinimal) {
  // A system beside a copy of itself seen with the opposite sign, and states that nothing reaches:
  // the square-root method must not divide by their Hankel singular values.
  reference::RandomNumbers random(134);
  auto system = random_system(random, 4, false);
  const Index n = 4;
  MatrixXd a = MatrixXd::Zero(3 * n, 3 * n), b = MatrixXd::Zero(3 * n, 2), c(2, 3 * n);
  for (Index k = 0; k < 3; ++k) a.block(k * n, k * n, n, n) = system.a;
  b.topRows(n) = system.b;
  b.middleRows(n, n) = 1e-7 * system.b;
  c << system.c, system.c, 5.0 * system.c;
  const auto large = reference::state_space(a, b, c, system.d);
  const auto reduced = truncate_balanced(large, {.order = 12});
  EXPECT_EQ(reduced.system.a.rows(), 4);
  EXPECT_LT(reduced.error_bound, 1e-13 * reduced.hankel_singular_values[0]);
  auto expected = system;
  expected.b *= 1.0 + 1e-7;
  const auto nothing = plant::static_gain(MatrixXd::Zero(2, 2), expected.inputs, expected.outputs);
  EXPECT_LT(largest_difference(reduced.system, expected),
            1e-11 * largest_difference(expected, nothing));
}

TEST(BalancedTruncation, ReducesThePeersAntenna) {
  const auto loop = reference::channel(reference::peer_closed_loop(20), "t", "y");
  const auto reduced = truncate_balanced(loop, {.error_bound = 1e-3});
  EXPECT_LT(reduced.system.a.rows(), 45);
  EXPECT_GT(reduced.system.a.rows(), 10);
  EXPECT_LE(largest_difference(loop, reduced.system), reduced.error_bound);
  EXPECT_LE(reduced.error_bound, 1e-3);
}

TEST(BalancedTruncation, RefusesWhatItCannotDo) {
  const auto lag = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(reference::Call([&] { truncate_balanced(lag, {}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected one of order")));
  EXPECT_THAT(reference::Call([&] { truncate_balanced(lag, {.order = 1, .error_bound = 0.1}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2")));
  EXPECT_THAT(reference::Call([&] { truncate_balanced(lag, {.order = 2}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("to that of the system, 1, found 2")));
  EXPECT_THROW(truncate_balanced(lag, {.order = -1}), InvalidInput);
  EXPECT_THROW(truncate_balanced(lag, {.error_bound = -1.0}), InvalidInput);
  EXPECT_THROW(truncate_balanced(lag, {.singular_value_above = std::nan("")}), InvalidInput);
  const auto integrator = plant::rational({1.0}, {0.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(reference::Call([&] { truncate_balanced(integrator, {.order = 1}); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("remove integrators")));
  const auto gain = plant::static_gain(MatrixXd::Ones(1, 1), {"u"}, {"y"});
  EXPECT_EQ(truncate_balanced(gain, {.order = 0}).system.d(0, 0), 1.0);
}

}  // namespace
}  // namespace boresight::control
