#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Integral over f from low to high by the trapezoid rule in ln f.
template <typename Function>
double integral(Function spectrum, double low, double high, int points) {
  const double step = std::log(high / low) / points;
  double sum = 0.0;
  for (int i = 0; i <= points; ++i) {
    const double f = low * std::exp(i * step);
    sum += (i == 0 || i == points ? 0.5 : 1.0) * f * spectrum(f);
  }
  return sum * step;
}

TEST(DavenportSpectrum, IntegratesToTheGustVariance) {
  for (const double speed : {3.0, 10.0, 25.0}) {
    const auto spectrum = [&](double f) { return davenport_spectrum(0.005, speed, f); };
    // The tail above f goes like f^(-2/3): integrated in closed form.
    const double high = 1e6;
    const double tail = 1.5 * high * spectrum(high);
    EXPECT_NEAR(integral(spectrum, 1e-9, high, 20000) + tail, 6.0 * 0.005 * speed * speed,
                1e-6 * speed * speed);
  }
}

TEST(DavenportSpectrum, PeaksAtOneWaveIn1200Metres) {
  // f S_v is largest at x = sqrt(3): d/dx x^2/(1+x^2)^(4/3) = 0.
  const double speed = 10.0, peak = std::numbers::sqrt3 * speed / 1200.0;
  const auto energy = [&](double f) { return f * davenport_spectrum(0.005, speed, f); };
  EXPECT_GT(energy(peak), energy(1.01 * peak));
  EXPECT_GT(energy(peak), energy(0.99 * peak));
}

TEST(MeanWindTorque, AtTheMotorInTenMetresASecond) {
  const double torque = mean_wind_torque(reference::wind_site(), 10.0);
  EXPECT_NEAR(torque / reference::gear_ratio(), 51.6, 0.05);
  EXPECT_NEAR(mean_wind_torque(reference::wind_site(), 20.0), 4.0 * torque, 1e-9 * torque);
}

TEST(CoherenceAverages, OfAGustOverTheWholeDish) {
  const auto [uniform, gradient] = coherence_averages(0.0);
  EXPECT_NEAR(uniform, 1.0, 1e-10);
  EXPECT_NEAR(gradient, 0.0, 1e-10);
}

TEST(CoherenceAverages, OfSmallEddiesAreThoseOfTheAreaTheyCover) {
  // For large a each point pairs with the eddy around it: <coh> -> 2/a^2, and <y y' coh> -> that
  // times <y^2> = R^2/4. The rim, where part of the eddy is cut off, takes of the order 1/a.
  for (const double a : {300.0, 3000.0, 30000.0}) {
    const auto [uniform, gradient] = coherence_averages(a);
    EXPECT_NEAR(uniform * a * a / 2.0, 1.0, 3.0 / a);
    EXPECT_NEAR(gradient * a * a * 2.0, 1.0, 6.0 / a);
  }
}

TEST(CoherenceAverages, OfLargeEddiesHaveTheMeanDistance) {
  // <coh> = 1 - a <r>/R with the mean distance 128/(45 pi) R of two points of a disc.
  const double a = 1e-6;
  EXPECT_NEAR((1.0 - coherence_averages(a).uniform) / a, 128.0 / (45.0 * std::numbers::pi), 1e-4);
}

TEST(CoherenceAverages, FallAsTheEddiesShrinkAndKeepToTheirBounds) {
  double previous = 1.0;
  for (double a = 1e-3; a < 1e5; a *= 1.1) {
    const auto [uniform, gradient] = coherence_averages(a);
    EXPECT_LT(uniform, previous);
    EXPECT_GT(gradient, 0.0);
    EXPECT_LT(gradient, 0.25 * uniform + 1e-12);
    previous = uniform;
  }
}

