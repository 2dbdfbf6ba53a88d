#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/figures/series_look.hpp>
#include <boresight/app/figures/series_svg.hpp>

namespace boresight::app {
namespace {

struct Point {
  double x = 0.0, y = 0.0;
};
using Run = std::vector<Point>;

// Far outside a drawing viewers lose precision: an edge this far off is as good as infinity.
constexpr double far = 3000.0;

double achievable_limits(const PlotAxis& axis, double place) {
  return std::clamp(place, std::min(axis.start, axis.end) - far,
                    std::max(axis.start, axis.end) + far);
}

std::vector<Run> runs_of(const FigureSeries& series, const std::vector<double>& y_values,
                         const PlotAxis& x, const PlotAxis& y) {
  std::vector<Run> runs(1);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Point point{x.at(series.x[i]), y.at(y_values[i])};
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      if (!runs.back().empty()) runs.emplace_back();
      continue;
    }
    Run& run = runs.back();
    const Point reached{achievable_limits(x, point.x), achievable_limits(y, point.y)};
    if (series.style == SeriesStyle::steps && !run.empty()) {
      run.push_back({reached.x, run.back().y});
    }
    run.push_back(reached);
  }
  if (runs.back().empty()) runs.pop_back();
  return runs;
}

// Ramer, Douglas and Peucker: leaves out points that lie within a twentieth of a pixel of the line
// through those that stay.
Run without_needless_points(const Run& run) {
  constexpr double tolerance = 0.05;
  std::vector<char> stays(run.size(), 0);
  if (run.empty()) return run;
  stays.front() = stays.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, run.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const Point a = run[first], b = run[last];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    double farthest = 0.0;
    std::size_t which = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const Point p = run[i];
      double distance = std::hypot(p.x - a.x, p.y - a.y);
      if (length > 0.0) {
        const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length;
        const double aside =
            std::abs((b.x - a.x) * (a.y - p.y) - (a.x - p.x) * (b.y - a.y)) / length;
        distance = along < 0.0      ? distance
                   : along > length ? std::hypot(p.x - b.x, p.y - b.y)
                                    : aside;
      }
      if (distance > farthest) {
        farthest = distance;
        which = i;
      }
    }
    if (farthest <= tolerance) continue;
    stays[which] = 1;
    open.emplace_back(first, which);
    open.emplace_back(which, last);
  }
  Run kept;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (stays[i] != 0) kept.push_back(run[i]);
  }
  return kept;
}

std::string path_of(const Run& run) {
  std::string path;
  char command = 'M';
  for (const auto& point : run) {
    path += fmt::format("{}{:.2f} {:.2f}", command, point.x, point.y);
    command = 'L';
  }
  return path;
}

std::string band_svg(const FigureSeries& series, const SeriesLook& look, const PlotAxis& x,
                     const PlotAxis& y) {
  std::string path;
  Run upper, lower;
  const auto close = [&] {
    if (upper.size() > 1) {
      Run around = without_needless_points(upper);
      const Run back = without_needless_points(lower);
      around.insert(around.end(), back.rbegin(), back.rend());
      path += path_of(around) + "Z";
    }
    upper.clear();
    lower.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double place = x.at(series.x[i]);
    // A lower end at or below zero of a logarithmic axis is at its foot.
    double low = y.at(series.y_lower[i]);
    const double high = y.at(series.y_upper[i]);
    if (!std::isfinite(low) && std::isfinite(series.y_lower[i])) low = y.start;
    if (!std::isfinite(place) || !std::isfinite(low) || !std::isfinite(high)) {
      close();
      continue;
    }
    upper.push_back({achievable_limits(x, place), achievable_limits(y, high)});
    lower.push_back({achievable_limits(x, place), achievable_limits(y, low)});
  }
  close();
  if (path.empty()) return {};
  return fmt::format(R"(<path class="band" d="{}" fill="{}" fill-opacity="0.16" stroke="none"/>)",
                     path, look.colour);
}

