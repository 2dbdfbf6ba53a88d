#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "band_power.hpp"
#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::plant {
namespace {

using reference::Band;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double speed = 10.0;
constexpr double duration = 3600.0;
constexpr WindModel models[] = {WindModel::uniform, WindModel::vickery, WindModel::coherence};

double target(WindModel model, double frequency) {
  return wind_torque_spectrum(reference::wind_site(), model, speed, frequency);
}

StationarySeries torque(WindModel model, double sample_time, bool periodic) {
  return wind_torque_series(reference::wind_site(), model, WindTorquePart::both, speed, duration,
                            sample_time, {periodic});
}

Eigen::ArrayXd mean_line_powers(const StationarySeries& series, std::uint64_t seeds, bool window) {
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(series.samples() / 2);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    mean += reference::line_powers(series.draw(seed), window) / static_cast<double>(seeds);
  }
  return mean;
}

// Largest relative error of the third-octave bands' powers between the middles of two bands.
double worst_band(WindModel model, const Eigen::ArrayXd& powers, double first, double last) {
  double worst = 0.0;
  for (const Band& band : reference::third_octaves(first, last)) {
    const double found = (powers * reference::fractions(powers.size(), 1.0 / duration, band)).sum();
    const double expected =
        reference::integral([&](double f) { return target(model, f); }, band, 20);
    worst = std::max(worst, std::abs(found / expected - 1.0));
  }
  return worst;
}

// A band of relative width 0.23 about f has 0.23 f T lines in T seconds, and its power the relative
// standard error 1/sqrt(0.23 f T seeds): 50 series settle the bands above 0.2 Hz to 5 %, those
// below need more series, and these fewer samples.
class ThirdOctaves : public testing::TestWithParam<WindModel> {};

TEST_P(ThirdOctaves, OfPeriodicSeriesAreTheSpectrums) {
  const WindModel model = GetParam();
  const auto powers = [&](double sample_time, std::uint64_t seeds) {
    return mean_line_powers(torque(model, sample_time, true), seeds, false);
  };
  EXPECT_LT(worst_band(model, powers(0.0625, 50), 0.2, 5.0), 0.05);
  EXPECT_LT(worst_band(model, powers(1.0, 600), 0.02, 0.2), 0.05);
  EXPECT_LT(worst_band(model, powers(18.75, 6000), 0.001, 0.02), 0.05);
}

TEST_P(ThirdOctaves, OfFiftySeriesScatterAsTheirLinesMake) {
  const WindModel model = GetParam();
  const Eigen::ArrayXd powers = mean_line_powers(torque(model, 0.5, true), 50, false);
  for (const Band& band : reference::third_octaves(0.001, 0.8)) {
    const Eigen::ArrayXd fractions = reference::fractions(powers.size(), 1.0 / duration, band);
    const double expected =
        reference::integral([&](double f) { return target(model, f); }, band, 20);
    const double lines = std::pow(fractions.sum(), 2) / fractions.square().sum();
    EXPECT_NEAR((powers * fractions).sum() / expected, 1.0, 0.01 + 3.5 / std::sqrt(50.0 * lines));
  }
}