TEST(CoherenceAverages, AreThoseOverAGridOfPointPairs) {
  // Points in polar cells of equal weight; the second of a pair turned against the first.
  constexpr int rings = 60, spokes = 240;
  for (const double a : {0.1, 1.0, 4.0, 12.0}) {
    double uniform = 0.0, gradient = 0.0;
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < rings; ++j) {
        const double r1 = (i + 0.5) / rings, r2 = (j + 0.5) / rings;
        double sum = 0.0, aligned = 0.0;
        for (int k = 0; k < spokes; ++k) {
          const double angle = two_pi * (k + 0.5) / spokes;
          const double distance = std::sqrt(r1 * r1 + r2 * r2 - 2.0 * r1 * r2 * std::cos(angle));
          const double coherence = std::exp(-a * distance);
          sum += coherence;
          aligned += coherence * std::cos(angle);
        }
        const double weight = 4.0 * r1 * r2 / (rings * rings * spokes);
        uniform += weight * sum;
        // <y y'> over all turns of the pair together: r1 r2 cos(angle)/2.
        gradient += weight * aligned * 0.5 * r1 * r2;
      }
    }
    const auto found = coherence_averages(a);
    EXPECT_NEAR(found.uniform, uniform, 2e-3 * uniform) << a;
    EXPECT_NEAR(found.gradient, gradient, 4e-3 * gradient) << a;
  }
}

TEST(CoherenceAverages, AreThoseOfRandomPointPairs) {
  reference::RandomNumbers random(81);
  const auto point = [&] {
    const double radius = std::sqrt(random.uniform(0.0, 1.0));
    return std::polar(radius, random.uniform(0.0, two_pi));
  };
  constexpr int random_samples = 400000;
  const double a = 2.5;
  double uniform = 0.0, uniform_square = 0.0, gradient = 0.0, gradient_square = 0.0;
  for (int i = 0; i < random_samples; ++i) {
    const auto p = point(), q = point();
    const double coherence = std::exp(-a * std::abs(p - q));
    const double moment = p.imag() * q.imag() * coherence;
    uniform += coherence / random_samples;
    uniform_square += coherence * coherence / random_samples;
    gradient += moment / random_samples;
    gradient_square += moment * moment / random_samples;
  }
  const auto error = [&](double mean, double square) {
    return std::sqrt((square - mean * mean) / random_samples);
  };
  const auto found = coherence_averages(a);
  EXPECT_NEAR(found.uniform, uniform, 4.0 * error(uniform, uniform_square));
  EXPECT_NEAR(found.gradient, gradient, 4.0 * error(gradient, gradient_square));
}

TEST(WindTorqueSpectrum, ByVickeryHasTheRmsOfTheReference) {
  const WindSite site = reference::wind_site();
  const double variance =
      integral([&](double f) { return wind_torque_spectrum(site, WindModel::vickery, 10.0, f); },
               1e-8, 1e4, 20000);
  EXPECT_NEAR(std::sqrt(variance) / reference::gear_ratio(), 13.9, 0.05);
}

TEST(WindTorqueSpectrum, OfOneGustOverTheDishIsTheTorquesDerivativeTimesTheGust) {
  // T ~ V^2: dT/dV = 2T/V.
  const WindSite site = reference::wind_site();
  const double speed = 12.0, step = 1e-4;
  const double slope =
      (mean_wind_torque(site, speed + step) - mean_wind_torque(site, speed - step)) / (2.0 * step);
  for (const double f : {1e-3, 0.1, 3.0}) {
    const double gust = davenport_spectrum(site.surface_drag, speed, f);
    EXPECT_NEAR(wind_torque_spectrum(site, WindModel::uniform, speed, f) / (slope * slope * gust),
                1.0, 1e-8);
  }
}

