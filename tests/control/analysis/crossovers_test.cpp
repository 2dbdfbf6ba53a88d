#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/loop_response.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/transfer_function.hpp>

namespace boresight::control {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_same(const Crossovers& found, const Margins& expected, double tolerance) {
  ASSERT_EQ(found.gain.size(), expected.gain_crossovers.size());
  for (std::size_t i = 0; i < found.gain.size(); ++i) {
    EXPECT_NEAR(found.gain[i].frequency / expected.gain_crossovers[i].frequency, 1.0, tolerance);
    EXPECT_NEAR(found.gain[i].phase_margin_deg, expected.gain_crossovers[i].phase_margin_deg,
                180.0 * tolerance);
  }
  ASSERT_EQ(found.phase.size(), expected.phase_crossovers.size());
  for (std::size_t i = 0; i < found.phase.size(); ++i) {
    EXPECT_NEAR(found.phase[i].gain_margin / expected.phase_crossovers[i].gain_margin, 1.0,
                tolerance);
  }
}

TEST(Crossovers, AreTheTextbooks) {
  // k/(s (s+1)(s+2)) crosses the axis at sqrt 2 with gain k/6.
  const Crossovers found = crossovers(plant::rational({1.5}, {0.0, 2.0, 3.0, 1.0}, "u", "y", "x"));
  ASSERT_EQ(found.phase.size(), 1u);
  EXPECT_NEAR(found.phase[0].frequency, std::numbers::sqrt2, 1e-14);
  EXPECT_NEAR(found.phase[0].gain_margin, 4.0, 1e-13);
  ASSERT_EQ(found.gain.size(), 1u);
  const double w = found.gain[0].frequency;
  EXPECT_NEAR(w * std::hypot(1.0, w) * std::hypot(2.0, w), 1.5, 1e-14);
}

TEST(Crossovers, WhereTheFeedthroughIsOne) {
  // (s + 2)/(s + 1) e^..: |L| falls from 2 towards 1 and never crosses; 1 - L(s) L(-s) has no
  // feedthrough then.
  EXPECT_TRUE(crossovers(plant::rational({2.0, 1.0}, {1.0, 1.0}, "u", "y", "x")).gain.empty());
  // (s^2 + 2)/(s^2 + s + 1): 1 again at infinity, and where (2 - x)^2 = (1 - x)^2 + x.
  const auto found = crossovers(plant::rational({2.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, "u", "y", "x"));
  ASSERT_EQ(found.gain.size(), 1u);
  EXPECT_NEAR(found.gain[0].frequency, 1.0, 1e-14);
}

TEST(Crossovers, OfALoopWithAPoleAtTheNyquistFrequency) {
  // A pole at z = -1, which the bilinear map sends to infinity, one at z = 1, and both.
  for (const auto& poles : {std::vector<std::complex<double>>{-1.0, 0.5},
                            std::vector<std::complex<double>>{-1.0, 1.0, 0.2}}) {
    const auto loop = plant::zeros_poles_gain({0.3}, poles, 0.4, "u", "y", "x", 0.1);
    const Margins scan = margins(loop);
    EXPECT_FALSE(scan.gain_crossovers.empty());
    expect_same(crossovers(loop), scan, 1e-10);
  }
}

TEST(Crossovers, OfADeadbeatLoop) {
  // z^-3 k/(z - 1): A has three eigenvalues of 0, and L(1/z) no proper state space.
  plant::StateSpace loop = plant::rational({0.2}, {0.0, 0.0, 0.0, -1.0, 1.0}, "u", "y", "x");
  loop.sample_time = 0.5;
  const Crossovers found = crossovers(loop);
  // 2 sin(w T/2) = k; the angle of -L there is 90 deg - w T/2 - 3 w T.
  const double w = 2.0 / 0.5 * std::asin(0.1);
  ASSERT_EQ(found.gain.size(), 1u);
  EXPECT_NEAR(found.gain[0].frequency, w, 1e-14);
  EXPECT_NEAR(found.gain[0].phase_margin_deg, 90.0 - 3.5 * 0.5 * w * 180.0 / std::numbers::pi,
              1e-12);
  // On the axis at 3.5 w T = 90 deg, 450 deg, and z = -1 is at 3.5 pi: L = -k/2 (-1)^3.
  ASSERT_EQ(found.phase.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) {
    const double turn = (0.5 + 2.0 * static_cast<double>(n)) * std::numbers::pi / 3.5;
    EXPECT_NEAR(found.phase[n].frequency, turn / 0.5, 1e-13);
    EXPECT_NEAR(found.phase[n].gain_margin, 2.0 * std::sin(0.5 * turn) / 0.2, 1e-12);
  }
  expect_same(found, margins(loop), 1e-12);
}

TEST(Crossovers, ManyDecadesApartAreAllThere) {
  // Gain falls through 1 three times: at about 1e-4, 1 and 1e5 rad/s.
  const auto loop = plant::zeros_poles_gain(
      {-1e-2, -2e-2, -1e2, -2e2}, {0.0, -1e-5, -0.3, -0.4, -3e4, -4e4}, 3e5, "u", "y", "x");
  const Margins scan = margins(loop);
  EXPECT_GE(scan.gain_crossovers.size(), 1u);
  expect_same(crossovers(loop), scan, 1e-9);
}

TEST(Crossovers, OfTheAntennaFamilyAreThoseOfTheScan) {
  for (const int modes : {1, 5, 20}) {
    const auto loop = reference::peer_open_loop(modes);
    const Margins scan = margins(loop);
    EXPECT_GE(scan.gain_crossovers.size() + scan.phase_crossovers.size(), 4u);
    expect_same(crossovers(loop), scan, 1e-9);
  }
}

TEST(Crossovers, OfTheAntennaFamilyAreThoseOfOthers) {
  const auto peers = reference::peer_values().at("mar");
  for (const int modes : {5, 50}) {
    const auto name = std::to_string(modes);
    if (!peers.contains(name)) continue;
    const auto& value = peers.at(name).at("val");
    const Margins found = margins(reference::peer_open_loop(modes));
    EXPECT_LT(reference::relative_error(found.increasing_gain_margin, value.at(0)), 1e-8);
    EXPECT_LT(reference::relative_error(found.decreasing_gain_margin, value.at(2)), 1e-8);
    EXPECT_NEAR(found.phase_margin_deg, value.at(4).get<double>(), 1e-7);
    EXPECT_EQ(found.phase_crossovers.size(), value.at(6).get<std::size_t>());
    EXPECT_EQ(found.gain_crossovers.size(), value.at(7).get<std::size_t>());
  }
}

TEST(Crossovers, RefuseAHiddenStateAtTheNyquistFrequency) {
  plant::StateSpace loop =
      reference::state_space(Eigen::Vector2d(-1.0, 0.5).asDiagonal(), Eigen::Vector2d(0.0, 1.0),
                             Eigen::RowVector2d(1.0, 1.0), Eigen::MatrixXd::Zero(1, 1), 0.1);
  try {
    crossovers(loop);
    FAIL() << "no error";
  } catch (const NumericalFailure& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("A has an eigenvalue of -1"));
  }
}

TEST(LoopResponse, KnowsItsEnds) {
  LoopResponse lag("test", plant::rational({3.0, 0.5}, {2.0, 1.0}, "u", "y", "x"));
  EXPECT_NEAR(lag.at_zero().real(), 1.5, 1e-15);
  EXPECT_EQ(lag.at_highest(), 0.5);
  EXPECT_EQ(lag.nyquist_frequency(), infinity);
  LoopResponse integrator("test", plant::rational({3.0}, {0.0, 0.0, 2.0, 1.0}, "u", "y", "x"));
  EXPECT_EQ(integrator.at_zero().real(), infinity);
  plant::StateSpace sampled = plant::rational({1.0}, {0.5, 1.5, 1.0}, "u", "y", "x");
  sampled.sample_time = 0.25;  // poles -1 and -1/2
  LoopResponse alternating("test", sampled);
  EXPECT_EQ(alternating.at_highest().real(), infinity);
  EXPECT_NEAR(alternating.at_zero().real(), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(alternating.nyquist_frequency(), 4.0 * std::numbers::pi, 1e-14);
}

TEST(LoopResponse, SaysWhereItIsLostInRounding) {
  // Two integrators in states that hide them, beside a pole at -1: below some 1e-7 rad/s nothing of
  // the angle is left.
  plant::StateSpace loop = plant::rational({1.0, 0.3}, {0.0, 0.0, 1.0, 1.0}, "u", "y", "x");
  const Eigen::Vector3d u(1.0, 2.0, -1.0), v(1.0, 1.0, 3.0);  // at right angles
  const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity() + u * v.transpose();
  const Eigen::Matrix3d back = Eigen::Matrix3d::Identity() - u * v.transpose();
  loop.a = (turn * loop.a * back).eval();
  loop.b = (turn * loop.b).eval();
  loop.c = (loop.c * back).eval();
  LoopResponse response("test", loop);
  const Eigen::ArrayXd frequency =
      Eigen::ArrayXd::LinSpaced(60, std::log(1e-10), std::log(10.0)).exp();
  const LoopOnGrid found = response.on_grid(frequency);
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const std::complex<double> s{0.0, frequency[i]};
    const std::complex<double> exact = (1.0 + 0.3 * s) / (s * s * (s + 1.0));
    const double error = reference::relative_error(found.value[i], exact);
    EXPECT_LT(std::min(error, 0.1), 100.0 * found.uncertainty[i]) << frequency[i];
    if (frequency[i] < 1e-9) {
      EXPECT_GT(found.uncertainty[i], 0.1);
    } else if (frequency[i] > 0.1) {
      EXPECT_LT(found.uncertainty[i], 1e-11);
    }
  }
  EXPECT_TRUE(crossovers(loop).phase.empty());
  EXPECT_TRUE(margins(loop).phase_crossovers.empty());
}

}  // namespace
}  // namespace boresight::control
