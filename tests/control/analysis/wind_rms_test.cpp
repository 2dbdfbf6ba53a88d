#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/wind/wind_filter.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::control {
namespace {

constexpr double speed = 10.0;

// From wind torque to pointing error up to a factor: a loop of a bandwidth (Hz) that holds steady
// torques off, w^2 s/(s^2 + 2 z w s + w^2).
plant::StateSpace loop(double bandwidth) {
  const double w = two_pi * bandwidth;
  return plant::rational({0.0, w * w}, {w * w, 2.0 * 0.5 * w, 1.0}, "wind_torque", "error", "loop");
}

double spectrum(const plant::WindSite& site, plant::WindModel model, double frequency) {
  return plant::wind_torque_spectrum(site, model, speed, frequency);
}

// rms of the error by the spectrum itself.
double spectral(const plant::StateSpace& system, const plant::WindSite& site,
                plant::WindModel model) {
  SpectralRmsOptions options;
  options.spectrum = [&](double f) { return spectrum(site, model, f); };
  const plant::ModalResponse response(plant::without_modes(system), "wind_torque", "error");
  const SpectralRms found = spectral_rms(response, options);
  EXPECT_TRUE(found.converged);
  return found.rms;
}

// rms of the error with white noise through the shaping filter.
double lyapunov(const plant::StateSpace& system, const plant::WindSite& site,
                plant::WindModel model, int order) {
  const Eigen::ArrayXd f = Eigen::ArrayXd::LinSpaced(200, std::log(5e-4), std::log(5.0)).exp();
  const plant::ShapingFilter filter = plant::fit_shaping_filter(
      f, f.unaryExpr([&](double x) { return spectrum(site, model, x); }), order);
  const plant::StateSpace whole = plant::connect(
      {plant::to_state_space(filter, "wind_torque"), system}, {"white_noise"}, {"error"});
  const auto covariance = solve_lyapunov(whole.a, whole.b * whole.b.transpose()).covariance;
  return std::sqrt((whole.c * covariance * whole.c.transpose())(0, 0));
}

std::vector<plant::WindSite> sites() {
  std::vector<plant::WindSite> all(4, reference::wind_site());
  all[1].gusts = plant::von_karman_gusts(0.16, 111.0);
  all[2].gusts = plant::kaimal_gusts(0.16, 37.0);
  all[3].gusts = plant::eurocode_gusts(37.0, 0.05, 2.0);
  return all;
}

constexpr plant::WindModel models[] = {plant::WindModel::uniform, plant::WindModel::vickery,
                                       plant::WindModel::coherence};

TEST(WindRms, ThroughTheShapingFilterIsThatOfTheSpectrum) {
  for (const auto& site : sites()) {
    for (const plant::WindModel model : models) {
      for (const double bandwidth : {0.05, 0.15, 0.5}) {
        const plant::StateSpace system = loop(bandwidth);
        const double expected = spectral(system, site, model);
        EXPECT_NEAR(lyapunov(system, site, model, 6) / expected, 1.0, 2e-3)
            << to_string(site_gusts(site).kind) << " " << to_string(model) << " " << bandwidth;
        // Four real poles turn Vickery's steep corner too slowly.
        const double tolerance = model == plant::WindModel::vickery ? 0.035 : 5e-3;
        EXPECT_NEAR(lyapunov(system, site, model, 4) / expected, 1.0, tolerance)
            << to_string(site_gusts(site).kind) << " " << to_string(model) << " " << bandwidth;
      }
    }
  }
}

TEST(WindRms, OfASynthesisedTorqueIsThatOfTheShapingFilter) {
  const double duration = 3600.0, step = 0.125;
  constexpr int seeds = 6;
  constexpr Eigen::Index settling = 800;
  for (const auto& site : sites()) {
    const plant::StateSpace system = loop(0.15);
    const plant::WindModel model = plant::WindModel::coherence;
    const plant::StationarySeries torque =
        plant::wind_torque_series(site, model, plant::WindTorquePart::both, speed, duration, step);
    double variance = 0.0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      plant::LinearSimulation simulation(system, step,
                                         {.interpolation = plant::Interpolation::first_order_hold});
      const Eigen::MatrixXd error = simulation.simulate(torque.draw(seed));
      const auto settled = error.bottomRows(error.rows() - settling);
      variance += settled.squaredNorm() / static_cast<double>(settled.rows() * seeds);
    }
    // The standard error of the variance: sqrt(integral of S^2 df / (T seeds)).
    double squares = 0.0;
    const double ratio = 1.002;
    for (double f = 1e-4; f < 4.0; f *= ratio) {
      const double gain = std::norm(plant::frequency_response(system, two_pi * f)(0, 0));
      squares += std::pow(gain * spectrum(site, model, f), 2) * f * (ratio - 1.0);
    }
    const double deviation = std::sqrt(squares / (duration * seeds));
    const double expected = std::pow(lyapunov(system, site, model, 6), 2);
    EXPECT_LT(deviation, 0.04 * expected);
    EXPECT_NEAR(variance, expected, 3.0 * deviation) << to_string(site_gusts(site).kind);
  }
}

}  // namespace
}  // namespace boresight::control
