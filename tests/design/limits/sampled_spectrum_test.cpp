#include <cmath>
#include <complex>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/limits/lqg_search.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::design {
namespace {

struct Loop {
  Eigen::ArrayXd frequency = [] {
    const Eigen::ArrayXd grid = plant::frequency_grid(reference::antenna(), 1e-3, 24.9, 200);
    Eigen::ArrayXd with_slow(grid.size() + 60);
    with_slow
        << Eigen::ArrayXd::LinSpaced(60, std::log(1e-3 * grid[0]), std::log(0.95 * grid[0])).exp(),
        grid;
    return with_slow;
  }();
  SampledSetting setting = [this] {
    TrackingProblem problem = reference::tracking_problem();
    problem.noise.torque_rms = 0.5;
    return SampledSetting("own", problem.plant, fit_wind_filter(problem), problem.noise, 0.02,
                          frequency);
  }();
  plant::StateSpace controller = weighted_lqg(
      setting, {.command_weight = 0.01, .spring_weight = 1.0, .friction_torque = 20.0});
  Eigen::ArrayXXcd response = SampledSetting::controller_response(controller, frequency);
  SampledSpectrum spectrum = sampled_spectrum(setting, frequency);
};

// By sums over frequencies what Lyapunov equations give.
TEST(SampledSpectrum, AgreesWithTheCovarianceOfTheLoop) {
  const Loop loop;
  const SampledEvaluation expected = loop.setting.evaluate(loop.controller);
  ASSERT_LT(expected.spectral_radius, 1.0);
  const LoopFigures found = loop_figures(loop.spectrum, loop.response);
  EXPECT_NEAR(std::exp(found.boresight_rms.logarithm) / expected.boresight_rms, 1.0, 1e-5);
  EXPECT_NEAR(std::exp(found.control_effort.logarithm) / expected.control_effort, 1.0, 1e-5);
  const double peak = loop.setting.highest_peak(loop.response).magnitude;
  EXPECT_GE(std::exp(found.sensitivity_peak.logarithm), 0.999 * peak);
  EXPECT_LE(std::exp(found.sensitivity_peak.logarithm), 1.015 * peak);
}

TEST(SampledSpectrum, GradientsAreThoseOfTheFigures) {
  const Loop loop;
  const LoopFigures found = loop_figures(loop.spectrum, loop.response);
  // A smooth change of the controller, another in each sensor.
  Eigen::ArrayXXcd change = loop.response;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double slow = 0.3 * std::pow(5.0, static_cast<double>(i));
    for (Eigen::Index k = 0; k < change.rows(); ++k) {
      change(k, i) *= 1.0 / std::complex<double>(1.0, loop.frequency[k] / slow);
    }
  }
  constexpr double step = 1e-4;
  const LoopFigures above = loop_figures(loop.spectrum, loop.response + step * change);
  const LoopFigures below = loop_figures(loop.spectrum, loop.response - step * change);
  const auto held = [&](double by) {
    return locked_motor_gain(loop.spectrum, loop.response + by * change);
  };
  const auto expect_slope = [&](const LoopFigure& at, const LoopFigure& up,
                                const LoopFigure& down) {
    const double slope = 2.0 * (at.gradient * change).sum().real();
    EXPECT_NEAR((up.logarithm - down.logarithm) / (2.0 * step) / slope, 1.0, 1e-3);
  };
  expect_slope(found.boresight_rms, above.boresight_rms, below.boresight_rms);
  expect_slope(found.control_effort, above.control_effort, below.control_effort);
  expect_slope(found.sensitivity_peak, above.sensitivity_peak, below.sensitivity_peak);
  expect_slope(found.position_peak, above.position_peak, below.position_peak);
  expect_slope(held(0.0), held(step), held(-step));
  // From above, by less than 1 %: a sum of powers over all frequencies.
  const auto exact = [&](const SampledPeak& peak) { return std::log(peak.magnitude); };
  const SampledPeak position = loop.setting.highest_position_peak(loop.response);
  EXPECT_NEAR(found.position_peak.logarithm, exact(position), 0.01);
  EXPECT_NEAR(found.sensitivity_peak.logarithm, exact(loop.setting.highest_peak(loop.response)),
              0.01);
  EXPECT_NEAR(held(0.0).logarithm, exact(loop.setting.highest_locked_motor_gain(loop.response)),
              0.01);
}

