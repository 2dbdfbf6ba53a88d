#include <cmath>
#include <complex>
#include <limits>

#include <gtest/gtest.h>

#include "design/limits/spectrum_of_loop.hpp"
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::design {
namespace {

using reference::Loop;
using reference::slope_along;

// By sums over frequencies what Lyapunov equations give.
TEST(LoopFigures, AgreesWithTheCovarianceOfTheLoop) {
  const Loop loop;
  const SampledEvaluation expected = loop.setting.evaluate(loop.controller);
  ASSERT_LT(expected.spectral_radius, 1.0);
  const LoopFigures found = loop.figures(loop.response);
  EXPECT_NEAR(std::exp(found.boresight_rms.logarithm) / expected.boresight_rms, 1.0, 1e-5);
  EXPECT_NEAR(std::exp(found.control_effort.logarithm) / expected.control_effort, 1.0, 1e-5);
  const double peak = loop.setting.highest_peak(loop.response).magnitude;
  EXPECT_GE(std::exp(found.peaks.sensitivity_peak.logarithm), 0.999 * peak);
  EXPECT_LE(std::exp(found.peaks.sensitivity_peak.logarithm), 1.015 * peak);
}

TEST(LoopFigures, GradientsAreThoseOfTheFigures) {
  const Loop loop;
  const LoopFigures found = loop.figures(loop.response);
  // A smooth change of the controller, another in each sensor.
  Eigen::ArrayXXcd change = loop.response;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double slow = 0.3 * std::pow(5.0, static_cast<double>(i));
    for (Eigen::Index k = 0; k < change.rows(); ++k) {
      change(k, i) *= 1.0 / std::complex<double>(1.0, loop.frequency[k] / slow);
    }
  }
  constexpr double step = 1e-4;
  const LoopFigures above = loop.figures(loop.response + step * change);
  const LoopFigures below = loop.figures(loop.response - step * change);
  const auto locked = [&](double by) {
    return loop.locked_motor_gain(loop.response + by * change);
  };
  const auto expect_slope = [&](const auto& at, const auto& up, const auto& down) {
    const double slope = slope_along(at, change);
    EXPECT_NEAR((up.logarithm - down.logarithm) / (2.0 * step) / slope, 1.0, 1e-3);
  };
  expect_slope(found.boresight_rms, above.boresight_rms, below.boresight_rms);
  expect_slope(found.control_effort, above.control_effort, below.control_effort);
  expect_slope(found.peaks.sensitivity_peak, above.peaks.sensitivity_peak,
               below.peaks.sensitivity_peak);
  expect_slope(found.peaks.position_peak, above.peaks.position_peak, below.peaks.position_peak);
  expect_slope(locked(0.0), locked(step), locked(-step));
  // To 1 %: a sum of powers over the frequencies next to the peak.
  const auto exact = [&](const SampledPeak& peak) { return std::log(peak.magnitude); };
  const SampledPeak position = loop.setting.highest_position_peak(loop.response);
  EXPECT_NEAR(found.peaks.position_peak.logarithm, exact(position), 0.01);
  EXPECT_NEAR(found.peaks.sensitivity_peak.logarithm,
              exact(loop.setting.highest_peak(loop.response)), 0.01);
  EXPECT_NEAR(locked(0.0).logarithm, exact(loop.setting.highest_locked_motor_gain(loop.response)),
              0.01);
}

// A controller that does not use the encoder above some frequency has a finite gradient there.
TEST(LoopFigures, LockedMotorGainIsOfTheEncoderAlone) {
  Loop loop;
  const Eigen::Index unused = loop.response.rows() / 2;
  loop.response.col(1).tail(loop.response.rows() - unused).setZero();
  const PeakFigure found = loop.locked_motor_gain(loop.response);
  for (const PeakFigure::Point& point : found.points) EXPECT_LT(point.frequency, unused);
  // It is proportional to the encoder's response.
  Eigen::ArrayXXcd of_encoder = Eigen::ArrayXXcd::Zero(loop.response.rows(), 3);
  of_encoder.col(1) = loop.response.col(1);
  EXPECT_NEAR(slope_along(found, of_encoder), 1.0, 1e-9);
  loop.response.col(1) *= 3.0;
  EXPECT_NEAR(loop.locked_motor_gain(loop.response).logarithm, found.logarithm + std::log(3.0),
              1e-12);
}

// The last pack is filled up with frequencies that count nowhere.
TEST(LoopFigures, DoNotDependOnHowManyFrequenciesFillTheLastPack) {
  const Loop loop;
  const LoopFigures all = loop.figures(loop.response);
  for (const Eigen::Index added : {1, 3, 6}) {
    // Further frequencies of no weight, with the values of the first.
    SampledSpectrum spectrum = loop.spectrum;
    Eigen::ArrayXXcd response = loop.response;
    const Eigen::Index count = response.rows() + added;
    const auto extended = [&](auto& values) {
      values.conservativeResize(count, Eigen::NoChange);
      for (Eigen::Index k = count - added; k < count; ++k) values.row(k) = values.row(0).eval();
    };
    extended(response);
    extended(spectrum.response);
    extended(spectrum.sensors);
    extended(spectrum.cross);
    extended(spectrum.boresight);
    extended(spectrum.by_command);
    extended(spectrum.weights);
    spectrum.weights.tail(added).setZero();
    const LoopFigures found = LoopFigureEvaluator(spectrum).figures(packed_response(response));
    EXPECT_NEAR(found.boresight_rms.logarithm, all.boresight_rms.logarithm, 1e-12);
    EXPECT_NEAR(found.control_effort.logarithm, all.control_effort.logarithm, 1e-12);
    EXPECT_EQ(found.peaks.sensitivity_peak.logarithm, all.peaks.sensitivity_peak.logarithm);
    EXPECT_EQ(found.peaks.position_peak.logarithm, all.peaks.position_peak.logarithm);
  }
}

// Where the last pack is filled up, |S| would be 1.
TEST(LoopFigures, PeaksAreOfTheFrequenciesAlone) {
  const Loop loop;
  SampledSpectrum spectrum = loop.spectrum;
  const Eigen::Index count = 8 * (loop.response.rows() / 8) - 3;
  spectrum.response = Eigen::ArrayXXcd::Constant(count, 3, -1.0);
  spectrum.sensors.conservativeResize(count, Eigen::NoChange);
  spectrum.cross.conservativeResize(count, Eigen::NoChange);
  spectrum.boresight.conservativeResize(count);
  spectrum.by_command.conservativeResize(count);
  spectrum.weights.conservativeResize(count);
  const auto ones = packed_response(Eigen::ArrayXXcd::Ones(count, 3));
  const LoopPeaks found = LoopFigureEvaluator(spectrum).peaks(ones);
  const double plateau = std::log(static_cast<double>(count)) / 400.0;
  EXPECT_NEAR(found.sensitivity_peak.logarithm, std::log(0.25) + plateau, 1e-12);
  EXPECT_NEAR(found.position_peak.logarithm, std::log(0.75) + plateau, 1e-12);
}

TEST(LoopFigures, AreNotFiniteWhereAResponseIsNot) {
  const Loop loop;
  SampledSpectrum spectrum = loop.spectrum;
  spectrum.response(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const LoopFigures found = LoopFigureEvaluator(spectrum).figures(packed_response(loop.response));
  EXPECT_TRUE(std::isnan(found.peaks.sensitivity_peak.logarithm));
  EXPECT_TRUE(std::isnan(found.boresight_rms.logarithm));
}

TEST(LoopFigures, AreTheSameForEveryWidthOfTheRegisters) {
  const Loop loop;
  const LoopFigures wide = loop.figures(loop.response);
  for (const std::size_t lanes : {2U, 4U}) {
    const numerics::NarrowRegisters narrow(lanes);
    const LoopFigures found = loop.figures(loop.response);
    EXPECT_EQ(found.boresight_rms.logarithm, wide.boresight_rms.logarithm);
    EXPECT_EQ(found.control_effort.logarithm, wide.control_effort.logarithm);
    EXPECT_EQ(slope_along(found.boresight_rms, loop.response),
              slope_along(wide.boresight_rms, loop.response));
    EXPECT_EQ(found.peaks.position_peak.logarithm, wide.peaks.position_peak.logarithm);
  }
}

TEST(LoopFigures, PeaksAloneAreThoseOfAllFigures) {
  const Loop loop;
  const LoopPeaks all = loop.figures(loop.response).peaks;
  const LoopPeaks alone = LoopFigureEvaluator(loop.spectrum).peaks(packed_response(loop.response));
  EXPECT_EQ(alone.sensitivity_peak.logarithm, all.sensitivity_peak.logarithm);
  EXPECT_EQ(alone.position_peak.logarithm, all.position_peak.logarithm);
  EXPECT_EQ(slope_along(alone.position_peak, loop.response),
            slope_along(all.position_peak, loop.response));
}

}  // namespace
}  // namespace boresight::design