TEST_P(ThirdOctaves, AddUpToTheVariance) {
  const WindModel model = GetParam();
  constexpr int seeds = 50;
  const StationarySeries series = torque(model, 0.5, true);
  const Eigen::ArrayXd powers = mean_line_powers(series, seeds, false);
  // Within 3 standard errors over [1/T, fs/2]; the first line's cell begins at half of that.
  const Eigen::ArrayXd fractions =
      reference::fractions(powers.size(), 1.0 / duration, {1.0 / duration, 1.0});
  const double expected =
      reference::integral([&](double f) { return target(model, f); }, {1.0 / duration, 1.0}, 400);
  const double error = std::sqrt((series.line_powers() * fractions).square().sum() / seeds);
  EXPECT_LT(error, 0.02 * expected);
  EXPECT_NEAR((powers * fractions).sum(), expected, 3.0 * error);
  EXPECT_NEAR((series.line_powers() * fractions).sum() / expected, 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Models, ThirdOctaves, testing::ValuesIn(models),
                         [](const auto& model) { return std::string(to_string(model.param)); });

TEST(WindTimeSeries, CutFromALongerOneHasTheSpectrumToo) {
  const WindModel model = WindModel::coherence;
  const auto powers = [&](double sample_time, std::uint64_t seeds) {
    return mean_line_powers(torque(model, sample_time, false), seeds, true);
  };
  EXPECT_LT(worst_band(model, powers(0.1, 40), 0.4, 4.0), 0.05);
  EXPECT_LT(worst_band(model, powers(1.0, 600), 0.032, 0.4), 0.05);
  EXPECT_LT(worst_band(model, powers(18.75, 8000), 0.001, 0.016), 0.05);
}

TEST(WindTimeSeries, OfTheUniformModelIsTheGustTimesTheSensitivity) {
  const WindSite site = reference::wind_site();
  const Eigen::VectorXd gust = gust_series(site, speed, 200.0, 0.1).draw(3);
  const WindTorqueParts parts =
      synthesise_wind_torque(site, WindModel::uniform, speed, 200.0, 0.1, 3);
  const Eigen::VectorXd expected = wind_torque_sensitivity(site, speed) * gust;
  EXPECT_LT((parts.uniform - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(parts.gradient.size(), parts.uniform.size());
  EXPECT_EQ(parts.gradient.norm(), 0.0);
}

TEST(WindTimeSeries, OfTheCoherenceModelHasTwoIndependentParts) {
  const WindSite site = reference::wind_site();
  double product = 0.0, uniform = 0.0, gradient = 0.0;
  const auto part = [&](WindTorquePart which) {
    return wind_torque_series(site, WindModel::coherence, which, speed, duration, 1.0);
  };
  const StationarySeries even = part(WindTorquePart::uniform);
  const StationarySeries slope = part(WindTorquePart::gradient);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Eigen::VectorXd x = even.draw(seed, 0), y = slope.draw(seed, 1);
    product += x.dot(y);
    uniform += x.squaredNorm();
    gradient += y.squaredNorm();
  }
  EXPECT_NEAR(product / std::sqrt(uniform * gradient), 0.0, 0.03);
  EXPECT_NEAR(uniform / (20.0 * duration * even.variance()), 1.0, 0.05);
  EXPECT_NEAR(gradient / (20.0 * duration * slope.variance()), 1.0, 0.05);
  const StationarySeries both = part(WindTorquePart::both);
  EXPECT_NEAR((even.variance() + slope.variance()) / both.variance(), 1.0, 1e-6);
  const WindTorqueParts parts =
      synthesise_wind_torque(site, WindModel::coherence, speed, duration, 1.0, 19);
  EXPECT_EQ(parts.uniform, even.draw(19, 0));
  EXPECT_EQ(parts.gradient, slope.draw(19, 1));
}

TEST(WindTimeSeries, FollowsTheSpectrumOfTheSite) {
  WindSite site = reference::wind_site();
  for (const auto& gusts :
       {von_karman_gusts(0.16, 111.0), kaimal_gusts(0.16, 37.0), eurocode_gusts(37.0, 0.05, 2.0)}) {
    site.gusts = gusts;
    const StationarySeries series = gust_series(site, speed, duration, 0.25, {true});
    const double expected = reference::integral(
        [&](double f) { return gust_spectrum(gusts, speed, f); }, {0.5 / duration, 2.0}, 2000);
    EXPECT_NEAR(series.variance() / expected, 1.0, 1e-4);
    double mean = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      mean += series.draw(seed).squaredNorm() / (20.0 * static_cast<double>(series.samples()));
    }
    const double error = std::sqrt(series.line_powers().square().sum() / 20.0);
    EXPECT_NEAR(mean, expected, 3.0 * error) << to_string(gusts.kind);
  }
}

// w^2/(s^2 + 2 z w s + w^2): the position loop of a servo, from torque to error up to a factor.
TEST(WindTimeSeries, ShakesALinearLoopAsTheSpectralIntegralSays) {
  for (const WindModel model : models) {
    for (const double frequency : {0.05, 0.6}) {
      const double w = two_pi * frequency, zeta = 0.35, step = 0.125;
      const StateSpace loop = rational({w * w}, {w * w, 2.0 * zeta * w, 1.0}, "t", "y", "loop");
      const auto gain = [&](double f) {
        return std::norm(frequency_response(loop, two_pi * f)(0, 0));
      };
      const auto power = [&](double f) { return gain(f) * target(model, f); };
      const Band band{0.2 / duration, 0.5 / step};
      const double expected = reference::integral(power, band, 2000);
      const double squares =
          reference::integral([&](double f) { return std::pow(power(f), 2); }, band, 2000);
      constexpr int seeds = 12;
      constexpr Eigen::Index settling = 800;
      const StationarySeries series = torque(model, step, false);
      double found = 0.0;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        LinearSimulation simulation(loop, step, {.interpolation = Interpolation::first_order_hold});
        const Eigen::MatrixXd y = simulation.simulate(series.draw(seed));
        const auto settled = y.bottomRows(y.rows() - settling);
        found += settled.squaredNorm() / static_cast<double>(settled.rows() * seeds);
      }
      const double error = std::sqrt(squares / (duration * seeds));
      EXPECT_LT(error, 0.06 * expected);
      EXPECT_NEAR(found, expected, 3.0 * error) << to_string(model) << " " << frequency;
    }
  }
}

TEST(WindTimeSeries, RefusesWhatItsPartsRefuse) {
  WindSite site = reference::wind_site();
  const auto draw = [&] {
    return synthesise_wind_torque(site, WindModel::vickery, speed, 10.0, 0.1, 1);
  };
  EXPECT_NO_THROW(draw());
  site.coherence_decay = -8.0;
  EXPECT_THAT(reference::Call(draw),
              ThrowsMessage<InvalidInput>(HasSubstr("a coherence_decay that is at least 0")));
  EXPECT_THROW(gust_series(site, speed, 10.0, 0.1), InvalidInput);
  site = reference::wind_site();
  EXPECT_THROW(gust_series(site, -1.0, 10.0, 0.1), InvalidInput);
  EXPECT_THROW(gust_series(site, 10.0, 10.0, 0.0), InvalidInput);
  EXPECT_THROW(synthesise_wind_torque(site, WindModel::uniform, std::nan(""), 10.0, 0.1, 1),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
