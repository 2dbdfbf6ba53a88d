#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_stable_system.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

plant::ModalResponse response_of(const plant::StateSpace& system) {
  return {plant::without_modes(system), system.inputs.front(), system.outputs.front()};
}

double lyapunov_rms_of(const plant::StateSpace& system) {
  const auto solution = solve_lyapunov(system.a, system.b * system.b.transpose());
  return std::sqrt((system.c * solution.covariance * system.c.transpose())(0, 0));
}

TEST(SpectralRms, OfFiltersIsTheTextbooks) {
  // a/(s + a): sqrt(a/2); w^2/(s^2 + 2 z w s + w^2): sqrt(w/(4 z)).
  for (const double a : {1e-3, 1.0, 400.0}) {
    const auto found = spectral_rms(response_of(plant::rational({a}, {a, 1.0}, "n", "y", "lag")));
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.rms / std::sqrt(0.5 * a), 1.0, 1e-8);
  }
  for (const double zeta : {0.7, 0.05, 1e-3, 1e-5}) {
    const double w = 7.0;
    const auto found = spectral_rms(
        response_of(plant::rational({w * w}, {w * w, 2.0 * zeta * w, 1.0}, "n", "y", "mode")));
    EXPECT_TRUE(found.converged) << zeta;
    EXPECT_NEAR(found.rms / std::sqrt(0.25 * w / zeta), 1.0, 1e-8) << zeta;
  }
}

TEST(SpectralRms, IsThatOfLyapunovsEquation) {
  reference::RandomNumbers random(77);
  reference::RandomSystemOptions options;
  options.feedthrough = false;
  options.max_modes = 6;
  for (int trial = 0; trial < 300; ++trial) {
    const auto system = reference::random_stable_system(random, options);
    const double expected = lyapunov_rms_of(system);
    const auto found = spectral_rms(response_of(system));
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.rms / expected, 1.0, 1e-7) << trial;
    EXPECT_LT(std::abs(found.rms / expected - 1.0), 10.0 * found.relative_error + 1e-9) << trial;
  }
}

TEST(SpectralRms, OfThePeersAntennaIsTheirs) {
  // tests/data/reference/peers.json
  for (const auto& [modes, expected] :
       {std::pair{5, 4.592146616495374}, std::pair{50, 4.030601322090755},
        std::pair{500, 3.995275463497042}}) {
    const plant::ModalResponse response(reference::peer_modal_system(modes), "n", "y");
    EXPECT_NEAR(spectral_rms(response).rms / expected, 1.0, 1e-10);
    SpectralRmsOptions coarse;
    coarse.relative_tolerance = 1e-6;
    const auto quick = spectral_rms(response, coarse);
    EXPECT_NEAR(quick.rms / expected, 1.0, 1e-6);
    EXPECT_LT(quick.evaluations, 2500U);
  }
}

TEST(SpectralRms, WithASpectrumIsThatOfItsFilter) {
  // Noise through 3/(s + 3), as part of the system and as a spectrum 2 |G|^2.
  const auto loop = plant::rational({2.0, 1.0}, {2.0, 0.3, 1.0}, "v", "y", "loop");
  const auto filter = plant::rational({3.0}, {3.0, 1.0}, "n", "v", "filter");
  SpectralRmsOptions options;
  options.spectrum = [](double frequency) {
    const double w = 2.0 * std::numbers::pi * frequency;
    return 2.0 * 9.0 / (9.0 + w * w);
  };
  EXPECT_NEAR(spectral_rms(response_of(loop), options).rms /
                  lyapunov_rms_of(plant::connect({filter, loop}, {"n"}, {"y"})),
              1.0, 1e-8);
}

TEST(SpectralRms, WithDeadTimeIsThatOfTheClosedForm) {
  // dx = -k x(t - d) + n: variance (1 + sin k d)/(2 k cos k d) (U. Kuechler, B. Mensch,
  // Stochastics 40, 1992).
  const double k = 2.0, delay = 0.4;
  plant::ModalSystem system;
  system.core.a = Eigen::MatrixXd::Zero(1, 1);
  system.core.b.resize(1, 2);
  system.core.b << 1.0, -k;
  system.core.c = Eigen::MatrixXd::Ones(1, 1);
  system.core.d = Eigen::MatrixXd::Zero(1, 2);
  system.core.inputs = {"n", "late"};
  system.core.outputs = {"x"};
  system.core.states = {"x"};
  system.modes.force_shape.resize(0, 0);
  system.modes.displacement_shape.resize(0, 0);
  system.dead_times = {{"x", "late", delay}};
  system.inputs = {"n"};
  system.outputs = {"x"};
  const auto found = spectral_rms({system, "n", "x"});
  const double expected = std::sqrt((1.0 + std::sin(k * delay)) / (2.0 * k * std::cos(k * delay)));
  EXPECT_NEAR(found.rms / expected, 1.0, 1e-8);
}

TEST(SpectralRms, OfWhatHasNoneIsRefused) {
  EXPECT_THAT(reference::Call([] {
                spectral_rms(response_of(plant::rational({1.0, 0.1}, {1.0, 1.0}, "n", "y", "x")));
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("a response that falls off")));
  EXPECT_THAT(reference::Call([] {
                spectral_rms(response_of(plant::rational({1.0}, {1.0, 1.0}, "n", "y", "x")),
                             SpectralRmsOptions{1e-20, 100, {}});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 1e-20")));
  // Nothing at all has an rms of 0.
  const auto none = spectral_rms(response_of(plant::rational({0.0}, {1.0, 1.0}, "n", "y", "x")));
  EXPECT_EQ(none.rms, 0.0);
  EXPECT_TRUE(none.converged);
  // Too few evaluations: the estimate says so.
  SpectralRmsOptions few;
  few.max_evaluations = 10;
  few.relative_tolerance = 1e-12;
  const auto open =
      spectral_rms(response_of(plant::rational({1.0}, {1.0, 1e-4, 1.0}, "n", "y", "x")), few);
  EXPECT_FALSE(open.converged);
  EXPECT_GT(open.relative_error, 1e-12);
}

}  // namespace
}  // namespace boresight::control
