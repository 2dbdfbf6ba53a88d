#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/identification/signals/frequency_response_estimate.hpp>
#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double dt = 0.01;

VectorXd noise(Index samples, std::uint64_t stream) {
  const numerics::NormalNumbers numbers(11, stream);
  return VectorXd::NullaryExpr(
      samples, [&](Index i) { return numbers.pair(static_cast<std::uint64_t>(i)).real(); });
}

VectorXd sine(Index samples, double amplitude, double frequency) {
  return VectorXd::NullaryExpr(samples, [&](Index i) {
    return amplitude * std::sin(two_pi * frequency * dt * static_cast<double>(i) + 0.4);
  });
}

TEST(SpectralMatrix, OfWhiteNoiseHasTwiceItsVarianceAndSampleTime) {
  const VectorXd x = 3.0 * noise(60000, 1);
  SpectrumOptions options;
  options.segment_length = 600;
  const auto spectra = spectral_matrix(x, dt, options);
  const VectorXd density = spectra.auto_density(0);
  const double level = 2.0 * 9.0 * dt;
  // Mean over the bins between the ends; each has a relative deviation of 1/sqrt(averages).
  const double mean = density.segment(2, 297).mean();
  EXPECT_NEAR(mean, level, 4.0 * level / std::sqrt(spectra.effective_averages * 297.0 / 1.5));
  double square = 0.0;
  for (Index k = 2; k < 299; ++k) square += std::pow(density(k) / level - 1.0, 2);
  EXPECT_NEAR(std::sqrt(square / 297.0), 1.0 / std::sqrt(spectra.effective_averages),
              0.2 / std::sqrt(spectra.effective_averages));
}

TEST(SpectralMatrix, SumsToTheMeanSquareWithoutAWindow) {
  SpectrumOptions options;
  options.window = SpectralWindow::rectangular;
  options.detrend = Detrend::none;
  options.overlap = 0.0;
  for (const Index length : {500, 125}) {
    options.segment_length = length;
    const VectorXd x = noise(500, 2).array() + 0.7;
    const auto spectra = spectral_matrix(x, dt, options);
    const double bin = spectra.frequency(1);
    EXPECT_NEAR(spectra.auto_density(0).sum() * bin, x.squaredNorm() / 500.0, 1e-12);
    EXPECT_EQ(spectra.segments, 500 / length);
    EXPECT_NEAR(spectra.effective_averages, static_cast<double>(500 / length), 1e-12);
  }
}

TEST(SpectralMatrix, SinesPowerIsThePeakTimesTheNoiseBandwidth) {
  SpectrumOptions options;
  options.segment_length = 1000;
  options.window = SpectralWindow::flat_top;
  for (const double frequency : {12.3, 12.33, 12.35}) {
    const auto spectra = spectral_matrix(sine(4000, 2.5, frequency), dt, options);
    const double power = spectra.auto_density(0).maxCoeff() * spectra.noise_bandwidth;
    EXPECT_NEAR(std::sqrt(2.0 * power), 2.5, 0.003 * 2.5) << frequency;
  }
  options.window = SpectralWindow::hann;
  const auto spectra = spectral_matrix(sine(4000, 2.5, 12.3), dt, options);
  EXPECT_NEAR(spectra.noise_bandwidth, 1.5 * spectra.frequency(1), 1e-12);
  EXPECT_NEAR(std::sqrt(2.0 * spectra.auto_density(0).maxCoeff() * spectra.noise_bandwidth), 2.5,
              1e-3);
}

TEST(SpectralMatrix, CrossDensityHasThePhaseOfADelay) {
  const VectorXd long_noise = noise(20100, 3);
  MatrixXd channels(20000, 2);
  channels.col(0) = long_noise.tail(20000);  // earlier by five samples
  channels.col(1) = long_noise.segment(95, 20000);
  const auto spectra = spectral_matrix(channels, dt);
  const auto cross = spectra.cross_density(0, 1);
  for (Index k = 5; k < cross.size() / 2; k += 37) {
    const double expected = -two_pi * spectra.frequency(k) * 5.0 * dt;
    EXPECT_NEAR(std::abs(std::polar(1.0, std::arg(cross(k)) - expected) - 1.0), 0.0, 0.05);
  }
  EXPECT_GT(spectra.coherence(0, 1).segment(5, 500).minCoeff(), 0.98);
  EXPECT_EQ(spectra.cross_density(1, 0), cross.conjugate());
}

