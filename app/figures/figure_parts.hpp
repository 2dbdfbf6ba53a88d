#pragma once

#include <string>
#include <utility>
#include <vector>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

// Parts of a figure whose other members keep their defaults.

inline FigureAxis make_axis(std::string label, std::string unit,
                            AxisScale scale = AxisScale::linear) {
  FigureAxis axis;
  axis.label = std::move(label);
  axis.unit = std::move(unit);
  axis.scale = scale;
  return axis;
}

inline FigureSeries make_series(std::string name, SeriesStyle style, std::vector<double> x = {},
                                std::vector<double> y = {}) {
  FigureSeries series;
  series.name = std::move(name);
  series.style = style;
  series.x = std::move(x);
  series.y = std::move(y);
  return series;
}

inline FigurePanel make_panel(FigureAxis y, std::vector<FigureSeries> series = {}) {
  FigurePanel panel;
  panel.y = std::move(y);
  panel.series = std::move(series);
  return panel;
}

inline FigureLine vertical_line(double at, std::string label) {
  return {FigureLine::Direction::vertical, at, std::move(label)};
}

inline FigureLine horizontal_line(double at, std::string label) {
  return {FigureLine::Direction::horizontal, at, std::move(label)};
}

/// A figure without panels.
inline Figure make_figure(std::string id, std::string section, std::string title,
                          std::string caption, FigureAxis x) {
  Figure figure;
  figure.id = std::move(id);
  figure.section = std::move(section);
  figure.title = std::move(title);
  figure.caption = std::move(caption);
  figure.x = std::move(x);
  return figure;
}

}  // namespace boresight::app
