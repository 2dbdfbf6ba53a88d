#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/time_domain_figures.hpp>
#include <boresight/app/figures/trace_figures.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using design::RunStatus;

// Bars one below the other: totals from 0, contributions from where the ones before end.
class Waterfall {
 public:
  void total(const std::string& name, double value) {
    add(totals_, name, 0.0, value, value);
    reached_ = value;
  }
  void contribution(const std::string& name, double value) {
    if (!std::isfinite(value)) return;
    add(contributions_, name, reached_, reached_ + value, value);
    reached_ += value;
  }
  FigurePanel panel() && {
    FigurePanel panel;
    panel.y.categories = std::move(names_);
    panel.series = {std::move(totals_), std::move(contributions_)};
    return panel;
  }

 private:
  void add(FigureSeries& series, const std::string& name, double from, double to, double value) {
    series.x.push_back(to / millidegree);
    series.y.push_back(static_cast<double>(names_.size()));
    series.x_lower.push_back(std::min(from, to) / millidegree);
    series.x_upper.push_back(std::max(from, to) / millidegree);
    series.labels.push_back(&series == &totals_ ? fmt::format("{:.4f} mdeg", value / millidegree)
                                                : fmt::format("{:+.4f} mdeg", value / millidegree));
    names_.push_back(name);
  }

  FigureSeries totals_ = make_series("boresight rms", SeriesStyle::bars);
  FigureSeries contributions_ = make_series("contribution", SeriesStyle::bars);
  std::vector<std::string> names_;
  double reached_ = 0.0;  // rad
};

Figure contributions(const TimeDomainSection& section, const std::string& heading) {
  const auto& wind = section.result.wind;
  Waterfall bars;
  bars.total("linear prediction", wind.predicted_rms);
  bars.contribution("realisation error", wind.realisation_error);
  bars.contribution("sampling", wind.sampling);
  for (const auto& influence : wind.influences) {
    bars.contribution(std::string(design::to_string(influence.influence)), influence.difference);
  }
  bars.contribution("interactions, lines, offset", wind.interaction);
  bars.total("simulated", wind.boresight_rms);
  Figure figure = make_figure(
      "time-domain-contributions", heading, "From the linear prediction to the nonlinear antenna",
      fmt::format("Boresight rms per axis, {}: {:g} s of wind of {:.3g} m/s, controller sampled "
                  "every {:g} s. Contribution: rms with all effects minus rms without this one.",
                  section.controller, section.options.wind_duration, section.wind_speed,
                  section.sample_time),
      make_axis("boresight rms", "mdeg"));
  figure.panels.push_back(std::move(bars).panel());
  return figure;
}

Figure candidates(const TimeDomainSection& section, const std::string& heading) {
  FigurePanel panel;
  FigureSeries linear = make_series("linear prediction", SeriesStyle::bars);
  FigureSeries simulated = make_series("simulated, nonlinear antenna", SeriesStyle::bars);
  for (const auto& candidate : section.candidates) {
    const auto place = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(candidate.controller);
    linear.x.push_back(candidate.result.wind.predicted_rms / millidegree);
    simulated.x.push_back(candidate.simulated_rms() / millidegree);
    linear.y.push_back(place);
    simulated.y.push_back(place);
  }
  panel.series = {std::move(linear), std::move(simulated)};
  Figure figure = make_figure(
      "time-domain-controllers", heading, "Tuned controllers on the nonlinear antenna",
      fmt::format("Boresight rms in wind of {:.3g} m/s, over the same simulated records for "
                  "all, limit cycle not included.",
                  section.wind_speed),
      make_axis("boresight rms", "mdeg"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

std::vector<Figure> time_domain_figures(const TimeDomainSection& section,
                                        const std::string& heading) {
  std::vector<Figure> figures;
  if (section.result.wind.status == RunStatus::complete) {
    figures.push_back(contributions(section, heading));
  }
  std::ranges::move(trace_figures(section, heading), std::back_inserter(figures));
  if (section.candidates.size() > 1) figures.push_back(candidates(section, heading));
  return figures;
}

}  // namespace boresight::app
