#pragma once

#include <cmath>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Map from values to the drawing: `from` at `start`, `to` at `end` (coordinates of the viewBox).
struct PlotAxis {
  AxisScale scale = AxisScale::linear;
  double from = 0.0, to = 1.0;
  double start = 0.0, end = 1.0;

  /// NaN for what has no place on the axis.
  double at(double value) const {
    if (scale == AxisScale::logarithmic) {
      if (!(value > 0.0)) return std::nan("");
      return start + (end - start) * std::log(value / from) / std::log(to / from);
    }
    return start + (end - start) * (value - from) / (to - from);
  }

  bool shows(double value) const {
    const double slack = 1e-9 * std::abs(end - start);
    const double place = at(value);
    return place >= std::fmin(start, end) - slack && place <= std::fmax(start, end) + slack;
  }
};

/// What the x axis of a figure and the y axis of one of its panels show, without places. A linear y
/// axis starts at 0 where the least value is below 0.4 of the largest, and for bars.
/// @throws InvalidInput for a logarithmic axis without a positive value and for limits in the wrong
/// order.
PlotAxis x_range(const Figure& figure);
PlotAxis y_range(const Figure& figure, const FigurePanel& panel);

/// Width of a bar of each series, in units of the axis on which the bars stand.
double bar_width(const FigureSeries& series, bool categories);

/// Whether a panel's bars lie along x, from a y axis of names.
inline bool bars_along_x(const FigurePanel& panel) {
  return !panel.y.categories.empty();
}

}  // namespace boresight::app
