#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "band_power.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/gust_spectrum.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();

const GustSpectrum all_kinds[] = {davenport_gusts(0.005), von_karman_gusts(0.16, 111.0),
                                  kaimal_gusts(0.16, 37.0), eurocode_gusts(37.0, 0.05, 2.0)};

double reduced(const GustSpectrum& gusts, double x) {
  const double length = gusts.kind == GustSpectrumKind::davenport ? 1200.0 : gusts.length_scale;
  const double speed = 10.0, f = x * speed / length;
  return f * gust_spectrum(gusts, speed, f) / gust_variance(gusts, speed);
}

TEST(GustSpectrum, IntegratesToItsVariance) {
  for (const auto& gusts : all_kinds) {
    for (const double speed : {3.0, 10.0, 25.0}) {
      const auto spectrum = [&](double f) { return gust_spectrum(gusts, speed, f); };
      // Above f S falls like f^(-5/3), below it is level or rises: in closed form.
      const double low = 1e-9, high = 1e6;
      const double ends = 1.5 * high * spectrum(high) + low * spectrum(low);
      const double sum = reference::integral(spectrum, {low, high}, 20000) + ends;
      EXPECT_NEAR(sum / gust_variance(gusts, speed), 1.0, 1e-6) << to_string(gusts.kind);
    }
  }
}

TEST(GustSpectrum, OfEachKindIsThePrintedFormula) {
  for (const double x : {0.01, 0.3, 2.0, 70.0}) {
    EXPECT_NEAR(reduced(all_kinds[0], x) / (2.0 / 3.0 * x * x / std::pow(1.0 + x * x, 4.0 / 3.0)),
                1.0, 1e-12);
    // Printed with 70.8, which is c rounded.
    EXPECT_NEAR(reduced(all_kinds[1], x) / (4.0 * x / std::pow(1.0 + 70.8 * x * x, 5.0 / 6.0)), 1.0,
                2.5e-4);
    EXPECT_NEAR(reduced(all_kinds[2], x) / (4.0 * x / std::pow(1.0 + 6.0 * x, 5.0 / 3.0)), 1.0,
                1e-12);
    EXPECT_NEAR(reduced(all_kinds[3], x) / (6.8 * x / std::pow(1.0 + 10.2 * x, 5.0 / 3.0)), 1.0,
                1e-12);
  }
}

TEST(GustSpectrum, PeaksWhereTheDerivativeOfTheFormulaSays) {
  const double von_karman_peak = std::sqrt(1.5 / 70.7801);
  const double peaks[] = {std::numbers::sqrt3, von_karman_peak, 0.25, 1.0 / 6.8};
  // Largest f S/sigma^2: 2/3 * 3/4^(4/3), 4 x/2.5^(5/6), 2.5^(-5/3) twice.
  const double heights[] = {0.31498, 0.27135, 0.21715, 0.21715};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(reduced(all_kinds[i], peaks[i]), heights[i], 1e-5);
    EXPECT_GT(reduced(all_kinds[i], peaks[i]), reduced(all_kinds[i], 1.01 * peaks[i]));
    EXPECT_GT(reduced(all_kinds[i], peaks[i]), reduced(all_kinds[i], 0.99 * peaks[i]));
  }
}

TEST(GustSpectrum, HasThePrintedInertialSubrange) {
  const double f = 1e5, speed = 11.0;
  // IEC 61400-1: S -> 0.05 sigma^2 (Lambda/V)^(-2/3) f^(-5/3).
  const double lambda = 0.7 * 37.0;
  EXPECT_NEAR(gust_spectrum(all_kinds[2], speed, f) * std::pow(f, 5.0 / 3.0) *
                  std::pow(lambda / speed, 2.0 / 3.0) / gust_variance(all_kinds[2], speed),
              0.05, 1e-4);
  // ESDU 85020: f S/sigma^2 -> 0.115 x^(-2/3); equal to Kaimal's with 2.329 times the length (T.
  // Burton et al., Wind Energy Handbook, 2.6.4).
  EXPECT_NEAR(reduced(all_kinds[1], 1e6) * std::pow(1e6, 2.0 / 3.0), 0.115, 1e-4);
  GustSpectrum kaimal = all_kinds[1];
  kaimal.kind = GustSpectrumKind::kaimal;
  kaimal.length_scale *= 2.329;
  EXPECT_NEAR(gust_spectrum(kaimal, speed, f) / gust_spectrum(all_kinds[1], speed, f), 1.0, 5e-4);
}

TEST(GustSpectrum, OfVonKarmanHasItsIntegralLength) {
  // S(0) = 4 sigma^2 L/V: twice the integral of the correlation over all times is the spectrum at
  // 0.
  const double speed = 7.0;
  EXPECT_NEAR(gust_spectrum(all_kinds[1], speed, 1e-9) /
                  (4.0 * gust_variance(all_kinds[1], speed) * 111.0 / speed),
              1.0, 1e-12);
}

TEST(GustSpectrum, KeepsItsShapeWhenSpeedAndLengthScaleTogether) {
  for (const auto& gusts : all_kinds) {
    // With V also sigma: S ~ V at the same x.
    const double f = 0.03;
    EXPECT_NEAR(gust_spectrum(gusts, 20.0, 2.0 * f) / gust_spectrum(gusts, 10.0, f), 2.0, 1e-12);
  }
}

