#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "band_power.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/stationary_series.hpp>

namespace boresight::plant {
namespace {

using reference::Band;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;

// First-order noise of variance 1: one-sided 4 T/(1 + (2 pi f T)^2).
double first_order(double frequency, double time_constant = 5.0) {
  return 4.0 * time_constant / (1.0 + std::pow(2.0 * pi * frequency * time_constant, 2));
}

const Spectrum gusty = [](double f) { return first_order(f); };

TEST(StationarySeries, HasTheVarianceOfItsBand) {
  // Integral of the spectrum from df/2 to fs/2: arc tangents.
  const auto below = [](double f) { return 2.0 / pi * std::atan(2.0 * pi * f * 5.0); };
  for (const bool periodic : {false, true}) {
    for (const double duration : {48.0, 600.0, 3600.0}) {
      const StationarySeries series(gusty, duration, 0.5, {periodic});
      const double step = series.frequency_step();
      EXPECT_NEAR(series.variance(), below(1.0) - below(0.5 * step), 1e-5);
      EXPECT_EQ(series.samples(), static_cast<Eigen::Index>(2.0 * duration));
      EXPECT_EQ(series.draw(1).size(), series.samples());
      if (periodic) {
        EXPECT_NEAR(step, 1.0 / duration, 1e-15);
      } else {
        EXPECT_LE(step, 0.5 / duration);
        EXPECT_GT(step, 0.25 / duration);
      }
    }
  }
}

TEST(StationarySeries, PutsIntoEachLineTheIntegralOverItsCell) {
  // A resonance far narrower than the lines, a jump and a corner: the same in every step.
  const auto resonance = [](double f) {
    const double x = f / 0.1503;
    return 1.0 / (std::pow(1.0 - x * x, 2) + std::pow(2e-4 * x, 2));
  };
  // (pi/2) f0/(2 zeta) of the resonance, to its 1e-3.
  const double power = 0.5 * pi * 0.1503 / 2e-4;
  const StationarySeries narrow(resonance, 250.0, 0.5, {true});
  EXPECT_NEAR(narrow.variance() / power, 1.0, 2e-3);
  EXPECT_NEAR(narrow.line_powers()[37] / power, 1.0, 2e-2);  // 0.152 Hz
  const auto band_limited = [](double f) { return f > 0.0123 && f < 0.517 ? 2.0 : 0.0; };
  const StationarySeries jumps(band_limited, 500.0, 0.5, {true});
  EXPECT_NEAR(jumps.variance(), 2.0 * (0.517 - 0.0123), 1e-6);
  const auto power_law = [](double f) { return std::pow(f, -5.0 / 3.0); };
  const StationarySeries steep(power_law, 100.0, 1.0, {true});
  EXPECT_NEAR(steep.variance() / (1.5 * (std::pow(0.005, -2.0 / 3.0) - std::pow(0.5, -2.0 / 3.0))),
              1.0, 1e-4);
  EXPECT_EQ(StationarySeries([](double) { return 0.0; }, 10.0, 0.1).draw(4).norm(), 0.0);
}

TEST(StationarySeries, IsTheSameForTheSameSeedOnly) {
  for (const bool periodic : {false, true}) {
    const Eigen::VectorXd one = synthesise(gusty, 100.0, 0.1, 7, {periodic});
    const StationarySeries prepared(gusty, 100.0, 0.1, {periodic});
    prepared.draw(99);
    const Eigen::VectorXd again = prepared.draw(7);
    ASSERT_EQ(one.size(), again.size());
    for (Eigen::Index i = 0; i < one.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(one[i]), std::bit_cast<std::uint64_t>(again[i]));
    }
    for (const Eigen::VectorXd& other : {prepared.draw(8), prepared.draw(7, 1)}) {
      EXPECT_LT(std::abs(one.dot(other)) / (one.norm() * other.norm()), 0.5);
    }
  }
}

TEST(StationarySeries, IsGaussianAtEverySampleWithTheSameVariance) {
  constexpr int seeds = 4000;
  for (const bool periodic : {false, true}) {
    const StationarySeries series(gusty, 32.0, 1.0, {periodic});
    Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(32), square = mean, fourth = mean;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const Eigen::ArrayXd x = series.draw(seed).array() / std::sqrt(series.variance());
      mean += x / seeds;
      square += x.square() / seeds;
      fourth += x.pow(4) / seeds;
    }
    // Standard errors of the moments of a normal number: 1, sqrt 2, sqrt 96 over sqrt(seeds).
    EXPECT_LT(mean.abs().maxCoeff(), 4.0 / std::sqrt(seeds));
    EXPECT_LT((square - 1.0).abs().maxCoeff(), 4.0 * std::sqrt(2.0 / seeds));
    EXPECT_LT((fourth - 3.0).abs().maxCoeff(), 4.5 * std::sqrt(96.0 / seeds));
  }
}

