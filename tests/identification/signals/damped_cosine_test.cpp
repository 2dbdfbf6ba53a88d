#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/identification/signals/damped_cosine.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double dt = 0.005;

VectorXd ring(Index samples, const RingPole& pole, Complex amplitude) {
  const Complex s(-pole.decay_rate, two_pi * pole.damped_frequency);
  return VectorXd::NullaryExpr(samples, [&](Index i) {
    return (amplitude * std::exp(s * dt * static_cast<double>(i))).real();
  });
}

MatrixXd noise(Index rows, Index columns, std::uint64_t stream) {
  const numerics::NormalNumbers numbers(5, stream);
  return MatrixXd::NullaryExpr(rows, columns, [&](Index i, Index j) {
    return numbers.pair(static_cast<std::uint64_t>(i + rows * j)).real();
  });
}

const RingPole slow{2.2, 1.4}, fast{3.1, 0.4};

TEST(FitDampedCosines, FindsPolesAndAmplitudesOfExactData) {
  MatrixXd x(400, 2);
  x.col(0) = ring(400, slow, {1.0, 2.0}) + ring(400, fast, {0.5, -0.3});
  x.col(1) = 100.0 * ring(400, slow, {-0.2, 0.1}) + 100.0 * ring(400, fast, {0.0, 1.0});
  x.col(0) += VectorXd::LinSpaced(400, 5.0, -3.0);
  const auto fit = fit_damped_cosines(x, dt, {{2.0, 2.0}, {3.3, 0.6}});
  EXPECT_TRUE(fit.converged);
  ASSERT_EQ(fit.modes.size(), 2U);
  EXPECT_NEAR(fit.modes[0].pole.damped_frequency, slow.damped_frequency, 1e-8);
  EXPECT_NEAR(fit.modes[0].pole.decay_rate, slow.decay_rate, 1e-7);
  EXPECT_NEAR(fit.modes[1].pole.damped_frequency, fast.damped_frequency, 1e-8);
  EXPECT_NEAR(fit.modes[1].pole.decay_rate, fast.decay_rate, 1e-7);
  EXPECT_NEAR(std::abs(fit.modes[0].amplitude(0) - Complex(1.0, 2.0)), 0.0, 1e-6);
  EXPECT_NEAR(std::abs(fit.modes[1].amplitude(1) - Complex(0.0, 100.0)), 0.0, 1e-4);
  const double natural = std::hypot(two_pi * slow.damped_frequency, slow.decay_rate);
  EXPECT_NEAR(fit.modes[0].natural_frequency.value, natural / two_pi, 1e-8);
  EXPECT_NEAR(fit.modes[0].damping_ratio.value, slow.decay_rate / natural, 1e-8);
  EXPECT_LT(fit.residual_rms(0), 1e-7);
  const VectorXd back = ring(400, slow, {1.0, 2.0}) + ring(400, fast, {0.5, -0.3});
  EXPECT_LT((fit.oscillation.col(0) - back).norm(), 1e-5);
}

TEST(FitDampedCosines, DoesNotDependOnAChannelsUnit) {
  MatrixXd x(300, 2);
  x << ring(300, slow, {1.0, 0.5}), ring(300, slow, {0.3, -1.0});
  x += 0.02 * noise(300, 2, 1);
  const auto fit = fit_damped_cosines(x, dt, {{2.1, 1.0}});
  x.col(1) *= 1e7;
  const auto other = fit_damped_cosines(x, dt, {{2.1, 1.0}});
  EXPECT_NEAR(other.modes[0].natural_frequency.value, fit.modes[0].natural_frequency.value, 1e-7);
  EXPECT_NEAR(other.modes[0].damping_ratio.standard_uncertainty,
              fit.modes[0].damping_ratio.standard_uncertainty, 1e-6);
}

