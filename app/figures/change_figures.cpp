#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/figures/change_figures.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

FigureSeries records_of(const design::ConditionInWind& condition, const std::string& name) {
  FigureSeries series = make_series(name, SeriesStyle::points);
  for (const auto& record : condition.records) {
    series.x.push_back(record.mean_speed);
    series.y.push_back(record.rms / millidegree);
    series.labels.push_back(record.name);
  }
  return series;
}

FigureSeries compared(const std::vector<std::pair<double, design::RmsBand>>& bands,
                      const std::string& name) {
  FigureSeries series = make_series(name, SeriesStyle::line_and_points);
  for (const auto& [speed, band] : bands) {
    series.x.push_back(speed);
    series.y.push_back(band.value / millidegree);
    series.y_lower.push_back(band.lower / millidegree);
    series.y_upper.push_back(band.upper / millidegree);
  }
  return series;
}

}  // namespace

std::vector<Figure> change_figures(const design::ChangeStudy& study) {
  const design::WindComparison& comparison = study.comparison;
  Figure figure = make_figure(
      "change-in-wind", "Evidence", "Error over wind speed, before and after",
      fmt::format("Rms of the {} of each record, {:.3g} to {:.3g} Hz; both conditions with "
                  "their intervals at the wind of the comparison.",
                  to_string(study.error), comparison.lowest, comparison.highest),
      make_axis("mean wind speed", "m/s"));
  FigurePanel panel =
      make_panel(make_axis(fmt::format("{} rms", to_string(study.error)), "mdeg"),
                 {records_of(comparison.before, "before"), records_of(comparison.after, "after")});
  std::vector<std::pair<double, design::RmsBand>> before, after;
  for (const auto* at : {&comparison.at_reference, &comparison.at_design}) {
    if (!*at) continue;
    before.emplace_back((*at)->speed, (*at)->before);
    after.emplace_back((*at)->speed, (*at)->after);
  }
  if (!before.empty()) {
    panel.series.push_back(compared(before, "before, compared"));
    panel.series.push_back(compared(after, "after, compared"));
  }
  figure.panels.push_back(std::move(panel));
  return {std::move(figure)};
}

}  // namespace boresight::app