TEST(SpectralMatrix, LeavesSegmentsWithInvalidSamplesOut) {
  VectorXd x = noise(4000, 4);
  SpectrumOptions options;
  options.segment_length = 500;
  options.overlap = 0.0;
  std::vector<bool> valid(4000, true);
  valid[1100] = false;
  const auto clean = spectral_matrix(x, dt, options, valid);
  EXPECT_EQ(clean.segments, 7);
  EXPECT_EQ(clean.left_out, 1);
  x(1100) = 1e6;
  EXPECT_EQ(spectral_matrix(x, dt, options, valid).auto_density(0), clean.auto_density(0));
  EXPECT_GT(spectral_matrix(x, dt, options).auto_density(0).maxCoeff(), 1e3);
}

TEST(SpectralMatrix, TakesOutALine) {
  SpectrumOptions options;
  options.segment_length = 400;
  options.detrend = Detrend::line;
  const VectorXd x = VectorXd::LinSpaced(2000, -300.0, 900.0);
  EXPECT_LT(spectral_matrix(x, dt, options).auto_density(0).maxCoeff(), 1e-18);
  options.detrend = Detrend::mean;
  EXPECT_GT(spectral_matrix(x, dt, options).auto_density(0).maxCoeff(), 1.0);
}

TEST(SpectralMatrix, OverlappingSegmentsAreWorthLessThanTheirNumber) {
  SpectrumOptions options;
  options.segment_length = 256;
  options.overlap = 0.75;
  const auto dense = spectral_matrix(noise(8192, 5), dt, options);
  options.overlap = 0.5;
  const auto half = spectral_matrix(noise(8192, 5), dt, options);
  // Hann's window half overlapped: correlation 1/6, so 63/(1 + 2/36) nearly.
  EXPECT_EQ(half.segments, 63);
  EXPECT_NEAR(half.effective_averages, 63.0 / (1.0 + 2.0 / 36.0 * 62.0 / 63.0), 0.05);
  EXPECT_GT(dense.segments, 120);
  EXPECT_LT(dense.effective_averages, 1.2 * half.effective_averages);
  EXPECT_GT(dense.effective_averages, half.effective_averages);
}

