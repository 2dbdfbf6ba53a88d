// Position errors of the reference antenna in wind, and what a mast beside it measures.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "design/reference_problem.hpp"
#include <boresight/design/commissioning/wind_comparison.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::reference {

/// Records of ten minutes, from the linear closed loop in time; of the reference antenna by
/// default.
class SimulatedErrors {
 public:
  static constexpr double sample_time = 0.1, duration = 600.0, settling = 60.0;  // s
  /// m from the dish: gusts there are the dish's own with the coherence exp(-c f r/V).
  static constexpr double mast_distance = 50.0;

  explicit SimulatedErrors(const control::Controller& controller,
                           const design::TrackingProblem& problem = tracking_problem())
      : problem_(problem),
        loop_(control::closed_loop(problem_.plant, controller, problem_.delay)),
        simulation_(loop_, sample_time, {.interpolation = plant::Interpolation::first_order_hold}) {
  }

  /// A record in wind of that mean speed (m/s), whose gusts are `gustiness` times the usual.
  design::WindyRecord record(double mean_speed, std::uint64_t seed, double gustiness = 1.0) {
    const Winds& wind = winds(mean_speed);
    const auto samples = wind.torque.samples();
    const auto skipped = static_cast<Eigen::Index>(std::lround(settling / sample_time));
    Eigen::MatrixXd input =
        Eigen::MatrixXd::Zero(samples, static_cast<Eigen::Index>(loop_.inputs.size()));
    input.col(plant::input_index(loop_, "wind_torque")) =
        gustiness / problem_.gear_ratio * (wind.torque.draw(seed, 0) + wind.gradient.draw(seed, 1));
    // White noise of the sensors up to half the sampling rate.
    const double fraction = std::sqrt(0.5 / sample_time / problem_.noise.bandwidth);
    const numerics::NormalNumbers noise(seed, 3);
    for (Eigen::Index k = 0; k < samples; ++k) {
      const auto pair = noise.pair(static_cast<std::uint64_t>(k));
      input(k, plant::input_index(loop_, "encoder_noise")) =
          fraction * problem_.noise.encoder_rms * pair.real();
      input(k, plant::input_index(loop_, "tachometer_noise")) =
          fraction * problem_.noise.tachometer_rms * pair.imag();
    }
    simulation_.start_from(Eigen::VectorXd::Zero(loop_.a.rows()));
    const Eigen::MatrixXd output = simulation_.simulate(input);
    const Eigen::VectorXd gust =
        gustiness * (wind.shared_gust.draw(seed, 0) + wind.own_gust.draw(seed, 2));
    design::WindyRecord result;
    result.sample_time = sample_time;
    result.error.values = output.col(plant::output_index(loop_, "beam")).tail(samples - skipped) /
                          problem_.gear_ratio;
    result.wind_speed.values =
        (mean_speed + gust.tail(samples - skipped).array()).cwiseMax(0.0).matrix();
    return result;
  }

  /// Boresight rms (rad at the sky) at that speed from `lowest` to `highest` (Hz), as computed.
  double expected_rms(const control::Controller& controller, double mean_speed, double lowest,
                      double highest) const {
    design::TrackingProblem problem = problem_;
    problem.wind.mean_speed = mean_speed;
    problem.rms_band = {lowest, highest};
    const auto evaluation = design::make_evaluator(problem).evaluate(controller, false);
    return std::sqrt(evaluation.boresight_variance()) / problem_.gear_ratio;
  }

 private:
  struct Winds {
    plant::StationarySeries torque, gradient, shared_gust, own_gust;
  };

  const Winds& winds(double mean_speed) {
    const auto found = winds_.find(mean_speed);
    if (found != winds_.end()) return found->second;
    const auto& [site, model, unused] = problem_.wind;
    const double whole = duration + settling;
    const auto gusts = plant::site_gusts(site);
    const auto coherence = [&](double f) {
      return std::exp(-2.0 * site.coherence_decay * f * mast_distance / mean_speed);
    };
    const auto part = [&](plant::WindTorquePart which) {
      return plant::wind_torque_series(site, model, which, mean_speed, whole, sample_time);
    };
    return winds_
        .emplace(mean_speed,
                 Winds{part(plant::WindTorquePart::uniform), part(plant::WindTorquePart::gradient),
                       plant::StationarySeries(
                           [&](double f) {
                             return coherence(f) * plant::gust_spectrum(gusts, mean_speed, f);
                           },
                           whole, sample_time),
                       plant::StationarySeries(
                           [&](double f) {
                             return (1.0 - coherence(f)) *
                                    plant::gust_spectrum(gusts, mean_speed, f);
                           },
                           whole, sample_time)})
        .first->second;
  }

  design::TrackingProblem problem_;
  plant::StateSpace loop_;
  plant::LinearSimulation simulation_;
  std::map<double, Winds> winds_;
};

}  // namespace boresight::reference
