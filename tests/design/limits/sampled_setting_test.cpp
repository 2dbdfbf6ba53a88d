#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>

namespace boresight::design {
namespace {

// Two peaks of |S| = 1/|D|, each with D a straight line in the complex plane over ln frequency: the
// lower one on a frequency of the grid, the higher one halfway between two, where it is lower than
// the other.
TEST(SampledSetting, FindsTheHigherOfTwoPeaksBetweenItsFrequencies) {
  const Eigen::ArrayXd places = Eigen::ArrayXd::LinSpaced(201, std::log(0.1), std::log(100.0));
  const Eigen::ArrayXd frequency = places.exp();
  TrackingProblem problem = reference::tracking_problem();
  problem.noise.torque_rms = 0.5;
  const SampledSetting setting("own", problem.plant, fit_wind_filter(problem), problem.noise, 0.02,
                               frequency);
  const double spacing = places[1] - places[0];
  const double centre = places[140] + 0.5 * spacing;
  const auto line = [&](double place, double peak) {
    return Eigen::ArrayXcd(1.0 / peak +
                           std::complex<double>(0.0, 0.1) * (places - place) / spacing);
  };
  const Eigen::ArrayXcd lower = line(places[60], 1.648), higher = line(centre, 1.652);
  ASSERT_LT(higher.abs().inverse().maxCoeff(), lower.abs().inverse().maxCoeff());
  const Eigen::ArrayXcd difference = (places < places[100]).select(lower, higher);
  // D = 1 - K P.
  Eigen::ArrayXXcd controller = Eigen::ArrayXXcd::Zero(frequency.size(), 3);
  controller.col(0) = (1.0 - difference) / sampled_spectrum(setting, frequency).response.col(0);
  const SampledPeak peak = setting.highest_peak(controller);
  EXPECT_NEAR(peak.magnitude, 1.652, 1e-9);
  EXPECT_NEAR(peak.frequency / std::exp(centre), 1.0, 1e-9);
}

}  // namespace
}  // namespace boresight::design
