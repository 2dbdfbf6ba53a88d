#include <cmath>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>

namespace boresight::design {
namespace {

// Two peaks of ln |S|, parabolas in ln frequency: the lower one on a frequency of the grid, the
// higher one halfway between two, where it is lower than the other.
TEST(SampledSetting, FindsTheHigherOfTwoPeaksBetweenItsFrequencies) {
  const Eigen::ArrayXd places = Eigen::ArrayXd::LinSpaced(201, std::log(0.1), std::log(100.0));
  const Eigen::ArrayXd frequency = places.exp();
  TrackingProblem problem = reference::tracking_problem();
  problem.noise.torque_rms = 0.5;
  const SampledSetting setting("own", problem.plant, fit_wind_filter(problem), problem.noise, 0.02,
                               frequency);
  const double spacing = places[1] - places[0];
  const double centre = places[140] + 0.5 * spacing;
  const auto parabola = [&](double place, double height) {
    return height - 0.04 * ((places - place) / spacing).square();
  };
  const Eigen::ArrayXd lower = parabola(places[60], 0.5), higher = parabola(centre, 0.502);
  ASSERT_LT(higher.maxCoeff(), lower.maxCoeff());
  const Eigen::ArrayXd level = lower.max(higher).max(0.0);
  // S = 1/(1 - K P) is exp(level) with K = (1 - exp(-level))/P.
  Eigen::ArrayXXcd controller = Eigen::ArrayXXcd::Zero(frequency.size(), 3);
  controller.col(0) = (1.0 - (-level).exp()) / sampled_spectrum(setting, frequency).response.col(0);
  const SampledPeak peak = setting.highest_peak(controller);
  EXPECT_NEAR(peak.magnitude, std::exp(0.502), 1e-9);
  EXPECT_NEAR(peak.frequency / std::exp(centre), 1.0, 1e-9);
}

}  // namespace
}  // namespace boresight::design