// The frequency's variance cannot be below the Cramer-Rao bound, which for a decaying cosine of
// amplitude A in noise v is v/(2 A^2 sum t^2 e^-2st) and more for unknown phase, decay and trend;
// what the fit says must be what repeated fits scatter by.
TEST(FitDampedCosines, UncertaintiesAreWhatRepeatedFitsScatterBy) {
  constexpr int trials = 300;
  double frequency_square = 0.0, damping_square = 0.0, said_frequency = 0.0, said_damping = 0.0;
  int frequency_covered = 0, damping_covered = 0;
  const double natural = std::hypot(two_pi * slow.damped_frequency, slow.decay_rate);
  for (int trial = 0; trial < trials; ++trial) {
    const MatrixXd x =
        ring(300, slow, {1.0, 0.5}) + 0.1 * noise(300, 1, 1000 + static_cast<std::uint64_t>(trial));
    const auto mode = fit_damped_cosines(x, dt, {{2.1, 1.0}}).modes[0];
    const auto& f = mode.natural_frequency;
    const auto& zeta = mode.damping_ratio;
    frequency_square += std::pow(f.value - natural / two_pi, 2) / trials;
    damping_square += std::pow(zeta.value - slow.decay_rate / natural, 2) / trials;
    said_frequency += std::pow(f.standard_uncertainty, 2) / trials;
    said_damping += std::pow(zeta.standard_uncertainty, 2) / trials;
    frequency_covered += f.lower <= natural / two_pi && natural / two_pi <= f.upper ? 1 : 0;
    damping_covered +=
        zeta.lower <= slow.decay_rate / natural && slow.decay_rate / natural <= zeta.upper ? 1 : 0;
  }
  EXPECT_NEAR(std::sqrt(said_frequency / frequency_square), 1.0, 0.2);
  EXPECT_NEAR(std::sqrt(said_damping / damping_square), 1.0, 0.2);
  EXPECT_GE(frequency_covered, trials * 91 / 100);
  EXPECT_GE(damping_covered, trials * 91 / 100);
  EXPECT_LE(frequency_covered, trials * 99 / 100);
  double moment = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double t = dt * i;
    moment += t * t * std::exp(-2.0 * slow.decay_rate * t);
  }
  const double bound = 0.01 / (1.25 * moment) / (two_pi * two_pi);
  EXPECT_GT(frequency_square, 0.9 * bound);
  EXPECT_LT(frequency_square, 12.0 * bound);
}

TEST(FitDampedCosines, SlowContentIsTakenOutNotMistaken) {
  const RingPole line{40.0, 2.0};
  VectorXd x = ring(400, line, {1.0, 0.0});
  for (Index i = 0; i < 400; ++i) {
    const double t = dt * static_cast<double>(i);
    x(i) += 30.0 * std::exp(-1.5 * t) * std::cos(two_pi * 1.3 * t) + 4.0 * std::cos(9.0 * t * t);
  }
  RingFitOptions options;
  options.low_frequency_limit = 20.0;
  const auto starts = ring_starts(x, dt, 1, 25.0, 60.0, options);
  ASSERT_EQ(starts.size(), 1U);
  const auto fit = fit_damped_cosines(x, dt, starts, options);
  EXPECT_NEAR(fit.modes[0].pole.damped_frequency, 40.0, 1e-2);
  EXPECT_NEAR(fit.modes[0].pole.decay_rate, 2.0, 0.15);
}

TEST(FitDampedCosines, AFixedPoleTakesItsShare) {
  const RingPole other{2.6, 0.8};
  const VectorXd x = ring(400, slow, {1.0, 0.0}) + ring(400, other, {0.7, 0.2});
  RingFitOptions options;
  options.fixed_poles = {other};
  const auto fit = fit_damped_cosines(x, dt, {{2.1, 1.0}}, options);
  EXPECT_NEAR(fit.modes[0].pole.damped_frequency, slow.damped_frequency, 1e-7);
  const auto alone = fit_damped_cosines(x, dt, {{2.1, 1.0}});
  EXPECT_GT(std::abs(alone.modes[0].pole.damped_frequency - slow.damped_frequency), 1e-2);
}

