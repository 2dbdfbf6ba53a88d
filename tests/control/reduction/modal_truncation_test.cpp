#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/largest_difference.hpp"
#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/reduction/modal_truncation.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using reference::largest_difference;
using testing::HasSubstr;
using testing::ThrowsMessage;

plant::StateSpace random_system(reference::RandomNumbers& random, Index n, Index inputs,
                                Index outputs, bool sampled) {
  MatrixXd a = random.matrix(n, n);
  if (sampled) {
    a *= random.uniform(0.3, 0.97) / numerics::eigenvalues(a).cwiseAbs().maxCoeff();
  } else {
    a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.05, 1.0);
  }
  return reference::state_space(a, random.matrix(n, inputs), random.matrix(outputs, n),
                                random.matrix(outputs, inputs), sampled ? 0.1 : 0.0);
}

TEST(ModalTruncation, PeakOfAnOscillatorInClosedForm) {
  // w^2/(s^2 + 2 z w s + w^2) peaks at 1/(2 z sqrt(1 - z^2)), without its static gain elsewhere;
  // above z = 1/sqrt(2) at frequency 0.
  for (const double z : {1e-8, 1e-4, 0.01, 0.3, 0.6, 0.8, 0.95}) {
    const double w = 7.0;
    const auto system = plant::rational({w * w}, {w * w, 2.0 * z * w, 1.0}, "u", "y", "x");
    const auto modes = mode_contributions(system);
    ASSERT_EQ(modes.size(), 1U);
    EXPECT_EQ(modes[0].name, "mode_1");
    EXPECT_NEAR(modes[0].pole.real(), -z * w, 1e-14 * w);
    const double expected = z < std::sqrt(0.5) ? 1.0 / (2.0 * z * std::sqrt(1.0 - z * z)) : 1.0;
    EXPECT_NEAR(modes[0].peak_gain, expected, 1e-7 * expected) << z;
  }
  const auto lag = plant::rational({3.0}, {2.0, 1.0}, "u", "y", "x");
  EXPECT_NEAR(mode_contributions(lag)[0].peak_gain, 1.5, 1e-15);
  EXPECT_NEAR(mode_contributions(lag, true)[0].peak_gain, 1.5, 1e-15);
}

TEST(ModalTruncation, PeakGainsAreThoseOfTheModesAlone) {
  reference::RandomNumbers random(141);
  for (int trial = 0; trial < 24; ++trial) {
    const bool sampled = trial % 2 == 1;
    const bool keep_static_gain = trial % 4 >= 2;
    const auto system = random_system(random, random.integer(2, 6), 1, 1, sampled);
    const auto modes = mode_contributions(system, keep_static_gain);
    for (const auto& mode : modes) {
      const auto without =
          truncate_modes(system, {.dropped = {mode.name}, .keep_static_gain = keep_static_gain});
      EXPECT_EQ(without.dropped.size(), 1U);
      EXPECT_EQ(without.error_bound, mode.peak_gain);
      const double alone = largest_difference(system, without.system);
      EXPECT_LE(alone, mode.peak_gain * (1.0 + 1e-9));
      EXPECT_GE(alone, mode.peak_gain * (1.0 - 1e-9)) << trial;
    }
  }
}

TEST(ModalTruncation, ErrorIsWithinItsBound) {
  reference::RandomNumbers random(142);
  for (int trial = 0; trial < 12; ++trial) {
    const bool sampled = trial % 2 == 1;
    const auto system = random_system(random, random.integer(3, 8), 2, 3, sampled);
    const auto modes = mode_contributions(system);
    double all = 0.0;
    for (const auto& mode : modes) all += mode.peak_gain;
    for (const bool keep_static_gain : {false, true}) {
      const double bound = all * random.uniform(0.1, 0.6);
      const auto reduced =
          truncate_modes(system, {.error_bound = bound, .keep_static_gain = keep_static_gain});
      EXPECT_LE(reduced.error_bound, bound);
      EXPECT_LE(largest_difference(system, reduced.system), reduced.error_bound * (1.0 + 1e-9));
      if (keep_static_gain) {
        const MatrixXcd gain = plant::frequency_response(system, 0.0);
        EXPECT_LT((plant::frequency_response(reduced.system, 0.0) - gain).norm(),
                  1e-11 * (gain.norm() + all));
      } else {
        EXPECT_EQ(reduced.system.d, system.d);
      }
    }
  }
}