std::string hatching(const Box& box, double slope, const char* colour) {
  constexpr double spacing = 5.0;
  std::string path;
  const double width = box.right - box.left, height = box.bottom - box.top;
  const double rise = std::abs(slope) * width;
  for (double start = spacing; start < height + rise; start += spacing) {
    // The line falls from (0, start) by `rise` over the width, seen from a lower corner.
    const double from = std::max(0.0, (start - height) / std::abs(slope));
    const double to = std::min(width, start / std::abs(slope));
    if (!(to > from)) continue;
    const auto x_of = [&](double along) {
      return slope > 0.0 ? box.left + along : box.right - along;
    };
    const auto y_of = [&](double along) {
      return box.bottom - height + (start - along * std::abs(slope));
    };
    path += fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", x_of(from), y_of(from), x_of(to), y_of(to));
  }
  if (path.empty()) return {};
  return fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="0.7"/>)", path, colour);
}

std::string bar_svg(const Box& box, const SeriesLook& look) {
  std::string svg = fmt::format(
      R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}" fill-opacity="{}" )"
      R"(stroke="{}" stroke-width="0.8"/>)",
      box.left, box.top, box.right - box.left, box.bottom - box.top, look.colour, look.fill,
      look.colour);
  if (look.hatch != 0.0) svg += hatching(box, look.hatch, look.colour);
  return svg;
}

std::string bars_svg(const FigureSeries& series, const SeriesLook& look, const PlotAxis& x,
                     const PlotAxis& y, bool along_x, const BarFraction& fraction,
                     LabelPlacement& labels) {
  const PlotAxis& value_axis = along_x ? x : y;
  const PlotAxis& stand_axis = along_x ? y : x;
  const auto& values = along_x ? series.x : series.y;
  const auto& stands = along_x ? series.y : series.x;
  const auto& lower = along_x ? series.x_lower : series.y_lower;
  const auto& upper = along_x ? series.x_upper : series.y_upper;
  const bool spans = !lower.empty() && !upper.empty();
  const double width = bar_width(series, fraction.categories);
  const double each = spans ? width : width / static_cast<double>(fraction.count);
  const double offset =
      spans ? -0.5 * width : -0.5 * width + static_cast<double>(fraction.index) * each;
  std::string svg;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    double from = value_axis.at(spans ? lower[i] : 0.0);
    const double to = value_axis.at(spans ? upper[i] : values[i]);
    if (!std::isfinite(from)) from = value_axis.start;  // zero of a logarithmic axis
    const double side = stand_axis.at(stands[i] + offset);
    const double other =
        stand_axis.at(stands[i] + offset + (fraction.count > 1 ? 0.94 : 1.0) * each);
    if (!std::isfinite(to) || !std::isfinite(side) || !std::isfinite(other)) continue;
    const double a = achievable_limits(value_axis, from), b = achievable_limits(value_axis, to);
    const Box box =
        along_x ? Box{std::min(a, b), std::min(side, other), std::max(a, b), std::max(side, other)}
                : Box{std::min(side, other), std::min(a, b), std::max(side, other), std::max(a, b)};
    svg += bar_svg(box, look);
    for (double level = box.top; level < box.bottom; level += 3.0) {
      labels.avoid_segment(box.left, level, box.right, level);
    }
  }
  return svg;
}

// The end of a whisker along x at (along, across), or along y with the two exchanged: a cap, or an
// arrow to what lies beyond the plot (outwards = 1 or -1).
std::string whisker_end(double along, double across, int outwards, bool along_x) {
  const auto point = [along_x](double a, double b) {
    return along_x ? fmt::format("{:.2f} {:.2f}", a, b) : fmt::format("{:.2f} {:.2f}", b, a);
  };
  constexpr double half = 3.0, length = 6.0;
  const double foot = along - length * outwards;
  return fmt::format("M{}L{}L{}", point(foot, across - half), point(along, across),
                     point(foot, across + half));
}

