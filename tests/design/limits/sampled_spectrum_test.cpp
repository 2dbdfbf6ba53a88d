#include <cmath>
#include <complex>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "design/limits/spectrum_of_loop.hpp"

namespace boresight::design {
namespace {

using reference::Loop;
using reference::slope_along;

// Without a response of the plant the effort is a square of the controller: gradient and curvature
// are all there is.
TEST(SampledSpectrum, EffortIsItsGradientAndCurvatureWhereNothingComesBack) {
  Loop loop;
  loop.spectrum.response.setZero();
  const Eigen::ArrayXXcd change = 0.3 * loop.response.conjugate() + 0.1 * loop.response;
  const RmsFigure before = loop.figures(loop.response).control_effort;
  const RmsFigure after = loop.figures(loop.response + change).control_effort;
  const double curved = (effort_curvature(loop.spectrum, loop.response) * change.abs2()).sum();
  const double slope = 2.0 * slope_along(before, change);
  EXPECT_NEAR(std::exp(2.0 * (after.logarithm - before.logarithm)), 1.0 + slope + curved, 1e-12);
  EXPECT_GT(curved, 0.01);
}

// Without feedback through the plant the mean square is exactly quadratic in the controller.
TEST(SampledSpectrum, CurvatureIsThatOfTheMeanSquare) {
  Loop loop;
  loop.spectrum.response.setZero();
  const auto mean_square = [&](const Eigen::ArrayXXcd& controller) {
    return std::exp(2.0 * loop.figures(controller).boresight_rms.logarithm);
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
  const double mean_square = std::exp(2.0 * loop.figures(loop.response).boresight_rms.logarithm);
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