TEST(ModalTruncation, WithNothingDroppedIsTheSystemInModalStates) {
  reference::RandomNumbers random(143);
  const auto system = random_system(random, 7, 2, 2, false);
  const auto same = truncate_modes(system, {.error_bound = 0.0}).system;
  EXPECT_EQ(same.a.rows(), 7);
  EXPECT_LT(largest_difference(system, same), 1e-10);
  // Real, block-diagonal, with the poles on the diagonal.
  const auto modes = mode_contributions(system);
  Index at = 0;
  for (const auto& mode : modes) {
    EXPECT_EQ(same.a(at, at), mode.pole.real());
    if (mode.pole.imag() == 0.0) {
      EXPECT_EQ(same.states[static_cast<std::size_t>(at)], mode.name);
      ++at;
      continue;
    }
    EXPECT_EQ(same.states[static_cast<std::size_t>(at)], mode.name + ".1");
    EXPECT_EQ(same.states[static_cast<std::size_t>(at) + 1], mode.name + ".2");
    EXPECT_EQ(same.a(at + 1, at), mode.pole.imag());
    at += 2;
  }
  EXPECT_EQ(at, 7);
}

TEST(ModalTruncation, DropsTheHighModesOfThePeersAntenna) {
  const auto loop = reference::channel(reference::peer_closed_loop(20), "t", "y");
  const auto modes = mode_contributions(loop);
  // Every mode above 20 Hz, by name.
  ModalTruncationOptions options{.keep_static_gain = true};
  for (const auto& mode : modes) {
    const double hertz = std::abs(mode.pole) / (2.0 * std::numbers::pi);
    if (hertz > 20.0) options.dropped.push_back(mode.name);
  }
  const auto reduced = truncate_modes(loop, options);
  EXPECT_LT(reduced.system.a.rows(), loop.a.rows());
  EXPECT_LE(largest_difference(loop, reduced.system), reduced.error_bound);
  // The antenna's own gain peaks at 1.26 to 1.87 arcsec/(N m) (peers.json).
  EXPECT_LT(reduced.error_bound, 0.05);
}

TEST(ModalTruncation, KeepsIntegratorsAndRefusesToDropThem) {
  // 1/s + 1/(s + 1)
  const auto system = plant::rational({1.0, 2.0}, {0.0, 1.0, 1.0}, "u", "y", "x");
  const auto modes = mode_contributions(system);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes[0].peak_gain, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(modes[1].peak_gain, 1.0, 1e-14);
  const auto kept = truncate_modes(system, {.error_bound = 10.0}).system;
  ASSERT_EQ(kept.a.rows(), 1);
  EXPECT_EQ(kept.a(0, 0), 0.0);
  EXPECT_NEAR(kept.c(0, 0) * kept.b(0, 0), 1.0, 1e-14);
  EXPECT_THAT(reference::Call([&] { truncate_modes(system, {.dropped = {"mode_1"}}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found mode_1 at 0")));
}

TEST(ModalTruncation, RefusesWhatItCannotDo) {
  const auto lag = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(reference::Call([&] { truncate_modes(lag, {.dropped = {"mode_2"}}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'mode_2'")));
  EXPECT_THAT(reference::Call([&] { truncate_modes(lag, {}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("either modes to drop or an error bound")));
  EXPECT_THROW(truncate_modes(lag, {.dropped = {"mode_1"}, .error_bound = 0.1}), InvalidInput);
  EXPECT_THROW(truncate_modes(lag, {.error_bound = -0.1}), InvalidInput);
  // Two equal lags in a row have one eigenvector.
  const auto chain = plant::rational({1.0}, {1.0, 2.0, 1.0}, "u", "y", "x");
  EXPECT_THROW(mode_contributions(chain), NumericalFailure);
  const auto gain = plant::static_gain(MatrixXd::Ones(1, 1), {"u"}, {"y"});
  EXPECT_TRUE(mode_contributions(gain).empty());
  EXPECT_EQ(truncate_modes(gain, {.error_bound = 0.0}).system.d(0, 0), 1.0);
}

}  // namespace
}  // namespace boresight::control
