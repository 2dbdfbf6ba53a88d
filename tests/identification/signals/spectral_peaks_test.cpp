#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/identification/signals/spectral_peaks.hpp>
#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

const VectorXd axis = VectorXd::LinSpaced(501, 0.0, 50.0);

TEST(SpectralPeaks, AGaussiansPlaceAndHeightAreExact) {
  const VectorXd power = 7.0 * (-(axis.array() - 21.237).square() / 0.5).exp();
  const auto peaks = spectral_peaks(axis, power);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].frequency, 21.237, 1e-9);
  EXPECT_NEAR(peaks[0].height, 7.0, 1e-9);
}

TEST(SpectralPeaks, ASinesPlaceIsKnownToAFiftiethOfABin) {
  for (const double frequency : {9.02, 9.05, 9.08}) {
    const VectorXd x = VectorXd::NullaryExpr(1000, [&](Index i) {
      return std::cos(2.0 * std::numbers::pi * frequency * 0.01 * static_cast<double>(i) + 1.0);
    });
    SpectrumOptions options;
    options.segment_length = 1000;
    const auto spectra = spectral_matrix(x, 0.01, options);
    const auto peaks = spectral_peaks(spectra.frequency, spectra.auto_density(0));
    EXPECT_NEAR(peaks.front().frequency, frequency, 0.02 * 0.1);
  }
}

TEST(SpectralPeaks, HalfPowerGivesTheDampingOfAResonance) {
  for (const double zeta : {0.01, 0.03}) {
    const VectorXd power = axis.unaryExpr([zeta](double f) {
      const double r = f / 20.0;
      return 1.0 / (std::pow(1.0 - r * r, 2) + std::pow(2.0 * zeta * r, 2));
    });
    const auto peaks = spectral_peaks(axis, power);
    ASSERT_EQ(peaks.size(), 1U);
    ASSERT_TRUE(peaks[0].half_power_damping.has_value());
    EXPECT_NEAR(peaks[0].half_power_damping.value_or(0.0), zeta, 0.03 * zeta);
  }
}

TEST(SpectralPeaks, ANeighbourThatHidesAFlankLeavesNoDamping) {
  const auto bump = [](double centre) {
    return (1.0 / (1.0 + (axis.array() - centre).square())).matrix().eval();
  };
  PeakOptions options;
  options.background_bins = 200;
  const auto peaks = spectral_peaks(axis, bump(20.0) + 0.9 * bump(22.5), options);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_FALSE(peaks[0].half_power_damping.has_value());
}

TEST(SpectralPeaks, KeepToTheBandAndToWhatStandsOut) {
  VectorXd power = VectorXd::Ones(501);
  power(100) = 10.0;  // 10 Hz
  power(200) = 5.0;
  power(300) = 2.0;
  const auto all = spectral_peaks(axis, power);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_GT(all[0].height, all[1].height);
  EXPECT_NEAR(all[0].over_background, 10.0, 1e-9);
  PeakOptions options;
  options.lowest = 15.0;
  options.highest = 35.0;
  options.min_over_background = 1.5;
  const auto some = spectral_peaks(axis, power, options);
  ASSERT_EQ(some.size(), 2U);
  EXPECT_NEAR(some[1].frequency, 30.0, 1e-9);
}

TEST(LabelHarmonics, MarksThoseWithinTheTolerance) {
  std::vector<SpectralPeak> peaks(3);
  peaks[0].frequency = 0.9376;  // harmonic 15 of 16 s is 0.9375
  peaks[1].frequency = 0.97;
  peaks[2].frequency = 0.001;
  label_harmonics(peaks, 16.0, 0.004);
  EXPECT_EQ(peaks[0].harmonic, 15);
  EXPECT_NEAR(peaks[0].from_harmonic, 0.0001, 1e-12);
  EXPECT_EQ(peaks[1].harmonic, 0);
  EXPECT_NEAR(peaks[1].from_harmonic, 0.97 - 1.0, 1e-12);
  EXPECT_EQ(peaks[2].harmonic, 0);
}

VectorXd triangle(Index samples, double period, double lead, double dt) {
  return VectorXd::NullaryExpr(samples, [&](Index i) {
    const double t = static_cast<double>(i) * dt - lead;
    if (t < 0.0) return 0.0;
    const double phase = std::fmod(t / period, 1.0);
    return phase < 0.25 ? 4.0 * phase : phase < 0.75 ? 2.0 - 4.0 * phase : 4.0 * phase - 4.0;
  });
}

TEST(RepetitionPeriod, IsATrianglesOwn) {
  for (const double period : {4.0, 7.3, 13.0}) {
    const auto found = repetition_period(triangle(4000, period, 0.0, 0.01), 0.01);
    ASSERT_TRUE(found.has_value()) << period;
    EXPECT_NEAR(found.value_or(0.0), period, 0.005 * period);
  }
}

TEST(RepetitionPeriod, IsNotADoubleOrAFaultOfNoise) {
  const numerics::NormalNumbers numbers(3);
  VectorXd x = triangle(6000, 9.0, 2.0, 0.01);
  VectorXd noise(6000);
  for (Index i = 0; i < 6000; ++i) noise(i) = numbers.pair(static_cast<std::uint64_t>(i)).real();
  EXPECT_NEAR(repetition_period(x + 0.1 * noise, 0.01).value_or(0.0), 9.0, 0.09);
  EXPECT_FALSE(repetition_period(noise, 0.01).has_value());
  EXPECT_FALSE(repetition_period(VectorXd::Constant(100, 2.0), 0.01).has_value());
  EXPECT_FALSE(repetition_period(VectorXd::LinSpaced(100, 0.0, 1.0), 0.01).has_value());
}

TEST(SpectralPeaks, RefuseWhatIsNoSpectrum) {
  EXPECT_THAT(reference::Call([] { spectral_peaks(axis, VectorXd::Ones(4)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 501 frequencies and 4 powers")));
  EXPECT_THAT(reference::Call([] { spectral_peaks(axis, -VectorXd::Ones(501)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("finite and not negative")));
  EXPECT_THAT(reference::Call([] { spectral_peaks(axis.cwiseAbs2(), VectorXd::Ones(501)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected evenly spaced frequencies")));
  std::vector<SpectralPeak> peaks(1);
  EXPECT_THAT(reference::Call([&] { label_harmonics(peaks, 0.0, 1.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive period and tolerance, found 0 s")));
  EXPECT_THAT(reference::Call([] { repetition_period(VectorXd::Ones(3), 0.1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 16 finite samples")));
}

}  // namespace
}  // namespace boresight::identification
