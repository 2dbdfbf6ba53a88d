#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/design/problem/pointing.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

constexpr double mdeg = 1e-3 * degree;
constexpr LossConvention conventions[] = {LossConvention::mean_loss_two_axes,
                                          LossConvention::mean_loss_one_axis,
                                          LossConvention::loss_at_mean_radial_error};

double ka_beamwidth() {
  return half_power_beamwidth(61.0 * degree, 32e9, 70.0);
}

TEST(HalfPowerBeamwidth, OfThe70MetreDishAtKaBand) {
  EXPECT_NEAR(ka_beamwidth() / mdeg, 8.16, 0.005);
}

TEST(HalfPowerBeamwidth, IsProportionalToWavelengthOverDiameter) {
  EXPECT_NEAR(half_power_beamwidth(1.1, 8e9, 70.0), 4.0 * half_power_beamwidth(1.1, 32e9, 70.0),
              1e-15);
  EXPECT_NEAR(half_power_beamwidth(1.1, 8e9, 35.0), 2.0 * half_power_beamwidth(1.1, 8e9, 70.0),
              1e-15);
}

TEST(HalfPowerBeamwidth, RefusesWhatHasNoBeam) {
  EXPECT_THROW(half_power_beamwidth(0.0, 32e9, 70.0), InvalidInput);
  EXPECT_THROW(half_power_beamwidth(1.1, 0.0, 70.0), InvalidInput);
  EXPECT_THROW(half_power_beamwidth(1.1, 32e9, -70.0), InvalidInput);
  EXPECT_THROW(half_power_beamwidth(1.1, std::nan(""), 70.0), InvalidInput);
  // 32 MHz for 32 GHz: a wavelength of 9.4 m still fits a 70-m dish, 3 MHz does not.
  EXPECT_THAT(reference::Call([] { half_power_beamwidth(1.1, 3e6, 70.0); }),
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("wavelength shorter")));
}

TEST(RmsForLoss, GivesTheBudgetsOfATenthOfADecibel) {
  const double boresight = ka_beamwidth();
  EXPECT_NEAR(rms_for_loss(0.1, boresight, LossConvention::mean_loss_two_axes) / mdeg, 0.527, 5e-4);
  EXPECT_NEAR(rms_for_loss(0.1, boresight, LossConvention::loss_at_mean_radial_error) / mdeg, 0.595,
              5e-4);
  EXPECT_NEAR(rms_for_loss(0.1, boresight, LossConvention::mean_loss_one_axis) /
                  rms_for_loss(0.1, boresight, LossConvention::mean_loss_two_axes),
              std::numbers::sqrt2, 1e-14);
}

TEST(RmsForLoss, InvertsTheLoss) {
  for (const auto convention : conventions) {
    for (const double loss : {1e-4, 0.1, 3.0}) {
      EXPECT_NEAR(pointing_loss_db(rms_for_loss(loss, 0.01, convention), 0.01, convention) / loss,
                  1.0, 1e-14);
    }
  }
}

TEST(PointingLoss, IsTheMeanOverGaussianErrors) {
  // Mean of 12 (theta/HPBW)^2 and of the radius itself over two axes, by quadrature over the
  // Rayleigh density r exp(-r^2/2).
  double mean_square = 0.0, mean_radius = 0.0;
  constexpr double step = 1e-3;
  for (double r = 0.5 * step; r < 12.0; r += step) {
    const double fraction = r * std::exp(-0.5 * r * r) * step;
    mean_square += fraction * r * r;
    mean_radius += fraction * r;
  }
  const double boresight = 8.0, rms = 0.5;
  EXPECT_NEAR(pointing_loss_db(rms, boresight, LossConvention::mean_loss_two_axes),
              12.0 * mean_square * std::pow(rms / boresight, 2), 1e-6);
  EXPECT_NEAR(pointing_loss_db(rms, boresight, LossConvention::loss_at_mean_radial_error),
              12.0 * std::pow(mean_radius * rms / boresight, 2), 1e-6);
  EXPECT_NEAR(pointing_loss_db(rms, boresight, LossConvention::mean_loss_one_axis),
              12.0 * std::pow(rms / boresight, 2), 1e-15);
}

