#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/figures/plot_axis.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

struct Extent {
  bool logarithmic = false;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool lines_only = true;  // curves may touch the frame, points may not

  void add(double value) {
    if (!std::isfinite(value) || (logarithmic && value <= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }

  void add(const std::vector<double>& values) {
    for (const double value : values) add(value);
  }
};

bool is_curve(SeriesStyle style) {
  return style == SeriesStyle::line || style == SeriesStyle::dashed || style == SeriesStyle::steps;
}

PlotAxis range(const FigureAxis& axis, Extent extent, double padding) {
  PlotAxis result{axis.scale, extent.low, extent.high};
  if (!axis.categories.empty()) {
    return {AxisScale::linear, -0.5, static_cast<double>(axis.categories.size()) - 0.5};
  }
  const bool logarithmic = axis.scale == AxisScale::logarithmic;
  if (logarithmic && !(extent.high > 0.0) && !(axis.lowest && axis.highest)) {
    throw InvalidInput(fmt::format(
        "to_svg: expected a positive value on the logarithmic axis '{}', found none", axis.label));
  }
  if (!(result.from <= result.to)) {
    result.from = logarithmic ? 1.0 : 0.0;
    result.to = logarithmic ? 10.0 : 1.0;
  }
  if (logarithmic) {
    if (result.to < result.from * 1.0001) {
      result.from /= 2.0;
      result.to *= 2.0;
    } else {
      const double factor = std::pow(result.to / result.from, padding);
      result.from /= factor;
      result.to *= factor;
    }
  } else {
    const double span = result.to - result.from;
    const double largest = std::max(std::abs(result.from), std::abs(result.to));
    if (span <= 1e-9 * largest || largest == 0.0) {
      const double room = largest == 0.0 ? 1.0 : 0.1 * largest;
      result.from -= room;
      result.to += room;
    } else {
      // A curve that ends at zero stands on the axis.
      if (result.from != 0.0) result.from -= padding * span;
      if (result.to != 0.0) result.to += padding * span;
    }
  }
  result.from = axis.lowest.value_or(result.from);
  result.to = axis.highest.value_or(result.to);
  if (!(result.from < result.to) || (logarithmic && !(result.from > 0.0))) {
    throw InvalidInput(
        fmt::format("to_svg: expected limits of the axis '{}' in order, found {} .. {}", axis.label,
                    result.from, result.to));
  }
  return result;
}

}  // namespace

double bar_width(const FigureSeries& series, bool categories) {
  if (categories) return 0.74;
  double minimum = std::numeric_limits<double>::infinity();
  std::vector<double> places;
  for (const double x : series.x) {
    if (std::isfinite(x)) places.push_back(x);
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i] > places[i - 1]) minimum = std::min(minimum, places[i] - places[i - 1]);
  }
  return std::isfinite(minimum) ? 0.94 * minimum : 0.8;
}

PlotAxis x_range(const Figure& figure) {
  Extent extent{figure.x.scale == AxisScale::logarithmic};
  for (const auto& panel : figure.panels) {
    for (const auto& series : panel.series) {
      extent.add(series.x);
      extent.add(series.x_lower);
      extent.add(series.x_upper);
      if (!is_curve(series.style)) extent.lines_only = false;
      if (series.style != SeriesStyle::bars) continue;
      if (bars_along_x(panel)) {
        if (series.x_lower.empty()) extent.add(0.0);
      } else if (!extent.logarithmic) {
        const double half = 0.5 * bar_width(series, false);
        for (const double x : series.x) {
          extent.add(x - half);
          extent.add(x + half);
        }
      }
    }
    for (const auto& mark : panel.marks) extent.add(mark.x);
    for (const auto& line : panel.lines) {
      if (line.direction == FigureLine::Direction::vertical) extent.add(line.at);
    }
    for (const auto& circle : panel.circles) {
      extent.add(circle.x - circle.radius);
      extent.add(circle.x + circle.radius);
    }
  }
  return range(figure.x, extent, extent.lines_only ? 0.0 : 0.035);
}

PlotAxis y_range(const Figure& figure, const FigurePanel& panel) {
  Extent extent{panel.y.scale == AxisScale::logarithmic};
  // Only what stands within the limits of x counts.
  const auto shown = [&](double x) {
    return x >= figure.x.lowest.value_or(x) && x <= figure.x.highest.value_or(x);
  };
  for (const auto& series : panel.series) {
    const bool bars = series.style == SeriesStyle::bars;
    if (bars && series.y_lower.empty() && !bars_along_x(panel)) extent.add(0.0);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!shown(series.x[i])) continue;
      extent.add(series.y[i]);
      if (!series.y_lower.empty()) extent.add(series.y_lower[i]);
      if (!series.y_upper.empty()) extent.add(series.y_upper[i]);
    }
  }
  for (const auto& mark : panel.marks) {
    if (shown(mark.x)) extent.add(mark.y);
  }
  for (const auto& line : panel.lines) {
    if (line.direction == FigureLine::Direction::horizontal) extent.add(line.at);
  }
  for (const auto& circle : panel.circles) {
    extent.add(circle.y - circle.radius);
    extent.add(circle.y + circle.radius);
  }
  if (!extent.logarithmic && !figure.equal_scales && extent.low > 0.0 &&
      extent.low < 0.4 * extent.high) {
    extent.add(0.0);
  }
  return range(panel.y, extent, 0.06);
}

}  // namespace boresight::app
