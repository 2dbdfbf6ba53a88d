#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_modal_family.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/modal_margins.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

plant::ModalResponse peer_loop(Eigen::Index modes) {
  return {reference::peer_modal_open_loop(modes), "d", "loop_gain"};
}

TEST(ModalMargins, OfThePeersAntennaAreTheirs) {
  // tests/data/reference/peers.json: gain margin up and down, phase margin, numbers of crossovers.
  struct Expected {
    Eigen::Index modes;
    double up, down, phase;
    std::size_t phase_crossovers;
  };
  for (const auto& expected :
       {Expected{5, 3.158729073606981, 0.07519235758124754, 82.34952170553026, 6},
        Expected{50, 3.194601514258608, 0.07519211300968748, 82.41588151128985, 30},
        Expected{500, 3.196799020827198, 0.07519209781028388, 82.41996415428912, 20}}) {
    const Margins found = margins(peer_loop(expected.modes));
    EXPECT_NEAR(found.increasing_gain_margin / expected.up, 1.0, 1e-12);
    EXPECT_NEAR(found.decreasing_gain_margin / expected.down, 1.0, 1e-12);
    EXPECT_NEAR(found.phase_margin_deg / expected.phase, 1.0, 1e-12);
    EXPECT_EQ(found.phase_crossovers.size(), expected.phase_crossovers);
    EXPECT_EQ(found.gain_crossovers.size(), 1U);
  }
}

TEST(ModalMargins, AreThoseOfTheDenseLoop) {
  for (const Eigen::Index modes : {2, 5, 12}) {
    const Margins found = margins(peer_loop(modes));
    const Margins dense = margins(reference::peer_open_loop(modes));
    ASSERT_EQ(found.phase_crossovers.size(), dense.phase_crossovers.size());
    for (std::size_t i = 0; i < dense.phase_crossovers.size(); ++i) {
      EXPECT_NEAR(found.phase_crossovers[i].frequency / dense.phase_crossovers[i].frequency, 1.0,
                  1e-9);
      EXPECT_NEAR(found.phase_crossovers[i].gain_margin / dense.phase_crossovers[i].gain_margin,
                  1.0, 1e-8);
    }
    EXPECT_NEAR(found.delay_margin / dense.delay_margin, 1.0, 1e-9);
    EXPECT_NEAR(found.sensitivity.magnitude / dense.sensitivity.magnitude, 1.0, 1e-9);
    EXPECT_NEAR(found.disk.alpha / dense.disk.alpha, 1.0, 1e-9);
    // The certified peak of the closed loop is the same.
    const PeakGain bracket = peak_gain(reference::peer_modal_system(modes), "d", "u");
    EXPECT_NEAR(found.sensitivity.magnitude / bracket.lower, 1.0, 1e-9);
    EXPECT_LE(found.sensitivity.magnitude, bracket.upper);
  }
}

TEST(ModalMargins, WithDeadTimeAreTheTextbooks) {
  // k e^(-s d)/s: phase margin 90 deg - k d, phase crossovers at (pi/2 + 2 pi n)/d.
  const double k = 2.0, delay = 0.3;
  plant::ModalSystem system;
  system.core = plant::static_gain(Eigen::MatrixXd::Zero(2, 2), {"in", "late"}, {"out", "early"});
  system.core.a = Eigen::MatrixXd::Zero(1, 1);
  system.core.b = Eigen::RowVector2d(k, 0.0);
  system.core.c = Eigen::Vector2d(0.0, 1.0);
  system.core.d(0, 1) = 1.0;
  system.core.states = {"x"};
  system.modes.force_shape.resize(0, 0);
  system.modes.displacement_shape.resize(0, 0);
  system.dead_times = {{"early", "late", delay}};
  system.inputs = {"in"};
  system.outputs = {"out"};
  ModalMarginOptions options;
  options.lowest = 0.01;
  options.highest = 100.0;
  const Margins found = margins({system, "in", "out"}, options);
  const double degrees = 180.0 / std::numbers::pi;
  EXPECT_NEAR(found.phase_margin_deg, 90.0 - k * delay * degrees, 1e-9);
  EXPECT_NEAR(found.delay_margin, 0.5 * std::numbers::pi / k - delay, 1e-11);
  EXPECT_NEAR(found.increasing_gain_margin, std::numbers::pi / (2.0 * k * delay), 1e-9);
  ASSERT_EQ(found.phase_crossovers.size(), 5U);
  for (std::size_t n = 0; n < 5; ++n) {
    EXPECT_NEAR(found.phase_crossovers[n].frequency,
                (0.5 + 2.0 * static_cast<double>(n)) * std::numbers::pi / delay, 1e-8);
  }
}

TEST(ModalMargins, FindBothCrossoversBesideALightZeroThatNoPoleTellsOf) {
  // An antiresonance of damping 1e-5 between two modes turns L by half a turn and back.
  plant::ModalSystem system;
  system.core = plant::static_gain(Eigen::MatrixXd::Zero(2, 2), {"in", "q"}, {"out", "f"});
  system.core.d << 0.0, 1.0, 1.0, 0.0;
  system.modes = {Eigen::Vector2d(1.0, 3.0),
                  Eigen::Vector2d(1e-5, 1e-5),
                  Eigen::MatrixXd::Ones(2, 1),
                  Eigen::MatrixXd::Ones(1, 2),
                  {"f"},
                  {"q"},
                  {""}};
  system.inputs = {"in"};
  system.outputs = {"out"};
  const Margins found = margins({system, "in", "out"});
  // |1/(1 - w^2) + 1/(9 - w^2)| = 1 but for the damping: (10 - 2 x) = +-(1 - x)(9 - x), x = w^2.
  std::vector<double> expected;
  for (const double side : {1.0, -1.0}) {
    // side (x^2 - 10 x + 9) + 2 x - 10 = 0
    const double b = -10.0 * side + 2.0, c = 9.0 * side - 10.0;
    const double root = std::sqrt(b * b - 4.0 * side * c);
    for (const double x : {(-b + root) / (2.0 * side), (-b - root) / (2.0 * side)}) {
      if (x > 0.0) expected.push_back(std::sqrt(x));
    }
  }
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(found.gain_crossovers.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found.gain_crossovers[i].frequency, expected[i], 1e-7);
  }
}

TEST(ModalMargins, RefuseWhatTheyCannotFollow) {
  ModalMarginOptions options;
  options.largest_turn = 3.0;
  EXPECT_THAT(reference::Call([&] { margins(peer_loop(3), options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("0.01 to 1 rad, found 3")));
  options.largest_turn = 0.02;
  options.max_points = 300;
  EXPECT_THAT(reference::Call([&] { margins(peer_loop(3), options); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("more than 300 frequencies")));
}

}  // namespace
}  // namespace boresight::control
