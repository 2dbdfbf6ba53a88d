#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/figures/block_diagram.hpp>
#include <boresight/app/figures/controller_figures.hpp>
#include <boresight/app/figures/error_budget_figures.hpp>
#include <boresight/app/figures/tune_figures.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/controllers_in_time.hpp>
#include <boresight/app/tune/tune_verdict.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t max_compared = 6;  // controllers in one panel
constexpr std::size_t valve = 1;         // of control::loop_breaks

std::string title_of(const TuneSection& section) {
  return fmt::format("Tuned loops: {}, wind model {}", fmt::join(section.structures, ", "),
                     plant::to_string(section.wind_model));
}

std::vector<std::string> all_structures(const TuneSection& section) {
  std::vector<std::string> names;
  for (const auto& controller : section.controllers) {
    if (std::find(names.begin(), names.end(), controller.structure) == names.end()) {
      names.push_back(controller.structure);
    }
  }
  return names;
}

Figure structures_figure(const TuneSection& section, double wind_speed,
                         const std::optional<TimeDomainSection>& in_time) {
  Figure figure;
  figure.id = "structures";
  figure.section = title_of(section);
  figure.title = "Comparison of loop structures";
  figure.caption = fmt::format(
      "Boresight rms in {:.3g} m/s, wind model {}, linear plant: present gains, tuned for the "
      "nominal plant, tuned to meet every constraint on {} plants ({}){}.",
      wind_speed, plant::to_string(section.wind_model), section.ensemble_size,
      to_string(section.ensemble_source),
      in_time ? "; last: simulated on the nonlinear antenna, limit cycle not included" : "");
  for (const auto& controller : section.controllers) {
    if (controller.wind_speed != wind_speed || controller.stable()) continue;
    figure.caption += fmt::format(
        " {} ({}) has no bar: {}.", controller.structure, to_string(controller.tuned_for),
        controller.tuned_for == TunedFor::present ? "the present gains are unstable on this plant"
                                                  : "no stable controller was found");
  }
  figure.x = {.label = "loop structure", .categories = all_structures(section)};
  const auto place_of = [&](const std::string& structure) {
    const auto& names = figure.x.categories;
    return static_cast<double>(std::find(names.begin(), names.end(), structure) - names.begin());
  };
  FigurePanel panel;
  panel.y = {.label = "boresight rms", .unit = "mdeg"};
  for (const auto purpose : {TunedFor::present, TunedFor::nominal, TunedFor::robust}) {
    FigureSeries bars{.name = std::string(to_string(purpose)), .style = SeriesStyle::bars};
    for (const auto& controller : section.controllers) {
      if (controller.tuned_for != purpose || controller.wind_speed != wind_speed ||
          !controller.stable())
        continue;
      bars.x.push_back(place_of(controller.structure));
      bars.y.push_back(controller.boresight_rms / millidegree);
    }
    if (!bars.x.empty()) panel.series.push_back(std::move(bars));
  }
  if (in_time && in_time->wind_speed == wind_speed) {
    FigureSeries bars{.name = "nonlinear antenna", .style = SeriesStyle::bars};
    const auto add = [&](const design::SimulatedCandidate& candidate) {
      for (const auto& controller : section.controllers) {
        if (description_of(controller) != candidate.controller ||
            controller.wind_speed != wind_speed)
          continue;
        bars.x.push_back(place_of(controller.structure));
        bars.y.push_back(candidate.simulated_rms() / millidegree);
      }
    };
    std::ranges::for_each(in_time->candidates, add);
    if (in_time->candidates.empty()) add(in_time->own());
    bars.name = fmt::format("{} on the nonlinear antenna",
                            in_time->controller.substr(in_time->controller.rfind(' ') + 1));
    if (!bars.x.empty()) panel.series.push_back(std::move(bars));
  }
  for (const auto& budget : section.budgets) {
    const double rms = budget.rms / millidegree;
    // Budgets far above every bar would press the bars down.
    const bool near =
        std::any_of(panel.series.begin(), panel.series.end(), [&](const FigureSeries& series) {
          return std::any_of(series.y.begin(), series.y.end(),
                             [&](double y) { return rms < 1.5 * y; });
        });
    if (!near) continue;
    panel.lines.push_back(
        {FigureLine::Direction::horizontal, rms, fmt::format("{}, {}", budget.band, budget.name)});
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::vector<ComparedController> compared_controllers(const TuneSection& section,
                                                     const TunedController& first) {
  const auto compared = [](const TunedController& controller) {
    return ComparedController{description_of(controller), controller.design.tuning.controller,
                              controller.design.tuning.evaluation.noise_variance,
                              controller.effect()};
  };
  std::vector<ComparedController> controllers{compared(first)};
  for (const auto& controller : section.controllers) {
    if (&controller == &first || controllers.size() == max_compared) continue;
    const bool present = controller.tuned_for == TunedFor::present && controller.stable();
    const bool alike = controller.tuned_for == first.tuned_for && controller.usable();
    if (controller.wind_speed == first.wind_speed && (present || alike))
      controllers.push_back(compared(controller));
  }
  return controllers;
}

}  // namespace

std::vector<Figure> tune_figures(const TuneSection& section,
                                 const std::optional<TimeDomainSection>& in_time) {
  std::vector<Figure> figures;
  const bool any =
      std::any_of(section.controllers.begin(), section.controllers.end(),
                  [](const TunedController& controller) { return controller.stable(); });
  if (!any || section.wind_speeds.empty()) return figures;
  const TunedController* shown = shown_controller(section, in_time ? &*in_time : nullptr);
  const double wind_speed = shown != nullptr ? shown->wind_speed : section.wind_speeds.front();
  figures.push_back(structures_figure(section, wind_speed, in_time));
  if (shown == nullptr) return figures;
  design::TrackingProblem problem = section.problem;
  problem.wind.mean_speed = wind_speed;
  const auto controllers = compared_controllers(section, *shown);
  figures.push_back(rms_against_wind("rms-against-wind", title_of(section), problem, controllers,
                                     section.budgets, section.curves));
  if (controllers.size() > 1) {
    figures.push_back(compared_sensitivities("candidate-sensitivities", title_of(section), problem,
                                             controllers, control::loop_breaks.at(valve),
                                             section.goals.sensitivity_peak.at(valve)));
  }
  if (!shown->is_state_space()) {
    figures.push_back(block_diagram("controller", title_of(section),
                                    shown->design.tuning.controller.structure,
                                    section.gains_of(*shown), problem.delay));
  }
  auto of_controller =
      controller_figures({.id = "controller",
                          .section = title_of(section),
                          .name = description_of(*shown),
                          .problem = problem,
                          .controller = shown->design.tuning.controller,
                          .margins = shown->design.margins,
                          .goals = section.goals,
                          .noise_variance = shown->design.tuning.evaluation.noise_variance,
                          .curves = section.curves});
  std::move(of_controller.begin(), of_controller.end(), std::back_inserter(figures));
  const bool simulated =
      in_time && in_time->controller == description_of(*shown) && in_time->wind_speed == wind_speed;
  figures.push_back(error_budget_figure(
      "error-budget", title_of(section),
      fmt::format("{}, {:.3g} m/s{}.", description_of(*shown), wind_speed,
                  simulated ? "" : ", not simulated on the nonlinear antenna"),
      design::error_budget(problem, shown->design, simulated ? &*in_time : nullptr),
      section.budgets));
  return figures;
}

std::vector<Figure> limit_figures(const design::PointingLimit& limit) {
  Figure figure;
  figure.id = "limit";
  figure.section = "Distance from the best possible controller";
  figure.title = "Controllers against the lower bound";
  figure.caption = fmt::format(
      "Boresight rms of each sampled controller ({:g} s), nominal plant and worst plant of the "
      "ensemble; without a second point it is unstable on one of them. Lower bound: any linear "
      "controller with the same sensors, sampling and control effort up to {:g} rad/s rms.",
      limit.sample_time, limit.effort_limit);
  figure.x = {.label = "boresight rms", .unit = "mdeg"};
  FigurePanel panel;
  FigureSeries nominal{.name = "nominal plant", .style = SeriesStyle::points};
  FigureSeries worst{.name = "worst plant", .style = SeriesStyle::points};
  const auto add = [&](const std::string& name, const design::SampledDesign& design) {
    if (!design.nominal.stable()) return;
    const auto place = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(name);
    nominal.x.push_back(design.nominal.boresight_rms / millidegree);
    nominal.y.push_back(place);
    worst.x.push_back(design.worst_rms / millidegree);
    worst.y.push_back(place);
  };
  add("LQG, unconstrained", limit.unconstrained);
  if (limit.margin_limited) {
    add(fmt::format("LQG, S valve <= {:g}", limit.peak_limit), limit.margin_limited->design);
  }
  if (limit.robustified) add("LQG, robust over the plants", limit.robustified->design);
  if (limit.refined) add("state space, refined", *limit.refined);
  for (const auto& controller : limit.controllers) add(controller.name, controller.design);
  panel.series = {std::move(nominal), std::move(worst)};
  panel.lines.push_back(
      {FigureLine::Direction::vertical, limit.min_rms / millidegree, "lower bound"});
  panel.lines.push_back(
      {FigureLine::Direction::vertical, limit.flexure_rms / millidegree, "encoder fixed"});
  figure.x.lowest = 0.0;
  figure.panels.push_back(std::move(panel));
  return {figure};
}

}  // namespace boresight::app
