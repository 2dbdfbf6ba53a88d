#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/figures/block_diagram.hpp>
#include <boresight/app/figures/controller_figures.hpp>
#include <boresight/app/figures/error_budget_figures.hpp>
#include <boresight/app/figures/tuning_figures.hpp>
#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double rms_of(const design::Design& design) {
  return design.tuning.status == design::TuningStatus::unstable
             ? undefined
             : design.boresight_rms / millidegree;
}

}  // namespace

std::vector<Figure> tuning_figures(const TuningSection& section,
                                   const std::optional<TimeDomainSection>& in_time) {
  const design::Design& design = section.design;
  if (design.tuning.status == design::TuningStatus::unstable) return {};
  const std::string title = tuning_heading(section);
  const std::string name(control::to_string(section.structure));
  const double noise = design.tuning.evaluation.noise_variance;
  std::vector<Figure> figures;
  if (section.structure.state_space() == nullptr) {
    figures.push_back(block_diagram("tuned-controller", title, section.structure,
                                    section.gain_units.texts(design.tuning.controller),
                                    section.problem.delay));
  }
  auto of_controller = controller_figures({.id = "tuned",
                                           .section = title,
                                           .name = name,
                                           .problem = section.problem,
                                           .controller = design.tuning.controller,
                                           .margins = design.margins,
                                           .goals = section.goals,
                                           .noise_variance = noise,
                                           .curves = section.curves});
  std::ranges::move(of_controller, std::back_inserter(figures));
  std::vector<design::PointingBudget> budgets;
  for (const auto& result : section.budgets) budgets.push_back(result.budget);
  std::vector<ComparedController> compared{{name, design.tuning.controller, noise, section.effect}};
  for (const auto& present : section.present) {
    const auto& tuning = present.design.tuning;
    if (tuning.status == design::TuningStatus::unstable) continue;
    compared.push_back({present_label(present.structure, present.retuned), tuning.controller,
                        tuning.evaluation.noise_variance});
  }
  figures.push_back(rms_against_wind("tuned-rms-against-wind", title, section.problem, compared,
                                     budgets, section.curves));
  figures.push_back(error_budget_figure(
      "tuned-error-budget", title,
      fmt::format("{}, {:.3g} m/s{}.", name, section.design_speed,
                  in_time ? "" : ", not simulated on the nonlinear antenna"),
      design::error_budget(section.problem, design, in_time ? &*in_time : nullptr), budgets));
  return figures;
}

std::vector<Figure> interpretations_figures(
    const std::vector<InterpretationResult>& interpretations) {
  Figure figure;
  figure.id = "interpretations";
  figure.section = interpretations_heading(interpretations);
  figure.title = std::ranges::any_of(interpretations, &InterpretationResult::contradicts)
                     ? "Boresight rms by reading of the contradictory values"
                     : "Boresight rms by reading that the case leaves open";
  figure.caption =
      "The same loop structure re-tuned on the plant of each reading, at the design wind speed, "
      "linear; no bar: no valid plant.";
  figure.x = {.label = "boresight rms", .unit = "mdeg"};
  FigurePanel panel;
  FigureSeries bars{.style = SeriesStyle::bars};
  for (const auto& choice : interpretations) {
    bars.y.push_back(static_cast<double>(panel.y.categories.size()));
    bars.x.push_back(choice.design ? rms_of(*choice.design) : undefined);
    panel.y.categories.push_back(choice.name);
  }
  if (!bars.x.empty() && std::isfinite(bars.x.front())) {
    panel.lines.push_back({FigureLine::Direction::vertical, bars.x.front(), ""});
  }
  if (std::none_of(bars.x.begin(), bars.x.end(), [](double x) { return std::isfinite(x); })) {
    return {};
  }
  panel.series.push_back(std::move(bars));
  figure.panels.push_back(std::move(panel));
  return {figure};
}

std::vector<Figure> matching_figures(const MatchingSection& section) {
  Figure figure;
  figure.id = "matching";
  figure.section = "Inertia matching: re-tuned at each motor inertia";
  figure.title = "Boresight rms and hydraulic mode against flywheel disks";
  figure.caption =
      "Each point is a controller re-tuned and verified at that motor inertia, by loop structure "
      "and linear friction, at the design wind speed. Below: hydraulic mode of the same plants. "
      "Vertical lines: equal inertia of motors and load.";
  figure.x = {.label = "flywheel disks on each motor"};
  figure.panels.resize(3);
  figure.panels[0].y = {.label = "boresight rms", .unit = "mdeg"};
  figure.panels[1].y = {.label = "hydraulic frequency", .unit = "Hz"};
  figure.panels[2].y = {.label = "hydraulic damping ratio"};
  for (const auto& series : section.series) {
    const std::string friction =
        series.friction.empty()
            ? friction_text(series)
            : fmt::format("{} ({:.3g} N.m.s/rad)", series.friction, series.viscous_friction);
    FigureSeries rms{.name = fmt::format("{}, {}", control::to_string(series.structure), friction),
                     .style = SeriesStyle::line_and_points};
    FigureSeries frequency{.name = friction};
    FigureSeries damping = frequency;
    for (std::size_t i = 0; i < section.rows.size(); ++i) {
      const double disks = section.rows[i].disks;
      rms.x.push_back(disks);
      rms.y.push_back(rms_of(series.designs[i]));
      frequency.x.push_back(disks);
      frequency.y.push_back(series.designs[i].hydraulic_mode.frequency);
      damping.x.push_back(disks);
      damping.y.push_back(series.designs[i].hydraulic_mode.damping_ratio);
    }
    figure.panels[0].series.push_back(std::move(rms));
    // The plant is the same whatever loop is closed on it.
    const auto& drawn = figure.panels[1].series;
    if (std::none_of(drawn.begin(), drawn.end(),
                     [&](const auto& other) { return other.name == frequency.name; })) {
      figure.panels[1].series.push_back(std::move(frequency));
      figure.panels[2].series.push_back(std::move(damping));
    }
  }
  for (const auto& row : section.rows) {
    if (!row.label.starts_with("ratio")) continue;
    for (auto& panel : figure.panels) {
      const bool first = &panel == &figure.panels.front();
      panel.lines.push_back(
          {FigureLine::Direction::vertical, row.disks, first ? row.label : std::string()});
    }
  }
  return {figure};
}

}  // namespace boresight::app