// An interval of a point at `across` on the other axis, cut off at the plot's edges. Empty where an
// end is not finite.
std::string whisker(const PlotAxis& axis, double low_value, double high_value, double across,
                    bool along_x, bool with_ends, LabelPlacement& labels) {
  double low = axis.at(low_value);
  // A lower end at or below zero of a logarithmic axis is at its foot.
  if (!std::isfinite(low) && std::isfinite(low_value)) low = axis.start;
  const double high = axis.at(high_value);
  if (!std::isfinite(low) || !std::isfinite(high)) return {};
  const double minimum = std::min(axis.start, axis.end), maximum = std::max(axis.start, axis.end);
  const double a = std::clamp(low, minimum, maximum), b = std::clamp(high, minimum, maximum);
  std::string path = along_x ? fmt::format("M{:.2f} {:.2f}H{:.2f}", a, across, b)
                             : fmt::format("M{:.2f} {:.2f}V{:.2f}", across, a, b);
  if (along_x) {
    labels.avoid_segment(a, across, b, across);
  } else {
    labels.avoid_segment(across, a, across, b);
  }
  if (!with_ends) return path;
  constexpr double seen = 0.5;  // px beyond the edge
  for (const auto& [end, place] : {std::pair{low, a}, std::pair{high, b}}) {
    const int outwards = end > place + seen ? 1 : end < place - seen ? -1 : 0;
    path += whisker_end(place, across, outwards, along_x);
  }
  return path;
}

}  // namespace

