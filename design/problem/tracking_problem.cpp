#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::design {
Eigen::ArrayXd motor_wind_spectrum(const WindCondition& wind, double gear_ratio,
                                   const Eigen::ArrayXd& frequency) {
  return frequency.unaryExpr([&](double w) {
    return plant::wind_torque_spectrum(wind.site, wind.model, wind.mean_speed, w / two_pi) /
           (gear_ratio * gear_ratio);
  });
}

Eigen::ArrayXd motor_wind_spectrum(const TrackingProblem& problem,
                                   const Eigen::ArrayXd& frequency) {
  if (problem.climate.empty()) {
    return motor_wind_spectrum(problem.wind, problem.gear_ratio, frequency);
  }
  double sum = 0.0;
  Eigen::ArrayXd spectrum = Eigen::ArrayXd::Zero(frequency.size());
  for (const auto& [wind, weight] : problem.climate) {
    if (!(weight >= 0.0)) {
      throw InvalidInput(
          fmt::format("wind climate: expected weights of 0 or more, found {:g}", weight));
    }
    sum += weight;
    if (weight > 0.0) {
      spectrum += weight * motor_wind_spectrum(wind, problem.gear_ratio, frequency);
    }
  }
  if (!(std::abs(sum - 1.0) < 1e-9)) {
    throw InvalidInput(
        fmt::format("wind climate: expected weights that sum to 1, found {:.12g}", sum));
  }
  return spectrum;
}

control::FrequencyBand analysis_band(const TrackingProblem& problem) {
  const double valve = problem.plant.drive.valve_corner / two_pi;
  return {std::min(problem.rms_band.lowest, 1e-4),
          std::max({problem.rms_band.highest, 25.0, 8.0 * valve})};
}

Eigen::ArrayXd analysis_grid(const TrackingProblem& problem) {
  const control::FrequencyBand band = analysis_band(problem);
  const Eigen::ArrayXd grid =
      plant::frequency_grid(problem.plant, band.lowest, band.highest, problem.points_per_decade);
  std::vector<double> points(grid.begin(), grid.end());
  for (const double edge :
       {problem.rms_band.lowest, problem.rms_band.highest, problem.noise.bandwidth}) {
    const double w = two_pi * edge;
    const auto next = std::lower_bound(points.begin(), points.end(), w * (1.0 - 1e-9));
    if (next == points.begin() || next == points.end() || *next < w * (1.0 + 1e-9)) continue;
    points.insert(next, w);
  }
  return Eigen::Map<Eigen::ArrayXd>(points.data(), static_cast<Eigen::Index>(points.size()));
}

WindTable::WindTable(const TrackingProblem& problem) {
  const control::FrequencyBand band = analysis_band(problem);
  constexpr double points_per_decade = 60.0;
  first_ = std::log(two_pi * band.lowest);
  const double width = std::log(band.highest / band.lowest);
  const auto intervals =
      static_cast<Eigen::Index>(std::ceil(points_per_decade * width / std::numbers::ln10)) + 3;
  step_ = width / static_cast<double>(intervals);
  log_spectrum_ =
      motor_wind_spectrum(problem,
                          Eigen::ArrayXd::LinSpaced(intervals + 1, first_, first_ + width).exp())
          .log();
}

double WindTable::spectrum(double frequency) const {
  const double place = (std::log(frequency) - first_) / step_;
  const auto left = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(place)) - 1, 0,
                                             log_spectrum_.size() - 4);
  // Lagrange's polynomial through four points, at 0, 1, 2, 3.
  const double t = place - static_cast<double>(left);
  const double t1 = t - 1.0, t2 = t - 2.0, t3 = t - 3.0;
  const auto y = log_spectrum_.segment<4>(left);
  return std::exp(-t1 * t2 * t3 / 6.0 * y[0] + t * t2 * t3 / 2.0 * y[1] - t * t1 * t3 / 2.0 * y[2] +
                  t * t1 * t2 / 6.0 * y[3]);
}

control::LoopEvaluator make_evaluator(const TrackingProblem& problem) {
  const Eigen::ArrayXd frequency = analysis_grid(problem);
  return {problem.plant,
          frequency,
          {.delay = problem.delay,
           .noise = problem.noise,
           .wind_spectrum = motor_wind_spectrum(problem, frequency),
           .band = problem.rms_band}};
}

control::LoopEvaluator make_adaptive_evaluator(const TrackingProblem& problem,
                                               const WindTable& wind, double tolerance) {
  return {
      plant::PointResponse(problem.plant),
      {.delay = problem.delay,
       .noise = problem.noise,
       .wind_spectrum = [wind](double hertz) { return wind.spectrum(two_pi * hertz); },
       .quadrature = {
           .analysis = analysis_band(problem), .band = problem.rms_band, .tolerance = tolerance}}};
}

plant::ShapingFilter fit_wind_filter(const WindCondition& wind, double gear_ratio) {
  TrackingProblem problem;
  problem.wind = wind;
  problem.gear_ratio = gear_ratio;
  return fit_wind_filter(problem);
}

plant::ShapingFilter fit_wind_filter(const TrackingProblem& problem) {
  constexpr Eigen::Index points = 200;
  const Eigen::ArrayXd frequency =
      Eigen::ArrayXd::LinSpaced(points, std::log(5e-4), std::log(5.0)).exp();
  return plant::fit_shaping_filter(frequency, motor_wind_spectrum(problem, two_pi * frequency), 6);
}

double boresight_rms_at_speed(const TrackingProblem& problem,
                              const control::LoopEvaluator& evaluator,
                              const Eigen::ArrayXd& wind_transmission, double noise_variance,
                              double mean_speed) {
  WindCondition wind = problem.wind;
  wind.mean_speed = mean_speed;
  const Eigen::ArrayXd spectrum =
      motor_wind_spectrum(wind, problem.gear_ratio, evaluator.response().frequency);
  const double variance =
      (evaluator.integration_weight() * wind_transmission * spectrum).sum() + noise_variance;
  return std::sqrt(variance) / problem.gear_ratio;
}

double wind_speed_limit(const TrackingProblem& problem, const control::LoopEvaluator& evaluator,
                        const control::Controller& controller, double noise_variance,
                        double rms_budget) {
  const Eigen::ArrayXd transmission = evaluator.wind_transmission(controller);
  const auto rms = [&](double speed) {
    return boresight_rms_at_speed(problem, evaluator, transmission, noise_variance, speed);
  };
  double low = 0.1, high = 60.0;
  if (rms(low) >= rms_budget) return 0.0;
  if (rms(high) <= rms_budget) return std::numeric_limits<double>::infinity();
  // The rms rises with speed nearly as its square: regula falsi in logarithms, safeguarded.
  double log_low = std::log(rms(low) / rms_budget), log_high = std::log(rms(high) / rms_budget);
  while (std::log(high / low) > 1e-5) {
    double fraction = log_low / (log_low - log_high);
    fraction = std::min(std::max(fraction, 0.02), 0.98);
    const double middle = low * std::pow(high / low, fraction);
    const double value = std::log(rms(middle) / rms_budget);
    if (std::abs(value) < 1e-7) return middle;
    if (value < 0.0) {
      low = middle;
      log_low = value;
    } else {
      high = middle;
      log_high = value;
    }
  }
  return std::sqrt(low * high);
}

}  // namespace boresight::design