TEST(GustSpectrum, LengthsAndIntensitiesAreThoseOfTheStandards) {
  EXPECT_NEAR(kaimal_length_scale(60.0), 340.2, 1e-9);  // 8.1 * 42 m
  EXPECT_NEAR(kaimal_length_scale(90.0), 340.2, 1e-9);
  EXPECT_NEAR(kaimal_length_scale(30.0), 170.1, 1e-9);  // printed in the Wind Energy Handbook
  EXPECT_NEAR(von_karman_length_scale(10.0), 100.0, 1e-12);
  EXPECT_NEAR(von_karman_length_scale(120.0), 200.0, 1e-12);
  // 300 m at 200 m whatever the ground; (1/2)^0.67 at 100 m over towns.
  for (const double z0 : {0.003, 0.05, 1.0}) {
    EXPECT_NEAR(eurocode_length_scale(200.0, z0, 1.0), 300.0, 1e-9);
  }
  EXPECT_NEAR(eurocode_length_scale(100.0, 1.0, 10.0), 188.55, 0.01);
  EXPECT_EQ(eurocode_length_scale(4.0, 1.0, 10.0), eurocode_length_scale(10.0, 1.0, 10.0));
  EXPECT_NEAR(eurocode_turbulence_intensity(10.0, 0.05, 2.0), 0.1887, 1e-4);
  EXPECT_EQ(eurocode_turbulence_intensity(1.0, 0.3, 5.0),
            eurocode_turbulence_intensity(5.0, 0.3, 5.0));
}

TEST(GustSpectrum, DavenportsDragOfALogarithmicProfile) {
  // sigma/V = 0.98/ln(z/z0), tabulated for the axis heights of the 70-m and 34-m antennas.
  const auto intensity = [](double height, double z0) {
    return std::sqrt(gust_variance(davenport_gusts(davenport_surface_drag(height, z0)), 1.0));
  };
  EXPECT_NEAR(intensity(37.0, 0.01), 0.119, 5e-4);
  EXPECT_NEAR(intensity(37.0, 0.03), 0.138, 5e-4);
  EXPECT_NEAR(intensity(37.0, 0.3), 0.203, 6e-4);
  EXPECT_NEAR(intensity(20.0, 0.1), 0.185, 5e-4);
  // Davenport's own kappa of open country is that of a roughness of 3.5 cm at 10 m.
  EXPECT_NEAR(davenport_surface_drag(10.0, 0.035), 0.005, 1e-4);
}

TEST(GustSpectrum, RefusesParametersWithoutMeaning) {
  for (const double bad : {-0.1, std::nan(""), infinity}) {
    EXPECT_THAT(reference::Call([&] { davenport_gusts(bad); }),
                ThrowsMessage<InvalidInput>(HasSubstr("a surface_drag of at least 0")));
    EXPECT_THAT(reference::Call([&] { von_karman_gusts(bad, 100.0); }),
                ThrowsMessage<InvalidInput>(HasSubstr("a turbulence_intensity of at least 0")));
    EXPECT_THAT(
        reference::Call([&] { von_karman_gusts(0.1, bad); }),
        ThrowsMessage<InvalidInput>(HasSubstr("von_karman_gusts: expected a length_scale")));
    EXPECT_THROW(kaimal_gusts(bad, 30.0), InvalidInput);
    EXPECT_THROW(kaimal_gusts(0.1, bad), InvalidInput);
    EXPECT_THROW(eurocode_gusts(bad, 0.05, 2.0), InvalidInput);
    EXPECT_THROW(eurocode_gusts(20.0, bad, 2.0), InvalidInput);
    EXPECT_THROW(eurocode_gusts(20.0, 0.05, bad), InvalidInput);
    EXPECT_THROW(von_karman_length_scale(bad), InvalidInput);
    EXPECT_THROW(davenport_surface_drag(bad, 0.03), InvalidInput);
    EXPECT_THROW(davenport_surface_drag(10.0, bad), InvalidInput);
    for (const auto& gusts : all_kinds) {
      EXPECT_THAT(reference::Call([&] { gust_spectrum(gusts, bad, 1.0); }),
                  ThrowsMessage<InvalidInput>(HasSubstr("gust_spectrum: expected a mean_speed")));
      EXPECT_THAT(reference::Call([&] { gust_spectrum(gusts, 10.0, bad); }),
                  ThrowsMessage<InvalidInput>(HasSubstr("gust_spectrum: expected a frequency")));
      EXPECT_THROW(gust_variance(gusts, bad), InvalidInput);
    }
    EXPECT_THROW(davenport_spectrum(bad, 10.0, 1.0), InvalidInput);
  }
  EXPECT_THROW(davenport_surface_drag(0.02, 0.03), InvalidInput);
  EXPECT_THAT(reference::Call([] { eurocode_turbulence_intensity(0.5, 1.0, 0.9); }),
              ThrowsMessage<InvalidInput>(HasSubstr("above the roughness_length of 1 m")));
  GustSpectrum none;
  none.kind = static_cast<GustSpectrumKind>(7);
  EXPECT_THROW(gust_spectrum(none, 10.0, 1.0), InvalidInput);
  EXPECT_THROW(gust_variance(none, 10.0), InvalidInput);
  EXPECT_THROW(to_string(none.kind), InvalidInput);
  EXPECT_EQ(to_string(GustSpectrumKind::eurocode), "eurocode");
}

}  // namespace
}  // namespace boresight::plant
