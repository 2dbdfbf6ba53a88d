#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/figures/error_budget_figures.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

// Bars one below the other, each labelled with its value.
class NamedBars {
 public:
  NamedBars(FigureSeries& series, FigurePanel& panel) : series_(series), panel_(panel) {}

  void add(std::string name, double value, std::string label) {
    series_.x.push_back(value);
    series_.y.push_back(static_cast<double>(panel_.y.categories.size()));
    series_.labels.push_back(std::move(label));
    panel_.y.categories.push_back(std::move(name));
  }

 private:
  FigureSeries& series_;
  FigurePanel& panel_;
};

}  // namespace

Figure error_budget_figure(const std::string& id, const std::string& section,
                           const std::string& conditions, const design::ErrorBudget& errors,
                           const std::vector<design::PointingBudget>& budgets) {
  Figure figure = make_figure(
      id, section, "Error budget against the pointing budgets",
      "Boresight rms per axis; the total is the root sum of squares. Wind and sensor noise: linear "
      "plant. Nonlinear effects: what the nonlinear antenna adds in wind. Limit cycle: rms of its "
      "amplitude. The static error in the mean wind, structural flexure included, is not in the "
      "total: the pointing model removes it. Lines: budgets. " +
          conditions,
      make_axis("boresight rms", "mdeg"));
  FigurePanel panel;
  FigureSeries parts = make_series("part of the total", SeriesStyle::bars);
  FigureSeries total = make_series("total", SeriesStyle::bars);
  FigureSeries apart = make_series("not in the total", SeriesStyle::bars);
  const auto add = [&](FigureSeries& series, const char* name, double value) {
    NamedBars(series, panel)
        .add(name, value / millidegree, fmt::format("{:.3f} mdeg", value / millidegree));
  };
  add(parts, "wind", errors.wind);
  add(parts, "sensor noise", errors.noise);
  add(parts, "nonlinear effects", errors.nonlinearities);
  add(parts, "limit cycle", errors.limit_cycle);
  add(total, "total", errors.total);
  add(apart, "static error", errors.static_error);
  // What each bar spans: then they stand in their rows, not side by side.
  for (auto* series : {&parts, &total, &apart}) {
    series->x_lower.assign(series->x.size(), 0.0);
    series->x_upper = series->x;
    panel.series.push_back(std::move(*series));
  }
  for (const auto& budget : budgets) {
    panel.lines.push_back(
        vertical_line(budget.rms / millidegree, fmt::format("{}, {}", budget.band, budget.name)));
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::vector<Figure> uncertainty_figures(const IdentificationSection& section) {
  Figure figure = make_figure(
      "stated-uncertainty",
      "Inertia at the motor shaft, by method (95 % intervals from the inputs' uncertainties)",
      "Uncertainty budget of the reflected inertia",
      "By method: fraction of the variance of J from each input's uncertainty, first order (GUM), "
      "and the standard uncertainty that it contributes; u: combined standard uncertainty. Inputs "
      "below 1 % are left out. Model errors of the method are excluded.",
      make_axis("fraction of the variance of J", "%"));
  figure.x.lowest = 0.0;
  figure.x.highest = 100.0;
  for (const auto& method : section.inertia.methods) {
    const auto& inertia = method.reflected_inertia;
    if (inertia.contributions.empty()) continue;
    FigurePanel panel;
    panel.y.label = fmt::format("{}: J = {:.3f}, u = {:.3f} kg.m2", method.name, inertia.value,
                                inertia.standard_uncertainty);
    FigureSeries bars;
    bars.style = SeriesStyle::bars;
    NamedBars rows(bars, panel);
    for (const auto& [input, fraction] : inertia.contributions) {
      rows.add(input, 100.0 * fraction,
               fmt::format("{:.2g} kg.m2", inertia.standard_uncertainty * std::sqrt(fraction)));
    }
    panel.series.push_back(std::move(bars));
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return {};
  return {std::move(figure)};
}

}  // namespace boresight::app