TEST(WindTorqueSpectrum, OfTheCoherenceModelIsUniformPartPlusGradientPart) {
  const double speed = 10.0, f = 0.2;
  const auto at = [&](double torque, double gradient) {
    WindSite site = reference::wind_site();
    site.torque_coefficient = torque;
    site.gradient_coefficient = gradient;
    return wind_torque_spectrum(site, WindModel::coherence, speed, f);
  };
  const double both = at(0.1, 1.0);
  EXPECT_NEAR(at(0.1, 0.0) + at(0.0, 1.0), both, 1e-12 * both);
  EXPECT_GT(at(0.0, 1.0), at(0.1, 0.0));  // the gradient is the larger part above 0.1 Hz
  const auto averages = coherence_averages(8.0 * f * 35.0 / speed);
  EXPECT_NEAR(
      at(0.1, 0.0),
      averages.uniform * wind_torque_spectrum(reference::wind_site(), WindModel::uniform, speed, f),
      1e-12 * both);
  // rho V Cn times the integral of y v over the disc.
  const double area = std::numbers::pi * 35.0 * 35.0;
  const double lever = 1.1 * speed * 1.0 * area * 35.0;
  const double gradient_part = averages.gradient * lever * lever;
  EXPECT_NEAR(at(0.0, 1.0) / (gradient_part * davenport_spectrum(0.005, speed, f)), 1.0, 1e-12);
}

TEST(WindTorqueSpectrum, ModelsAgreeWhereGustsAreMuchLargerThanTheDish) {
  const WindSite site = reference::wind_site();
  const double f = 1e-6;
  const double uniform = wind_torque_spectrum(site, WindModel::uniform, 10.0, f);
  EXPECT_NEAR(wind_torque_spectrum(site, WindModel::vickery, 10.0, f) / uniform, 1.0, 1e-4);
  EXPECT_NEAR(wind_torque_spectrum(site, WindModel::coherence, 10.0, f) / uniform, 1.0, 1e-3);
}

TEST(WindTorqueSpectrum, ByDefaultIsDavenportsOfTheSurfaceDrag) {
  const WindSite plain = reference::wind_site();
  WindSite named = plain;
  named.surface_drag = 0.123;
  named.gusts = davenport_gusts(plain.surface_drag);
  EXPECT_EQ(site_gusts(plain), *named.gusts);
  for (const auto model : {WindModel::uniform, WindModel::vickery, WindModel::coherence}) {
    for (const double f : {1e-3, 0.1, 3.0}) {
      EXPECT_EQ(wind_torque_spectrum(plain, model, 10.0, f),
                wind_torque_spectrum(named, model, 10.0, f));
    }
  }
}

TEST(WindTorqueSpectrum, FollowsTheGustsOfTheSite) {
  const WindSite plain = reference::wind_site();
  for (const auto& gusts :
       {von_karman_gusts(0.16, 111.0), kaimal_gusts(0.16, 37.0), eurocode_gusts(37.0, 0.05, 2.0)}) {
    WindSite site = plain;
    site.gusts = gusts;
    for (const auto model : {WindModel::uniform, WindModel::vickery, WindModel::coherence}) {
      for (const double f : {1e-3, 0.1, 3.0}) {
        const double expected = wind_torque_spectrum(plain, model, 10.0, f) *
                                gust_spectrum(gusts, 10.0, f) / davenport_spectrum(0.005, 10.0, f);
        EXPECT_NEAR(wind_torque_spectrum(site, model, 10.0, f) / expected, 1.0, 1e-14);
      }
    }
  }
}

TEST(WindTorqueSpectrum, HasPartsThatAddUp) {
  const WindSite site = reference::wind_site();
  for (const auto model : {WindModel::uniform, WindModel::vickery, WindModel::coherence}) {
    for (const double f : {1e-3, 0.1, 3.0}) {
      const auto part = [&](WindTorquePart which) {
        return wind_torque_spectrum(site, model, 10.0, f, which);
      };
      const double both = part(WindTorquePart::both);
      EXPECT_NEAR(part(WindTorquePart::uniform) + part(WindTorquePart::gradient), both,
                  1e-14 * both);
      EXPECT_EQ(part(WindTorquePart::gradient) > 0.0, model == WindModel::coherence);
      // The uniform part is the gust through sensitivity and admittance.
      const double gain =
          wind_torque_sensitivity(site, 10.0) * wind_admittance(site, model, 10.0, f);
      EXPECT_NEAR(
          part(WindTorquePart::uniform) / (gain * gain * davenport_spectrum(0.005, 10.0, f)), 1.0,
          1e-13);
    }
  }
}

