#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/montecarlo_figures.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t classes = 40;       // of the histogram
constexpr double shown_fraction = 0.995;  // of the plants, that the histogram reaches to
constexpr std::size_t curve_points = 400;

// Boresight rms of the stable plants, mdeg, rising.
std::vector<double> sorted_rms(const MonteCarloOutcome& outcome) {
  std::vector<double> values;
  const auto& run = *outcome.run;
  for (std::size_t block = 0; block < run.blocks(); ++block) {
    if (!run.whole(block)) continue;
    for (const auto& one : run.outcomes(block)) {
      if (std::isfinite(one.boresight_rms)) values.push_back(one.boresight_rms / millidegree);
    }
  }
  std::ranges::sort(values);
  return values;
}

FigureSeries histogram(const std::vector<double>& values, double from, double to) {
  FigureSeries bars = make_series("plants", SeriesStyle::bars);
  const double width = (to - from) / static_cast<double>(classes);
  const auto all = static_cast<double>(values.size());
  for (std::size_t k = 0; k < classes; ++k) {
    const double begin = from + width * static_cast<double>(k);
    const double end = k + 1 == classes ? to : begin + width;
    const auto first = std::ranges::lower_bound(values, begin);
    const auto last = k + 1 == classes ? std::ranges::upper_bound(values, end)
                                       : std::ranges::lower_bound(values, end);
    const auto count = static_cast<double>(std::max<std::ptrdiff_t>(0, last - first));
    bars.x.push_back(0.5 * (begin + end));
    bars.y.push_back(100.0 * count / all);
  }
  return bars;
}

Figure distribution(const MonteCarloSection& section, const std::vector<double>& values) {
  const double minimum = values.front();
  const auto reached =
      static_cast<std::size_t>(shown_fraction * static_cast<double>(values.size()));
  const double largest = values[std::min(reached, values.size() - 1)];
  const double from = minimum, to = largest > minimum ? largest : minimum * 1.01 + 1e-9;
  FigurePanel fractions = make_panel(make_axis("fraction of the stable plants", "%"));
  fractions.series.push_back(histogram(values, from, to));
  FigurePanel cumulative = make_panel(make_axis("fraction of all plants at or below", "%"));
  FigureSeries curve = make_series("plants", SeriesStyle::line);
  const auto all = static_cast<double>(section.plants);
  const std::size_t step = std::max<std::size_t>(1, values.size() / curve_points);
  for (std::size_t i = 0; i < values.size(); i += step) {
    if (values[i] > to) break;
    curve.x.push_back(values[i]);
    curve.y.push_back(100.0 * static_cast<double>(i + 1) / all);
  }
  cumulative.series.push_back(std::move(curve));
  for (const auto& [budget, met] : section.budgets) {
    const double at = budget.rms / millidegree;
    const std::string name = fmt::format("{} ({})", budget.name, budget.band);
    fractions.lines.push_back(vertical_line(at, name));
    cumulative.lines.push_back(vertical_line(at, fmt::format("{:.1f} %", 100.0 * met.value)));
  }
  Figure figure = make_figure(
      "montecarlo-rms", "Distribution over the stable plants",
      "Boresight rms over the sampled plants",
      fmt::format("{}, fixed gains, wind of {:.3g} m/s ({} model), {} plants {}: {} stable, the "
                  "rest meets no budget. Shown up to the {:g} % quantile; largest rms {:.4g} mdeg. "
                  "Lines: budgets, with the fraction that meets each below.",
                  section.structure, section.wind_speed, plant::to_string(section.wind_model),
                  section.plants, section.distribution, section.stable, 100.0 * shown_fraction,
                  values.back()),
      make_axis("boresight rms per axis", "mdeg"));
  figure.panels = {std::move(fractions), std::move(cumulative)};
  return figure;
}

Figure worst_plants(const MonteCarloSection& section) {
  FigurePanel panel;
  FigureSeries bars = make_series("boresight rms", SeriesStyle::bars);
  for (const auto& plant : section.worst) {
    bars.x.push_back(plant.outcome.boresight_rms / millidegree);
    bars.y.push_back(static_cast<double>(panel.y.categories.size()));
    std::string inputs;
    for (const auto input : section.inputs) {
      inputs += fmt::format("{}{} {:.3g}", inputs.empty() ? "" : ", ", to_string(input),
                            plant.draw[input]);
    }
    bars.labels.push_back(std::move(inputs));
    panel.y.categories.push_back(fmt::format("plant {}", plant.index));
  }
  panel.series.push_back(std::move(bars));
  for (const auto& [budget, met] : section.budgets) {
    panel.lines.push_back(vertical_line(budget.rms / millidegree, budget.name));
  }
  Figure figure =
      make_figure("montecarlo-worst", "Worst stable plants", "Worst stable plants",
                  fmt::format("Of {} stable plants, wind of {:.3g} m/s. Exploring shows the inputs "
                              "of each, as in the table.",
                              section.stable, section.wind_speed),
                  make_axis("boresight rms per axis", "mdeg"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure correlations(const MonteCarloSection& section) {
  FigurePanel panel;
  FigureSeries points = make_series("with the boresight rms, 95 % interval", SeriesStyle::points);
  for (const auto& [input, with_rms] : section.correlations) {
    points.x.push_back(with_rms.value);
    points.x_lower.push_back(with_rms.lower);
    points.x_upper.push_back(with_rms.upper);
    points.y.push_back(static_cast<double>(panel.y.categories.size()));
    panel.y.categories.emplace_back(to_string(input));
  }
  panel.series.push_back(std::move(points));
  panel.lines.push_back(vertical_line(0.0, ""));
  Figure figure = make_figure(
      "montecarlo-correlations", "Correlation of inputs with the rms",
      "Correlation of inputs with the rms",
      fmt::format(
          "Spearman rank correlation of the boresight rms with each input over {} stable plants.",
          section.stable),
      make_axis("rank correlation", ""));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

std::vector<Figure> montecarlo_figures(const MonteCarloOutcome& outcome) {
  std::vector<Figure> figures;
  const auto& section = outcome.section;
  if (outcome.run == nullptr) return figures;
  const auto values = sorted_rms(outcome);
  if (values.empty()) return figures;
  figures.push_back(distribution(section, values));
  if (!section.worst.empty()) figures.push_back(worst_plants(section));
  if (!section.correlations.empty()) figures.push_back(correlations(section));
  return figures;
}

}  // namespace boresight::app