TEST(PointingLoss, AtHalfTheBeamwidthIsThreeDecibels) {
  EXPECT_DOUBLE_EQ(pointing_loss_db(0.5, 1.0, LossConvention::mean_loss_one_axis), 3.0);
}

TEST(LossConvention, HasANameOfItsOwn) {
  EXPECT_NE(to_string(conventions[0]), to_string(conventions[1]));
  EXPECT_NE(to_string(conventions[1]), to_string(conventions[2]));
  EXPECT_THROW(to_string(static_cast<LossConvention>(9)), InvalidInput);
}

// Half power of 2 J1(u)/u at u = 1.616339948.
TEST(BeamwidthFactor, OfUniformIllumination) {
  for (const auto shape : {IlluminationShape::parabola_on_pedestal, IlluminationShape::gaussian}) {
    EXPECT_NEAR(beamwidth_factor({shape, 0.0, 1.0}), 1.028993969, 1e-8);
  }
  EXPECT_NEAR(beamwidth_factor({}) / degree, 58.957, 5e-4);
}

// The integral of (b + (1 - b)(1 - r^2)^p) J0(u r) r dr in closed form (Sonine's first integral),
// at the half power that the factor claims.
TEST(BeamwidthFactor, OfAParabolaOnAPedestalHasHalfThePower) {
  for (const double p : {0.5, 1.0, 2.0, 3.5}) {
    for (const double taper : {6.0, 10.0, 12.0, 20.0, 60.0}) {
      const double b = std::pow(10.0, -taper / 20.0);
      const double u = 0.5 * std::numbers::pi *
                       beamwidth_factor({IlluminationShape::parabola_on_pedestal, taper, p});
      const double pattern = b * std::cyl_bessel_j(1.0, u) / u +
                             (1.0 - b) * std::pow(2.0, p) * std::tgamma(p + 1.0) *
                                 std::cyl_bessel_j(p + 1.0, u) / std::pow(u, p + 1.0);
      const double axis = 0.5 * b + 0.5 * (1.0 - b) / (p + 1.0);
      EXPECT_NEAR(pattern * pattern / (axis * axis), 0.5, 1e-9) << p << ' ' << taper;
    }
  }
}

// Over an endless aperture the Hankel transform of exp(-a r^2) is exp(-u^2/4a); what the edge cuts
// off is of the size of its level.
TEST(BeamwidthFactor, ApproachesThatOfAGaussianBeam) {
  const auto excess = [](double taper) {
    const double a = taper * std::numbers::ln10 / 20.0;
    return beamwidth_factor({IlluminationShape::gaussian, taper, 1.0}) /
               (2.0 / std::numbers::pi * std::sqrt(2.0 * a * std::numbers::ln2)) -
           1.0;
  };
  EXPECT_NEAR(excess(60.0), 0.0, 3e-3);
  EXPECT_NEAR(excess(60.0) / excess(40.0), 0.1, 0.05);
}

TEST(BeamwidthFactor, GrowsWithTheTaperWithinTheUsualRange) {
  double last = 0.0;
  for (const double taper : {0.0, 5.0, 10.0, 15.0, 20.0}) {
    const double factor = beamwidth_factor({IlluminationShape::parabola_on_pedestal, taper, 1.0});
    EXPECT_GT(factor, last);
    EXPECT_GT(factor, 58.9 * degree);
    EXPECT_LT(factor, 73.0 * degree);
    last = factor;
  }
}

TEST(BeamwidthFactor, RefusesWhatIsNoIllumination) {
  for (const Illumination& wrong :
       {Illumination{IlluminationShape::gaussian, -1.0, 1.0},
        Illumination{IlluminationShape::gaussian, 61.0, 1.0},
        Illumination{IlluminationShape::parabola_on_pedestal, 10.0, 0.0},
        Illumination{IlluminationShape::parabola_on_pedestal, std::nan(""), 1.0}}) {
    EXPECT_THROW(beamwidth_factor(wrong), InvalidInput);
  }
}

}  // namespace
}  // namespace boresight::design