TEST(WindAdmittance, FallsFromOneAsGustsShrink) {
  const WindSite site = reference::wind_site();
  for (const auto model : {WindModel::uniform, WindModel::vickery, WindModel::coherence}) {
    EXPECT_NEAR(wind_admittance(site, model, 10.0, 0.0), 1.0, 1e-10);
    EXPECT_LE(wind_admittance(site, model, 10.0, 0.3), wind_admittance(site, model, 10.0, 0.1));
  }
  // Vickery's is 1/2 where a wave is as long as twice the side of the square of the dish's area.
  const double side = 35.0 * std::sqrt(std::numbers::pi);
  EXPECT_NEAR(wind_admittance(site, WindModel::vickery, 10.0, 10.0 / (2.0 * side)), 0.5, 1e-12);
}

TEST(WindSite, RefusesElementsWithoutMeaning) {
  const auto refused = [](double WindSite::*element, double value, const char* words) {
    WindSite site = reference::wind_site();
    site.*element = value;
    EXPECT_THAT(
        reference::Call([&] { wind_torque_spectrum(site, WindModel::coherence, 10.0, 1.0); }),
        ThrowsMessage<InvalidInput>(HasSubstr(words)));
    EXPECT_THROW(mean_wind_torque(site, 10.0), InvalidInput);
    EXPECT_THROW(wind_torque_sensitivity(site, 10.0), InvalidInput);
    EXPECT_THROW(wind_admittance(site, WindModel::uniform, 10.0, 1.0), InvalidInput);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, std::nan(""), infinity}) {
    refused(&WindSite::air_density, bad,
            "wind_torque_spectrum: expected an air_density that is at");
    refused(&WindSite::surface_drag, bad, "a surface_drag that is at least 0");
    refused(&WindSite::coherence_decay, bad, "a coherence_decay that is at least 0");
    refused(&WindSite::dish_diameter, bad, "a dish_diameter that is at least 0");
    EXPECT_THROW(mean_wind_torque(reference::wind_site(), bad), InvalidInput);
    EXPECT_THROW(wind_torque_sensitivity(reference::wind_site(), bad), InvalidInput);
    EXPECT_THROW(wind_admittance(reference::wind_site(), WindModel::uniform, bad, 1.0),
                 InvalidInput);
    EXPECT_THROW(wind_admittance(reference::wind_site(), WindModel::uniform, 10.0, bad),
                 InvalidInput);
    EXPECT_THROW(coherence_averages(bad), InvalidInput);
  }
  refused(&WindSite::torque_coefficient, infinity, "a torque_coefficient that is finite");
  refused(&WindSite::gradient_coefficient, infinity, "a gradient_coefficient that is finite");
  WindSite site = reference::wind_site();
  site.gusts = GustSpectrum{GustSpectrumKind::kaimal, 0.0, 0.1, 0.0};
  EXPECT_THAT(reference::Call([&] { validate(site, "here"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("here: expected a length_scale above 0")));
  EXPECT_THROW(wind_admittance(reference::wind_site(), static_cast<WindModel>(9), 10.0, 1.0),
               InvalidInput);
}

TEST(WindTorqueSpectrum, RefusesFrequenciesAndSpeedsWithoutMeaning) {
  const WindSite site = reference::wind_site();
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(reference::Call([&] { wind_torque_spectrum(site, WindModel::uniform, bad, 1.0); }),
                ThrowsMessage<InvalidInput>(HasSubstr("wind_torque_spectrum")));
    EXPECT_THROW(wind_torque_spectrum(site, WindModel::uniform, 10.0, bad), InvalidInput);
  }
  EXPECT_THROW(wind_torque_spectrum(site, static_cast<WindModel>(9), 10.0, 1.0), InvalidInput);
  EXPECT_THROW(to_string(static_cast<WindModel>(9)), InvalidInput);
  EXPECT_EQ(to_string(WindModel::coherence), "coherence");
}

}  // namespace
}  // namespace boresight::plant