TEST(SpectralMatrix, RefusesWhatItCannotDo) {
  const auto refused = [](const MatrixXd& x, const SpectrumOptions& options,
                          const std::vector<bool>& valid, const char* message) {
    EXPECT_THAT(reference::Call([&] { spectral_matrix(x, dt, options, valid); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  SpectrumOptions options;
  refused(MatrixXd(0, 1), options, {}, "found 0 samples of 1 channels");
  refused(MatrixXd::Constant(100, 1, NAN), options, {}, "expected finite samples");
  refused(MatrixXd::Zero(100, 1), options, {true}, "mask of 100 samples or none, found 1");
  options.segment_length = 101;
  refused(MatrixXd::Zero(100, 1), options, {}, "a segment of 8 .. 100 samples");
  options = {};
  options.overlap = 0.95;
  refused(MatrixXd::Zero(100, 1), options, {}, "an overlap of 0 .. 0.9, found 100 and 0.95");
  EXPECT_THAT(reference::Call(
                  [] { spectral_matrix(MatrixXd::Zero(100, 1), dt, {}, std::vector<bool>(100)); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("all 1 segments of 100 samples")));
}

// y = 2 x(t) - x(t - dt) in a record of noise.
VectorXd filtered(const VectorXd& x) {
  VectorXd y = 2.0 * x;
  y.tail(x.size() - 1) -= x.head(x.size() - 1);
  return y;
}

std::complex<double> filter_response(double frequency) {
  return 2.0 - std::exp(std::complex<double>(0.0, -two_pi * frequency * dt));
}

TEST(FrequencyResponseEstimate, IsTheFiltersAndItsScatterIsWhatItSays) {
  double square = 0.0, bias = 0.0;
  int count = 0;
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    MatrixXd channels(20000, 2);
    channels.col(0) = noise(20000, 100 + trial);
    channels.col(1) = filtered(channels.col(0)) + 1.5 * noise(20000, 200 + trial);
    SpectrumOptions options;
    options.segment_length = 400;
    const auto estimate = frequency_response_estimate(spectral_matrix(channels, dt, options), 0, 1);
    for (Index k = 3; k < 190; k += 3) {
      const auto error = estimate.response(k) / filter_response(estimate.frequency(k)) - 1.0;
      square += std::pow(error.real() / estimate.relative_uncertainty(k), 2);
      bias += error.real();
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(square / count), 1.0, 0.1);
  EXPECT_NEAR(bias / count, 0.0, 0.01);
}

TEST(FrequencyResponseEstimate, NoiseAtTheInputPullsH1DownOnly) {
  MatrixXd channels(80000, 2);
  const VectorXd x = noise(80000, 6);
  channels.col(1) = filtered(x) + 0.8 * noise(80000, 7);
  channels.col(0) = x + 0.8 * noise(80000, 8);
  SpectrumOptions options;
  options.segment_length = 200;
  const auto spectra = spectral_matrix(channels, dt, options);
  const auto mean_ratio = [&](const FrequencyResponseEstimate& estimate) {
    double sum = 0.0;
    for (Index k = 5; k < 95; ++k) {
      sum += (estimate.response(k) / filter_response(estimate.frequency(k))).real() / 90.0;
    }
    return sum;
  };
  EXPECT_NEAR(mean_ratio(frequency_response_estimate(spectra, 0, 1)), 1.0 / 1.64, 0.02);
  EXPECT_NEAR(mean_ratio(frequency_response_estimate(spectra, 0, 1, ResponseEstimator::hv)), 1.0,
              0.02);
  // Almost all noise at one end makes hv the estimator for that end.
  const auto h1 = frequency_response_estimate(spectra, 0, 1).response;
  const auto h2 = frequency_response_estimate(spectra, 0, 1, ResponseEstimator::h2).response;
  const auto output_only =
      frequency_response_estimate(spectra, 0, 1, ResponseEstimator::hv, 1e9).response;
  const auto input_only =
      frequency_response_estimate(spectra, 0, 1, ResponseEstimator::hv, 1e-9).response;
  EXPECT_LT((output_only - h1).norm(), 1e-6 * h1.norm());
  EXPECT_LT((input_only - h2).norm(), 1e-6 * h2.norm());
  for (Index k = 5; k < 95; ++k) EXPECT_GT(std::abs(h2(k)), std::abs(h1(k)));
}

TEST(FrequencyResponseEstimate, AReferenceSeesThroughNoiseThatGoesRoundALoop) {
  // x = r + n: the noise n is also in y, with another filter, as in a loop.
  const VectorXd r = noise(80000, 9), n = noise(80000, 10);
  MatrixXd channels(80000, 3);
  channels.col(0) = r;
  channels.col(1) = r + n;
  channels.col(2) = filtered(channels.col(1)) - 2.0 * n;
  SpectrumOptions options;
  options.segment_length = 200;
  const auto spectra = spectral_matrix(channels, dt, options);
  const auto referenced = referenced_response_estimate(spectra, 0, 1, 2);
  const auto h1 = frequency_response_estimate(spectra, 1, 2);
  double square = 0.0;
  for (Index k = 5; k < 95; ++k) {
    const auto truth = filter_response(referenced.frequency(k));
    square += std::norm(referenced.response(k) / truth - 1.0) /
              (2.0 * std::pow(referenced.relative_uncertainty(k), 2)) / 90.0;
    EXPECT_GT(std::abs(h1.response(k) - truth), 0.7);
  }
  EXPECT_NEAR(std::sqrt(square), 1.0, 0.25);
}

TEST(FrequencyResponseEstimate, OfOneSegmentKnowsNoUncertainty) {
  MatrixXd channels(100, 2);
  channels << noise(100, 12), noise(100, 13);
  SpectrumOptions options;
  options.segment_length = 100;
  const auto estimate = frequency_response_estimate(spectral_matrix(channels, dt, options), 0, 1);
  EXPECT_TRUE(std::isinf(estimate.relative_uncertainty(7)));
}

TEST(FrequencyResponseEstimate, RefusesChannelsAndRatiosThatAreNone) {
  const auto spectra = spectral_matrix(noise(100, 14), dt);
  EXPECT_THAT(reference::Call([&] { frequency_response_estimate(spectra, 0, 1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected channels below 1, found 1")));
  EXPECT_THAT(reference::Call([&] { referenced_response_estimate(spectra, -1, 0, 0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected channels below 1, found -1")));
  EXPECT_THAT(reference::Call(
                  [&] { frequency_response_estimate(spectra, 0, 0, ResponseEstimator::hv, 0.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive ratio of noise powers, found 0")));
}

}  // namespace
}  // namespace boresight::identification