std::string marker_path(int shape, double x, double y, double size) {
  const double r = 0.5 * size;
  const auto polygon = [&](const std::vector<Point>& corners) {
    std::string path;
    for (const auto& corner : corners) {
      path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? 'M' : 'L', x + r * corner.x,
                          y + r * corner.y);
    }
    return path + "Z";
  };
  switch (shape) {
    case 1:
      return polygon({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
    case 2:
      return polygon({{0.0, -1.15}, {1.05, 0.8}, {-1.05, 0.8}});
    case 3:
      return polygon({{0.0, -1.25}, {1.1, 0.0}, {0.0, 1.25}, {-1.1, 0.0}});
    case 4:
      return polygon({{0.0, 1.15}, {1.05, -0.8}, {-1.05, -0.8}});
    case 5:
      return polygon({{-0.35, -1.1},
                      {0.35, -1.1},
                      {0.35, -0.35},
                      {1.1, -0.35},
                      {1.1, 0.35},
                      {0.35, 0.35},
                      {0.35, 1.1},
                      {-0.35, 1.1},
                      {-0.35, 0.35},
                      {-1.1, 0.35},
                      {-1.1, -0.35},
                      {-0.35, -0.35}});
    case 6:
      return polygon({{0.8, 0.0}, {1.2, 1.0}, {-1.2, 1.0}, {-0.8, 0.0}, {-1.2, -1.0}, {1.2, -1.0}});
    case 7:
      return polygon({{0.0, -1.2}, {1.15, -0.35}, {0.7, 1.0}, {-0.7, 1.0}, {-1.15, -0.35}});
    default:
      return fmt::format(
          "M{:.2f} {:.2f}a{:.2f} {:.2f} 0 1 0 {:.2f} 0a{:.2f} {:.2f} 0 1 0 {:.2f} 0Z", x - r, y, r,
          r, 2.0 * r, r, r, -2.0 * r);
  }
}

std::string curve_svg(const FigureSeries& series, std::size_t index, const PlotAxis& x,
                      const PlotAxis& y, bool along_x, const BarFraction& fraction,
                      LabelPlacement& labels) {
  const SeriesLook look = series_look(index);
  if (series.style == SeriesStyle::bars) {
    return bars_svg(series, look, x, y, along_x, fraction, labels);
  }
  if (series.style == SeriesStyle::points) return {};
  std::string svg;
  if (!series.y_lower.empty() && !series.y_upper.empty() &&
      series.style != SeriesStyle::line_and_points) {
    svg += band_svg(series, look, x, y);
  }
  std::string path;
  for (const auto& run : runs_of(series, series.y, x, y)) {
    const Run kept = without_needless_points(run);
    path += path_of(kept);
    // A single value between gaps is a dot.
    if (kept.size() == 1) path += "h0.01";
    for (std::size_t i = 1; i < kept.size(); ++i) {
      labels.avoid_segment(kept[i - 1].x, kept[i - 1].y, kept[i].x, kept[i].y);
    }
  }
  if (path.empty()) return svg;
  const std::string dashes = series.style == SeriesStyle::dashed ? look.short_dashes : look.dashes;
  svg += fmt::format(
      R"(<path class="curve" d="{}" fill="none" stroke="{}" stroke-width="1.5" )"
      R"(stroke-linejoin="round"{}/>)",
      path, look.colour,
      dashes.empty() ? std::string() : fmt::format(R"( stroke-dasharray="{}")", dashes));
  return svg;
}

std::string points_svg(const FigureSeries& series, std::size_t index, const PlotAxis& x,
                       const PlotAxis& y, LabelPlacement& labels) {
  if (series.style != SeriesStyle::points && series.style != SeriesStyle::line_and_points)
    return {};
  const SeriesLook look = series_look(index);
  const bool many = series.x.size() > 60;
  const bool marks_clipped = series.style == SeriesStyle::points && !many;
  const bool spans_x = !series.x_lower.empty() && !series.x_upper.empty();
  const bool spans_y = !series.y_lower.empty() && !series.y_upper.empty();
  // Many points are small, so that they stay points.
  const double size = series.x.size() > 200 ? 3.0 : many ? 4.5 : 6.5;
  std::string whiskers, markers;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Point at{x.at(series.x[i]), y.at(series.y[i])};
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
    const bool within_x = x.shows(series.x[i]), within_y = y.shows(series.y[i]);
    if (within_y && spans_x) {
      whiskers += whisker(x, series.x_lower[i], series.x_upper[i], at.y, true, !many, labels);
    }
    if (within_x && spans_y) {
      whiskers += whisker(y, series.y_lower[i], series.y_upper[i], at.x, false, !many, labels);
    }
    if (marks_clipped && within_y && !within_x && !spans_x) {
      whiskers += whisker(x, series.x[i], series.x[i], at.y, true, true, labels);
    }
    if (marks_clipped && within_x && !within_y && !spans_y) {
      whiskers += whisker(y, series.y[i], series.y[i], at.x, false, true, labels);
    }
    if (!within_x || !within_y) continue;
    markers += marker_path(look.marker, at.x, at.y, size);
    for (const double level : {-0.4, 0.0, 0.4}) {
      labels.avoid_segment(at.x - 0.5 * size, at.y + level * size, at.x + 0.5 * size,
                           at.y + level * size);
    }
  }
  std::string svg;
  if (!whiskers.empty()) {
    svg +=
        fmt::format(R"(<path class="interval" d="{}" fill="none" stroke="{}" stroke-width="1"/>)",
                    whiskers, look.colour);
  }
  if (!markers.empty()) {
    svg += fmt::format(R"(<path class="points" d="{}" fill="{}" stroke="#fff" stroke-width="{}"/>)",
                       markers, look.colour, size > 4.0 ? 0.6 : 0.0);
  }
  return svg;
}

std::string legend_sample_svg(const FigureSeries& series, std::size_t index, double x, double y) {
  const SeriesLook look = series_look(index);
  if (series.style == SeriesStyle::bars) return bar_svg({x - 9.0, y - 5.0, x + 9.0, y + 5.0}, look);
  std::string svg;
  if (series.style != SeriesStyle::points) {
    const std::string dashes =
        series.style == SeriesStyle::dashed ? look.short_dashes : look.dashes;
    svg += fmt::format(
        R"(<path d="M{:.2f} {:.2f}h26" fill="none" stroke="{}" stroke-width="1.5"{}/>)", x - 13.0,
        y, look.colour,
        dashes.empty() ? std::string() : fmt::format(R"( stroke-dasharray="{}")", dashes));
  }
  if (series.style == SeriesStyle::points || series.style == SeriesStyle::line_and_points) {
    svg += fmt::format(R"(<path d="{}" fill="{}"/>)", marker_path(look.marker, x, y, 6.5),
                       look.colour);
  }
  return svg;
}

}  // namespace boresight::app