TEST(FitDampedCosines, CorrelatedNoiseWidensTheInterval) {
  // Noise in a band about the mode: as much power as white noise, a tenth of its bandwidth.
  const MatrixXd white = noise(600, 1, 77);
  VectorXd coloured = VectorXd::Zero(600);
  for (Index i = 2; i < 600; ++i) {
    coloured(i) = 2.0 * 0.97 * std::cos(two_pi * 2.3 * dt) * coloured(i - 1) -
                  0.97 * 0.97 * coloured(i - 2) + white(i, 0);
  }
  coloured *= white.norm() / coloured.norm();
  const VectorXd signal = ring(600, {2.2, 0.3}, {1.0, 0.0});
  const auto in_white = fit_damped_cosines(signal + 0.1 * white, dt, {{2.2, 0.3}});
  const auto in_coloured = fit_damped_cosines(signal + 0.1 * coloured, dt, {{2.2, 0.3}});
  EXPECT_GT(in_coloured.modes[0].natural_frequency.standard_uncertainty,
            2.0 * in_white.modes[0].natural_frequency.standard_uncertainty);
}

TEST(RingStarts, FindsTheStrongestFirst) {
  const RingPole third{7.0, 3.0};
  const VectorXd x = ring(600, slow, {1.0, 0.0}) + ring(600, fast, {3.0, 0.2}) +
                     ring(600, third, {4.0, 0.0}) + 0.05 * noise(600, 1, 3);
  const auto starts = ring_starts(x, dt, 3, 1.0, 20.0);
  ASSERT_EQ(starts.size(), 3U);
  EXPECT_NEAR(starts[0].damped_frequency, 3.1, 0.05);
  EXPECT_NEAR(starts[1].damped_frequency, 7.0, 0.1);
  EXPECT_NEAR(starts[2].damped_frequency, 2.2, 0.05);
  const auto band = ring_starts(x, dt, 1, 6.0, 9.0);
  ASSERT_EQ(band.size(), 1U);
  EXPECT_NEAR(band[0].damped_frequency, 7.0, 0.5);
}

TEST(FitDampedCosines, RefusesWhatItCannotFit) {
  const MatrixXd x = ring(400, slow, {1.0, 0.0});
  const auto refused = [](const MatrixXd& signal, double step, const std::vector<RingPole>& starts,
                          const char* message) {
    EXPECT_THAT(reference::Call([&] { fit_damped_cosines(signal, step, starts); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused(x, dt, {}, "found 0 starts and 400 samples");
  refused(x.topRows(15), dt, {slow}, "found 1 starts and 15 samples for 4 coefficients");
  refused(x, 0.0, {slow}, "expected a positive sample time, found 0 s");
  refused(x, dt, {{200.0, 1.0}}, "expected poles between 0 and 100 Hz");
  refused(x, dt, {{2.0, -1.0}}, "that do not grow, found 2 Hz, decay -1 1/s");
  refused(MatrixXd(400, 0), dt, {slow}, "found 0 channels");
  refused(MatrixXd::Constant(400, 1, INFINITY), dt, {slow}, "not all finite");
  EXPECT_THAT(reference::Call([&] { ring_starts(x, dt, 1, 5.0, 2.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 5 .. 2 Hz and 1")));
}

TEST(FitDampedCosines, ASilentChannelIsNoReasonToFail) {
  MatrixXd x(400, 2);
  x.col(0) = ring(400, slow, {1.0, 0.0}) + 0.01 * noise(400, 1, 9);
  x.col(1).setConstant(4.0);
  const auto fit = fit_damped_cosines(x, dt, {{2.1, 1.0}});
  EXPECT_NEAR(fit.modes[0].pole.damped_frequency, slow.damped_frequency, 0.01);
  EXPECT_NEAR(std::abs(fit.modes[0].amplitude(1)), 0.0, 1e-9);
}

}  // namespace
}  // namespace boresight::identification