// A controller that does not use the encoder above some frequency has a finite gradient there.
TEST(SampledSpectrum, LockedMotorGainIsOfTheEncoderAlone) {
  Loop loop;
  const Eigen::Index unused = loop.response.rows() / 2;
  loop.response.col(1).tail(unused).setZero();
  const LoopFigure found = locked_motor_gain(loop.spectrum, loop.response);
  EXPECT_TRUE(found.gradient.isFinite().all());
  // It is proportional to the encoder's response.
  EXPECT_NEAR(2.0 * (found.gradient.col(1) * loop.response.col(1)).sum().real(), 1.0, 1e-9);
  loop.response.col(1) *= 3.0;
  EXPECT_NEAR(locked_motor_gain(loop.spectrum, loop.response).logarithm,
              found.logarithm + std::log(3.0), 1e-12);
}

// Without a response of the plant the effort is a square of the controller: gradient and curvature
// are all there is.
TEST(SampledSpectrum, EffortIsItsGradientAndCurvatureWhereNothingComesBack) {
  Loop loop;
  loop.spectrum.response.setZero();
  const Eigen::ArrayXXcd change = 0.3 * loop.response.conjugate() + 0.1 * loop.response;
  const LoopFigure before = loop_figures(loop.spectrum, loop.response).control_effort;
  const LoopFigure after = loop_figures(loop.spectrum, loop.response + change).control_effort;
  const double curved = (effort_curvature(loop.spectrum, loop.response) * change.abs2()).sum();
  const double slope = 4.0 * (before.gradient * change).sum().real();
  EXPECT_NEAR(std::exp(2.0 * (after.logarithm - before.logarithm)), 1.0 + slope + curved, 1e-12);
  EXPECT_GT(curved, 0.01);
}

// Without feedback through the plant the mean square is exactly quadratic in the controller.
TEST(SampledSpectrum, CurvatureIsThatOfTheMeanSquare) {
  Loop loop;
  loop.spectrum.response.setZero();
  const auto mean_square = [&](const Eigen::ArrayXXcd& controller) {
    return std::exp(2.0 * loop_figures(loop.spectrum, controller).boresight_rms.logarithm);
  };
  const double here = mean_square(loop.response);
  const Eigen::ArrayXXcd change = 0.1 * loop.response;
  const double second =
      0.5 * (mean_square(loop.response + change) + mean_square(loop.response - change)) - here;
  const Eigen::ArrayXXcd curvature = boresight_curvature(loop.spectrum, loop.response);
  std::complex<double> expected = 0.0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      expected += (change.col(i).conjugate() * curvature.col(3 * i + j) * change.col(j)).sum();
    }
  }
  EXPECT_NEAR(second / here / expected.real(), 1.0, 1e-6);
  EXPECT_NEAR(expected.imag() / expected.real(), 0.0, 1e-12);
}

// In the closed loop the sensors' density is (I + P S K) Phi (I + P S K)^H, and a change dK of the
// controller moves the command by S dK times what they see.
TEST(SampledSpectrum, CurvatureIsOfWhatTheSensorsSeeInTheLoop) {
  const Loop loop;
  const Eigen::ArrayXXcd curvature = boresight_curvature(loop.spectrum, loop.response);
  const double mean_square =
      std::exp(2.0 * loop_figures(loop.spectrum, loop.response).boresight_rms.logarithm);
  std::complex<double> found = 0.0;
  double expected = 0.0;
  for (Eigen::Index k = 0; k < loop.frequency.size(); ++k) {
    const Eigen::Vector3cd plant = loop.spectrum.response.row(k).matrix().transpose();
    const Eigen::RowVector3cd controller = loop.response.row(k).matrix();
    // Another phase in each sensor, which a transposed or conjugated form would confuse.
    Eigen::RowVector3cd change = controller;
    for (Eigen::Index i = 0; i < 3; ++i) change[i] *= std::polar(1.0, 0.7 * static_cast<double>(i));
    Eigen::Matrix3cd density;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        density(i, j) = loop.spectrum.sensors(k, 3 * i + j);
        found += std::conj(change[i]) * curvature(k, 3 * i + j) * change[j];
      }
    }
    const std::complex<double> sensitivity = 1.0 / (1.0 - (controller * plant).value());
    const Eigen::Matrix3cd closed = (Eigen::Matrix3cd::Identity() - plant * controller).inverse();
    const Eigen::RowVector3cd seen = change * closed;
    expected += loop.spectrum.weights[k] * loop.spectrum.by_command[k] * std::norm(sensitivity) *
                (seen * density * seen.adjoint()).value().real() / mean_square;
  }
  EXPECT_NEAR(found.real() / expected, 1.0, 1e-9);
}

}  // namespace
}  // namespace boresight::design
