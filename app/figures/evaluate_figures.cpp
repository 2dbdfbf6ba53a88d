#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/figures/evaluate_figures.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

std::string conditions(const EvaluateSection& section) {
  return fmt::format(
      "Each proposal with its own tuned loops, {:.3g} m/s, wind model {}, {} plants ({}){}.",
      section.wind_speed, plant::to_string(section.wind_model), section.ensemble_size,
      section.ensemble_source,
      section.time_domain ? "; linear rms times the simulated/linear rms ratio of each controller"
                          : "");
}

const std::string& name_of(const EvaluateSection& section, const DecisionSection& decision,
                           std::size_t place) {
  return section.candidates[decision.candidates[place].candidate].name;
}

double finite_rms(double rms) {
  return std::isfinite(rms) ? rms / millidegree : undefined;
}

Figure front_figure(const EvaluateSection& section) {
  Figure figure;
  figure.id = "pareto";
  figure.section = heading_of(section);
  figure.title = "Cost and boresight rms of the proposals";
  figure.caption =
      "Root mean square of the boresight rms over the plants against cost; whiskers: uncertainty "
      "of the cost. Steps: Pareto front. " +
      conditions(section);
  figure.x = {.label = "cost", .unit = section.currency};
  FigurePanel panel;
  panel.y = {.label = "boresight rms", .unit = "mdeg"};
  FigureSeries meets{.name = "meets every constraint", .style = SeriesStyle::points};
  FigureSeries misses{.name = "violates a constraint or fails its verification",
                      .style = SeriesStyle::points};
  FigureSeries front{.name = "Pareto front", .style = SeriesStyle::steps};
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr || !candidate.cost || !std::isfinite(controller->compared_rms()))
      continue;
    FigureSeries& series = candidate.feasible() ? meets : misses;
    series.x.push_back(*candidate.cost);
    series.x_lower.push_back(*candidate.cost - candidate.cost_uncertainty);
    series.x_upper.push_back(*candidate.cost + candidate.cost_uncertainty);
    series.y.push_back(finite_rms(controller->compared_rms()));
    series.labels.push_back(candidate.name);
  }
  for (const std::size_t place : section.front) {
    const Candidate& candidate = section.candidates[place];
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr || !candidate.cost) continue;
    front.x.push_back(*candidate.cost);
    front.y.push_back(finite_rms(controller->compared_rms()));
  }
  if (!meets.x.empty()) panel.series.push_back(std::move(meets));
  if (front.x.size() > 1) panel.series.push_back(std::move(front));
  if (!misses.x.empty()) panel.series.push_back(std::move(misses));
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure spread_figure(const EvaluateSection& section) {
  Figure figure;
  figure.id = "proposals-spread";
  figure.section = heading_of(section);
  figure.title = "Boresight rms of the proposals over the ensemble";
  figure.caption =
      "Median and range of the boresight rms over the plants, with fixed gains; lines are "
      "budgets. " +
      conditions(section);
  figure.x = {.label = "boresight rms", .unit = "mdeg"};
  FigurePanel panel;
  FigureSeries spread{.style = SeriesStyle::points};
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr || !controller->ensemble ||
        !std::isfinite(controller->ensemble->median_rms))
      continue;
    const auto place = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(candidate.name);
    spread.x.push_back(finite_rms(controller->ensemble->median_rms));
    spread.x_lower.push_back(finite_rms(controller->ensemble->min_rms));
    spread.x_upper.push_back(finite_rms(controller->ensemble->largest_rms));
    spread.y.push_back(place);
  }
  double largest = 0.0;
  for (const double rms : spread.x_upper) largest = std::max(largest, rms);
  for (const auto& budget : section.budgets) {
    const double rms = budget.rms / millidegree;
    if (rms > 1.3 * largest) continue;
    panel.lines.push_back(
        {FigureLine::Direction::vertical, rms, fmt::format("{}, {}", budget.band, budget.name)});
  }
  panel.series.push_back(std::move(spread));
  figure.panels.push_back(std::move(panel));
  return figure;
}

// A panel of fractions by name, from probabilities.
struct NamedFraction {
  std::string name;
  design::Probability fraction;
};
FigurePanel share_panel(const std::string& label, const std::vector<NamedFraction>& fractions) {
  FigurePanel panel;
  panel.y.label = label;
  FigureSeries series{.style = SeriesStyle::points};
  for (const auto& [name, fraction] : fractions) {
    series.y.push_back(static_cast<double>(panel.y.categories.size()));
    panel.y.categories.push_back(name);
    series.x.push_back(fraction.value);
    series.x_lower.push_back(fraction.lower);
    series.x_upper.push_back(fraction.upper);
  }
  panel.series.push_back(std::move(series));
  return panel;
}

