#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <boresight/app/figures/controller_figures.hpp>
#include <boresight/app/figures/ensemble_figures.hpp>
#include <boresight/app/figures/frequency_curves.hpp>
#include <boresight/app/figures/open_loop_figures.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::app {
namespace {

Figure sensitivity_figure(const DrawnController& drawn, const ControllerResponses& on_grid) {
  Figure figure = controller_figure(drawn, "sensitivity", "Sensitivity and wind torque spectrum");
  figure.caption = fmt::format(
      "Magnitude of 1/(1 + L) {} with its limit. Below: wind torque spectrum times frequency; "
      "equal areas are equal fractions of the torque variance. {}",
      at_breaks(drawn), controller_conditions(drawn));
  figure.panels.resize(2);
  FigurePanel& sensitivity = figure.panels[0];
  sensitivity.y = {.label = "|S|", .scale = AxisScale::logarithmic, .lowest = 1e-3};
  const std::vector<double> hertz = in_hertz(on_grid.frequency);
  std::vector<double> goals;
  for (const std::size_t b : shown_breaks(drawn)) {
    goals.push_back(drawn.goals.sensitivity_peak.at(b));
    const auto& gain = on_grid.gain.at(b);
    sensitivity.series.push_back(
        {.name = break_name(b), .x = hertz, .y = numbers((1.0 + gain).abs().inverse())});
    const auto& peak = drawn.margins.at(b).sensitivity;
    if (!(peak.frequency > 0.0) || !std::isfinite(peak.frequency)) continue;
    sensitivity.marks.push_back(
        {peak.frequency / two_pi, peak.magnitude, fmt::format("{:.2f}", peak.magnitude)});
  }
  std::sort(goals.begin(), goals.end());
  goals.erase(std::unique(goals.begin(), goals.end()), goals.end());
  for (const double goal : goals) {
    sensitivity.lines.push_back(
        {FigureLine::Direction::horizontal, goal, fmt::format("at most {:g}", goal)});
  }
  FigurePanel& wind = figure.panels[1];
  wind.y = {.label = "wind torque about the axis: frequency \u00d7 spectrum",
            .unit = "kN\u00b2.m\u00b2"};
  const double to_axis = 1e-3 * drawn.problem.gear_ratio;
  const Eigen::ArrayXd spectrum = design::motor_wind_spectrum(drawn.problem, on_grid.frequency);
  wind.series.push_back(
      {.x = hertz, .y = numbers(to_axis * to_axis * spectrum * on_grid.frequency / two_pi)});
  return figure;
}

Figure rejection_figure(const DrawnController& drawn, const ControllerResponses& on_grid,
                        const Eigen::ArrayXd& transmission) {
  Figure figure =
      controller_figure(drawn, "wind-rejection", "Wind torque to boresight, loops open and closed");
  figure.caption =
      "Boresight angle at the sky per wind torque about the axis. With the encoder fixed, flexure "
      "beyond the encoder remains. " +
      controller_conditions(drawn);
  FigurePanel panel;
  panel.y = {.label = "boresight at the sky per torque about the axis",
             .unit = "mdeg/(kN.m)",
             .scale = AxisScale::logarithmic};
  const double scale = 1e3 / (millidegree * drawn.problem.gear_ratio * drawn.problem.gear_ratio);
  const std::vector<double> hertz = in_hertz(on_grid.frequency);
  const auto held = plant::structure_response(drawn.problem.plant.structure, on_grid.frequency);
  const Eigen::ArrayXd closed = scale * transmission.sqrt();
  panel.series.push_back({.name = "closed", .x = hertz, .y = numbers(closed)});
  panel.series.push_back(
      {.name = "open", .x = hertz, .y = numbers(scale * on_grid.plant.boresight_wind.abs())});
  panel.series.push_back({.name = "encoder fixed",
                          .style = SeriesStyle::dashed,
                          .x = hertz,
                          .y = numbers(scale * held.boresight_per_wind.abs())});
  // The open loop's rise to low frequencies would leave no room for the rest.
  Eigen::Index at = 0;
  const double largest = closed.maxCoeff(&at);
  panel.y.highest = 20.0 * largest;
  panel.y.lowest = std::max(1e-4 * largest, 0.3 * closed.minCoeff());
  panel.marks.push_back(
      {on_grid.frequency[at] / two_pi, largest,
       fmt::format("{:.3g} at {:.2f} Hz", largest, on_grid.frequency[at] / two_pi)});
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure error_figure(const DrawnController& drawn, const ControllerResponses& on_grid,
                    const Eigen::ArrayXd& transmission) {
  Figure figure = controller_figure(drawn, "error-spectrum", "Boresight error spectrum in wind");
  const auto& band = drawn.problem.rms_band;
  std::vector<double> hertz, density, cumulative;
  const Eigen::ArrayXd spectrum = transmission *
                                  design::motor_wind_spectrum(drawn.problem, on_grid.frequency) /
                                  std::pow(drawn.problem.gear_ratio * millidegree, 2);
  // Trapezoids in ln f: the integrand is f times the density.
  double variance = 0.0;
  for (Eigen::Index i = 0; i < spectrum.size(); ++i) {
    const double f = on_grid.frequency[i] / two_pi;
    if (f < band.lowest * (1.0 - 1e-9) || f > band.highest * (1.0 + 1e-9)) continue;
    if (!hertz.empty()) {
      variance += 0.5 * (f * spectrum[i] + hertz.back() * density.back() * density.back()) *
                  std::log(f / hertz.back());
    }
    hertz.push_back(f);
    density.push_back(std::sqrt(spectrum[i]));
    cumulative.push_back(std::sqrt(variance));
  }
  const double noise = std::sqrt(drawn.noise_variance) / (drawn.problem.gear_ratio * millidegree);
  figure.caption = fmt::format(
      "Amplitude density of the boresight error from wind, and its cumulative rms, {:.4f} mdeg in "
      "total. Sensor noise adds {:.4f} mdeg (root sum of squares). {}",
      std::sqrt(variance), noise, controller_conditions(drawn));
  figure.panels.resize(2);
  figure.panels[0].y = {.label = "boresight error from wind",
                        .unit = "mdeg/\u221aHz",
                        .scale = AxisScale::logarithmic};
  if (!density.empty()) {
    figure.panels[0].y.lowest = 1e-4 * *std::max_element(density.begin(), density.end());
  }
  figure.panels[0].series.push_back({.x = hertz, .y = density});
  figure.panels[1].y = {.label = "rms up to this frequency", .unit = "mdeg"};
  figure.panels[1].series.push_back({.x = hertz, .y = cumulative});
  return figure;
}

FigureSeries rms_over_ensemble(const ComparedController& controller,
                               const design::EnsembleCurves& curves) {
  const auto drawn = [effect = controller.drawn()](const Eigen::ArrayXd& linear) {
    return numbers(linear.unaryExpr([&](double rms) { return effect.rms(rms) / millidegree; }));
  };
  FigureSeries series{.name = controller.name};
  series.x = numbers(curves.wind_speed);
  series.y = drawn(curves.boresight_rms.nominal);
  series.y_lower = drawn(curves.boresight_rms.lower);
  series.y_upper = drawn(curves.boresight_rms.upper);
  return series;
}

}  // namespace

std::vector<Figure> controller_figures(const DrawnController& drawn) {
  const ControllerResponses on_grid = controller_responses(drawn);
  const control::LoopEvaluator evaluator(
      drawn.problem.plant, on_grid.frequency,
      {.delay = drawn.problem.delay,
       .noise = drawn.problem.noise,
       .wind_spectrum = Eigen::ArrayXd::Zero(on_grid.frequency.size())});
  const Eigen::ArrayXd transmission = evaluator.wind_transmission(drawn.controller);
  std::vector<Figure> figures{open_loop_figure(drawn, on_grid),
                              nyquist_figure(drawn, on_grid),
                              nichols_figure(drawn, on_grid),
                              sensitivity_figure(drawn, on_grid),
                              rejection_figure(drawn, on_grid, transmission),
                              error_figure(drawn, on_grid, transmission)};
  std::ranges::move(ensemble_figures(drawn), std::back_inserter(figures));
  return figures;
}

Figure rms_against_wind(const std::string& id, const std::string& section,
                        const design::TrackingProblem& problem,
                        const std::vector<ComparedController>& controllers,
                        const std::vector<design::PointingBudget>& budgets,
                        const std::optional<design::EnsembleCurves>& curves) {
  Figure figure;
  figure.id = id;
  figure.section = section;
  figure.title = "Boresight rms against wind speed";
  figure.caption = fmt::format(
      "Boresight rms per axis, fixed gains. Lines: budgets of each band; circles: wind speeds up "
      "to which {} meets them. Wind model {}, linear plant with friction {:g} N.m.s/rad{}. Limits "
      "of supply and valve are not included.{}",
      controllers.empty() ? "a controller" : controllers.front().name,
      plant::to_string(problem.wind.model), problem.plant.drive.viscous_friction,
      std::ranges::any_of(controllers, &ComparedController::simulated)
          ? ", by what the simulation of each controller that ran adds, limit cycle included"
          : "",
      curves && !controllers.empty()
          ? fmt::format(" Band: {}, {}.", controllers.front().name, range_name(*curves))
          : "");
  figure.x = {.label = "mean wind speed", .unit = "m/s"};
  FigurePanel panel;
  panel.y = {.label = "boresight rms", .unit = "mdeg"};
  double largest = 0.0;
  for (const auto& budget : budgets) {
    const double rms = budget.rms / millidegree;
    largest = std::max(largest, rms);
    panel.lines.push_back(
        {FigureLine::Direction::horizontal, rms, fmt::format("{}, {}", budget.band, budget.name)});
  }
  const control::LoopEvaluator evaluator = design::make_evaluator(problem);
  std::vector<double> limits;
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    for (const auto& budget : budgets) {
      const double limit =
          design::budget_speeds(problem, evaluator, controllers[i].controller,
                                controllers[i].noise_variance, {budget}, controllers[i].drawn())
              .front();
      limits.push_back(limit);
      if (i > 0 || !(limit > 0.0) || !std::isfinite(limit)) continue;
      panel.marks.push_back({limit, budget.rms / millidegree, fmt::format("{:.1f} m/s", limit)});
    }
  }
  const double fastest = design::highest_compared_speed(problem.wind.mean_speed, limits);
  for (const auto& controller : controllers) {
    if (curves && panel.series.empty()) {
      panel.series.push_back(rms_over_ensemble(controller, *curves));
      continue;
    }
    FigureSeries series{.name = controller.name};
    const Eigen::ArrayXd transmission = evaluator.wind_transmission(controller.controller);
    constexpr int points = 60;
    for (int i = 1; i <= points; ++i) {
      const double speed = fastest * i / points;
      series.x.push_back(speed);
      const double linear = design::boresight_rms_at_speed(problem, evaluator, transmission,
                                                           controller.noise_variance, speed);
      series.y.push_back(controller.drawn().rms(linear) / millidegree);
    }
    panel.series.push_back(std::move(series));
  }
  if (largest > 0.0) panel.y.highest = 1.6 * largest;
  panel.y.lowest = 0.0;
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure compared_sensitivities(const std::string& id, const std::string& section,
                              const design::TrackingProblem& problem,
                              const std::vector<ComparedController>& controllers,
                              control::LoopBreak loop_break, double goal) {
  Figure figure;
  figure.id = id;
  figure.section = section;
  figure.title = fmt::format("Sensitivity of the candidates, {}", control::to_string(loop_break));
  figure.caption = fmt::format(
      "Magnitude of 1/(1 + L) with the loop broken at the {}, nominal linear plant, friction {:g} "
      "N.m.s/rad.",
      control::to_string(loop_break), problem.plant.drive.viscous_friction);
  figure.x = shown_frequencies(problem);
  FigurePanel panel;
  panel.y = {.label = "|S|", .scale = AxisScale::logarithmic, .lowest = 1e-3};
  for (const auto& controller : controllers) {
    const Eigen::ArrayXd frequency = controller_grid(problem, controller.controller);
    const auto response = plant::plant_response(problem.plant, frequency);
    FigureSeries series{.name = controller.name, .x = in_hertz(frequency)};
    for (Eigen::Index i = 0; i < frequency.size(); ++i) {
      const auto gain = control::loop_gain(plant::point(response, i), frequency[i],
                                           controller.controller, problem.delay, loop_break);
      series.y.push_back(1.0 / std::abs(1.0 + gain));
    }
    panel.series.push_back(std::move(series));
  }
  panel.lines.push_back(
      {FigureLine::Direction::horizontal, goal, fmt::format("at most {:g}", goal)});
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace boresight::app