TEST(StationarySeries, HasTheCorrelationOfItsSpectrumWithoutWrappingRound) {
  // exp(-t/T); periodic series correlate their end with their start, the others do not.
  constexpr int seeds = 4000;
  for (const bool periodic : {false, true}) {
    const StationarySeries series(gusty, 200.0, 0.5, {periodic});
    Eigen::ArrayXd product = Eigen::ArrayXd::Zero(400);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const Eigen::VectorXd x = series.draw(seed);
      product += x[0] * x.array() / seeds;
    }
    const double mean_and_above = 1.0 - series.variance();
    for (const Eigen::Index lag : {2, 10, 20, 200, 390, 398}) {
      double expected = std::exp(-0.5 * static_cast<double>(lag) / 5.0);
      if (periodic) expected += std::exp(-0.5 * static_cast<double>(400 - lag) / 5.0);
      EXPECT_NEAR(product[lag], expected, mean_and_above + 4.0 / std::sqrt(seeds)) << lag;
    }
  }
}

TEST(StationarySeries, MeanSquaresScatterAsStated) {
  constexpr int seeds = 2000;
  const StationarySeries series(gusty, 1200.0, 0.5, {true});
  double mean = 0.0, square = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const double x = series.draw(seed).squaredNorm() / 2400.0;
    mean += x / seeds;
    square += x * x / seeds;
  }
  const double deviation = std::sqrt(series.line_powers().square().sum());
  EXPECT_NEAR(mean, series.variance(), 3.0 * deviation / std::sqrt(seeds));
  EXPECT_NEAR(std::sqrt(square - mean * mean) / deviation, 1.0, 0.08);
  // The integral of S^2 over all frequencies is twice the time constant.
  EXPECT_NEAR(deviation / std::sqrt(2.0 * 5.0 / 1200.0), 1.0, 0.01);
}

TEST(StationarySeries, OfHalfTheSampleTimeHasTheSameContentBelow) {
  for (const bool periodic : {false, true}) {
    const Eigen::VectorXd coarse = synthesise(gusty, 256.0, 0.5, 12, {periodic});
    const Eigen::VectorXd fine = synthesise(gusty, 256.0, 0.25, 12, {periodic});
    if (periodic) {
      const Eigen::VectorXcd low = numerics::fourier_transform(coarse) / 512.0;
      const Eigen::VectorXcd all = numerics::fourier_transform(fine) / 1024.0;
      EXPECT_LT((low.head(256) - all.head(256)).cwiseAbs().maxCoeff(), 1e-14);
    }
    // What the finer series has more is of frequencies above 1 Hz: little, and without correlation.
    const Eigen::VectorXd more = fine(Eigen::seqN(0, 512, 2)) - coarse;
    EXPECT_LT(more.squaredNorm() / 512.0, 3.0 * (1.0 - 2.0 / pi * std::atan(10.0 * pi)));
    const Band band{0.02, 0.5};
    const auto power = [&](const Eigen::VectorXd& x) {
      return (reference::line_powers(x, !periodic) *
              reference::fractions(x.size() / 2, 1.0 / 256.0, band))
          .sum();
    };
    EXPECT_NEAR(power(fine) / power(coarse), 1.0, periodic ? 1e-12 : 1e-3);
  }
}

TEST(StationarySeries, RefusesWhatItCannotDraw) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -0.1, std::nan(""), infinity}) {
    EXPECT_THAT(reference::Call([&] { synthesise(gusty, 100.0, bad, 1); }),
                ThrowsMessage<InvalidInput>(HasSubstr("a sample_time above 0")));
    EXPECT_THAT(reference::Call([&] { synthesise(gusty, bad, 0.1, 1); }),
                ThrowsMessage<InvalidInput>(HasSubstr("a duration of 2 to 2^26 samples")));
  }
  EXPECT_THROW(synthesise(gusty, 0.14, 0.1, 1), InvalidInput);
  EXPECT_NO_THROW(synthesise(gusty, 0.2, 0.1, 1));
  EXPECT_NO_THROW(synthesise(gusty, 0.2, 0.1, 1, {true}));
  EXPECT_THROW(synthesise(gusty, 1e9, 0.1, 1), InvalidInput);
  EXPECT_THROW(synthesise(nullptr, 10.0, 0.1, 1), InvalidInput);
  EXPECT_THAT(reference::Call([&] { synthesise(gusty, 97.0, 1.0, 1, {true}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("2, 3 and 5 only, such as 100, found 97")));
  EXPECT_NO_THROW(synthesise(gusty, 97.0, 1.0, 1));
  for (const double bad : {-1.0, std::nan(""), infinity}) {
    const auto spectrum = [&](double f) { return f > 0.2 ? bad : 1.0; };
    EXPECT_THAT(reference::Call([&] { synthesise(spectrum, 100.0, 1.0, 1); }),
                ThrowsMessage<InvalidInput>(HasSubstr("expected a finite spectrum of at least 0")));
  }
  const auto noise = [](double f) { return std::fmod(1e9 * std::sqrt(f), 1.0); };
  EXPECT_THAT(reference::Call([&] { synthesise(noise, 1000.0, 1.0, 1); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("smooth it or lengthen the series")));
}

}  // namespace
}  // namespace boresight::plant