Figure chances_figure(const EvaluateSection& section, const DecisionSection& decision) {
  Figure figure;
  figure.id = "probabilities";
  figure.section = heading_of(decision);
  const std::string& best = name_of(section, decision, decision.best);
  figure.title = "Probability that a proposal is best";
  figure.caption = fmt::format(
      "Probability of the lowest boresight rms, and that '{}' (lowest mean rms) beats each other "
      "proposal on the same plant, ties counted half. {} samples, fixed gains, 95 % sampling "
      "intervals.",
      best, decision.random_samples);
  figure.x = {.label = "probability", .lowest = 0.0, .highest = 1.0};
  std::vector<NamedFraction> minimum, pairs;
  for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
    minimum.push_back({name_of(section, decision, i), decision.statistics.options[i].best});
  }
  for (const auto& pair : decision.statistics.pairs) {
    const auto& better = pair.better;
    if (pair.first == decision.best) {
      pairs.push_back({name_of(section, decision, pair.second), better});
    } else if (pair.second == decision.best) {
      pairs.push_back({name_of(section, decision, pair.first),
                       {1.0 - better.value, 1.0 - better.upper, 1.0 - better.lower}});
    }
  }
  figure.panels.push_back(share_panel("lowest of all", minimum));
  if (!pairs.empty()) {
    figure.panels.push_back(share_panel(fmt::format("'{}' is better than", best), pairs));
    figure.panels.back().lines.push_back({FigureLine::Direction::vertical, 0.5, ""});
  }
  return figure;
}

std::string difference(const EvaluateSection& section, const DecisionSection& decision) {
  return fmt::format("Boresight rms of '{}' minus that of '{}', fixed gains",
                     name_of(section, decision, decision.second),
                     name_of(section, decision, decision.best));
}

Figure tornado_figure(const EvaluateSection& section, const DecisionSection& decision,
                      const design::Tornado& tornado) {
  Figure figure;
  figure.id = "tornado";
  figure.section = heading_of(decision);
  figure.title = "Sensitivity of the difference between the two best proposals";
  figure.caption = fmt::format(
      "{}: each input at its 5 % and 95 % quantile, the others at their median; right of zero '{}' "
      "is better. {:.3g} m/s, wind model {}.",
      difference(section, decision), name_of(section, decision, decision.best), section.wind_speed,
      plant::to_string(section.wind_model));
  figure.x = {.label = "difference of boresight rms", .unit = "mdeg"};
  FigurePanel panel;
  FigureSeries low{.name = "at 5 %", .style = SeriesStyle::bars};
  FigureSeries high{.name = "at 95 %", .style = SeriesStyle::bars};
  constexpr std::size_t maximum = 12;
  for (std::size_t i = 0; i < std::min(tornado.bars.size(), maximum); ++i) {
    const auto& bar = tornado.bars[i];
    panel.y.categories.push_back(decision.inputs[bar.input]);
    const auto add = [&](FigureSeries& series, double value) {
      series.x.push_back(value);
      series.x_lower.push_back(std::min(value, tornado.at_median));
      series.x_upper.push_back(std::max(value, tornado.at_median));
      series.y.push_back(static_cast<double>(i));
    };
    add(low, bar.at_low);
    add(high, bar.at_high);
  }
  panel.series = {std::move(low), std::move(high)};
  panel.lines.push_back({FigureLine::Direction::vertical, tornado.at_median, "all at the median"});
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure sobol_figure(const EvaluateSection& section, const DecisionSection& decision,
                    const numerics::SobolIndices& indices) {
  Figure figure;
  figure.id = "sobol";
  figure.section = heading_of(decision);
  figure.title = "Sobol' indices of the difference between the two best proposals";
  figure.caption = fmt::format(
      "{}: Sobol' indices with 95 % intervals. First order: fraction of the variance removed if "
      "the input is known; total: with all its interactions.",
      difference(section, decision));
  figure.x = {.label = "fraction of the variance"};
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < indices.inputs.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return indices.inputs[a].total.value > indices.inputs[b].total.value;
  });
  constexpr std::size_t maximum = 12;
  order.resize(std::min(order.size(), maximum));
  FigurePanel panel;
  FigureSeries first{.name = "first order", .style = SeriesStyle::points};
  FigureSeries total{.name = "total", .style = SeriesStyle::points};
  for (const std::size_t input : order) {
    const auto place = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(decision.inputs[input]);
    const auto add = [](FigureSeries& series, const numerics::EstimatedIndex& index, double at) {
      series.x.push_back(index.value);
      series.x_lower.push_back(index.lower);
      series.x_upper.push_back(index.upper);
      series.y.push_back(at);
    };
    // A little apart, so that neither hides the other.
    add(first, indices.inputs[input].first_order, place - 0.12);
    add(total, indices.inputs[input].total, place + 0.12);
  }
  panel.series = {std::move(first), std::move(total)};
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

std::vector<Figure> evaluate_figures(const EvaluateSection& section) {
  std::vector<Figure> figures;
  if (!section.currency.empty()) figures.push_back(front_figure(section));
  figures.push_back(spread_figure(section));
  std::erase_if(figures, [](const Figure& figure) {
    const auto& series = figure.panels.front().series;
    return series.empty() || series.front().x.empty();
  });
  if (!section.decision) return figures;
  const DecisionSection& decision = *section.decision;
  const std::size_t options = decision.statistics.options.size();
  if (options > 1 && options == decision.candidates.size()) {
    figures.push_back(chances_figure(section, decision));
  }
  if (decision.tornado && !decision.tornado->bars.empty()) {
    figures.push_back(tornado_figure(section, decision, *decision.tornado));
  }
  if (decision.sobol && !decision.sobol->outputs.empty() &&
      !decision.sobol->outputs.front().constant) {
    figures.push_back(sobol_figure(section, decision, decision.sobol->outputs.front()));
  }
  return figures;
}

}  // namespace boresight::app
