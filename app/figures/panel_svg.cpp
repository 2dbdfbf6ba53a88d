#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/figures/panel_labels.hpp>
#include <boresight/app/figures/panel_svg.hpp>
#include <boresight/app/figures/series_svg.hpp>
#include <boresight/app/figures/svg_text.hpp>

namespace boresight::app {
namespace {

constexpr double turn = 35.0;  // degrees

std::string grid_svg(const FigurePanel& panel, const PlacedPanel& placed, bool x_categories) {
  const Box& plot = placed.plot;
  std::string major, minor;
  const auto upright = [&](std::string& path, double value) {
    path += fmt::format("M{:.2f} {:.2f}V{:.2f}", placed.x.at(value), plot.top, plot.bottom);
  };
  const auto level = [&](std::string& path, double value) {
    path += fmt::format("M{:.2f} {:.2f}H{:.2f}", plot.left, placed.y.at(value), plot.right);
  };
  if (!x_categories) {
    for (const double value : placed.x_ticks.major) upright(major, value);
    for (const double value : placed.x_ticks.minor) upright(minor, value);
  }
  if (panel.y.categories.empty()) {
    for (const double value : placed.y_ticks.major) level(major, value);
    for (const double value : placed.y_ticks.minor) level(minor, value);
  }
  std::string svg = R"(<g class="grid" fill="none">)";
  if (!minor.empty()) {
    svg += fmt::format(R"(<path d="{}" stroke="#f0f0f0" stroke-width="0.6"/>)", minor);
  }
  if (!major.empty()) {
    svg += fmt::format(R"(<path d="{}" stroke="#dcdcdc" stroke-width="0.7"/>)", major);
  }
  return svg + "</g>";
}

std::string frame_svg(const FigurePanel& panel, const PlacedPanel& placed) {
  const Box& plot = placed.plot;
  std::string ticks;
  for (const double value : placed.x_ticks.major) {
    ticks += fmt::format("M{:.2f} {:.2f}v4", placed.x.at(value), plot.bottom);
  }
  for (const double value : placed.x_ticks.minor) {
    ticks += fmt::format("M{:.2f} {:.2f}v2", placed.x.at(value), plot.bottom);
  }
  if (panel.y.categories.empty()) {
    for (const double value : placed.y_ticks.major) {
      ticks += fmt::format("M{:.2f} {:.2f}h-4", plot.left, placed.y.at(value));
    }
    for (const double value : placed.y_ticks.minor) {
      ticks += fmt::format("M{:.2f} {:.2f}h-2", plot.left, placed.y.at(value));
    }
  }
  std::string zero;
  if (placed.y.scale == AxisScale::linear && placed.y.from < 0.0 && placed.y.to > 0.0 &&
      panel.y.categories.empty()) {
    zero += fmt::format("M{:.2f} {:.2f}H{:.2f}", plot.left, placed.y.at(0.0), plot.right);
  }
  if (placed.x.scale == AxisScale::linear && placed.x.from < 0.0 && placed.x.to > 0.0 &&
      placed.x.from != -0.5) {
    zero += fmt::format("M{:.2f} {:.2f}V{:.2f}", placed.x.at(0.0), plot.top, plot.bottom);
  }
  std::string svg;
  if (!zero.empty()) {
    svg = fmt::format(
        R"(<path class="zero" d="{}" fill="none" stroke="#9a9a9a" stroke-width="0.8"/>)", zero);
  }
  return svg +
         fmt::format(
             R"(<path class="axis" d="M{:.2f} {:.2f}V{:.2f}H{:.2f}{}" fill="none" stroke="#333" )"
             R"(stroke-width="0.9"/>)",
             plot.left, plot.top, plot.bottom, plot.right, ticks);
}

std::string tick_label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="{}">{}</text>)", x, y, anchor,
                     escaped_html(text));
}

std::string x_names(const FigureAxis& axis, const PlacedPanel& placed) {
  const double slot =
      (placed.plot.right - placed.plot.left) / static_cast<double>(axis.categories.size());
  const bool turned = categories_are_turned(axis, slot);
  std::string svg;
  for (std::size_t i = 0; i < axis.categories.size(); ++i) {
    const double x = placed.x.at(static_cast<double>(i));
    double y = placed.plot.bottom + 15.0;
    if (turned) {
      svg += fmt::format(
          "<text transform=\"translate({:.2f} {:.2f}) rotate(-{})\" text-anchor=\"end\">{}</text>",
          x + 4.0, y - 2.0, turn, escaped_html(axis.categories[i]));
      continue;
    }
    for (const auto& line : category_lines(axis.categories[i], slot)) {
      svg += tick_label(x, y, "middle", line);
      y += 13.0;
    }
  }
  return svg;
}

std::string tick_labels_svg(const FigureAxis& x, const FigurePanel& panel,
                            const PlacedPanel& placed) {
  const Box& plot = placed.plot;
  std::string svg = fmt::format(R"(<g class="ticks" font-size="{}" fill="#333">)", tick_text);
  if (placed.lowest && !x.categories.empty()) svg += x_names(x, placed);
  if (placed.lowest && x.categories.empty()) {
    for (std::size_t i = 0; i < placed.x_ticks.major.size(); ++i) {
      svg += tick_label(placed.x.at(placed.x_ticks.major[i]), plot.bottom + 18.0, "middle",
                        placed.x_ticks.labels[i]);
    }
  }
  for (std::size_t i = 0; i < placed.y_ticks.major.size(); ++i) {
    const double y = placed.y.at(placed.y_ticks.major[i]);
    if (panel.y.categories.empty()) {
      svg += tick_label(plot.left - 7.0, y + 4.0, "end", placed.y_ticks.labels[i]);
      continue;
    }
    const auto lines = text_lines(placed.y_ticks.labels[i], category_width, tick_text);
    double foot = y + 4.0 - 6.5 * (static_cast<double>(lines.size()) - 1.0);
    for (const auto& line : lines) {
      svg += tick_label(plot.left - 8.0, foot, "end", line);
      foot += 13.0;
    }
  }
  return svg + "</g>";
}

std::string lines_svg(const FigurePanel& panel, const PlacedPanel& placed, LabelPlacement& labels) {
  std::string path;
  for (const auto& line : panel.lines) {
    if (line.direction == FigureLine::Direction::horizontal) {
      if (!placed.y.shows(line.at)) continue;
      const double y = placed.y.at(line.at);
      path += fmt::format("M{:.2f} {:.2f}H{:.2f}", placed.plot.left, y, placed.plot.right);
      labels.avoid_segment(placed.plot.left, y, placed.plot.right, y);
    } else {
      if (!placed.x.shows(line.at)) continue;
      const double x = placed.x.at(line.at);
      path += fmt::format("M{:.2f} {:.2f}V{:.2f}", x, placed.plot.top, placed.plot.bottom);
      labels.avoid_segment(x, placed.plot.top, x, placed.plot.bottom);
    }
  }
  if (path.empty()) return {};
  return fmt::format(R"(<path class="line" d="{}" fill="none" stroke="#555" stroke-width="0.9" )"
                     R"(stroke-dasharray="1.5 2"/>)",
                     path);
}

std::string circles_svg(const FigurePanel& panel, const PlacedPanel& placed,
                        LabelPlacement& labels) {
  std::string svg;
  for (const auto& circle : panel.circles) {
    const double x = placed.x.at(circle.x), y = placed.y.at(circle.y);
    const double rx = std::abs(placed.x.at(circle.x + circle.radius) - x);
    const double ry = std::abs(placed.y.at(circle.y + circle.radius) - y);
    svg += fmt::format(
        R"(<ellipse class="circle" cx="{:.2f}" cy="{:.2f}" rx="{:.2f}" ry="{:.2f}" fill="#000" )"
        R"(fill-opacity="0.05" stroke="#555" stroke-width="0.9" stroke-dasharray="1.5 2"/>)",
        x, y, rx, ry);
    for (int i = 0; i < 48; ++i) {
      const double a = 0.1309 * i, b = 0.1309 * (i + 1);
      labels.avoid_segment(x + rx * std::cos(a), y + ry * std::sin(a), x + rx * std::cos(b),
                           y + ry * std::sin(b));
    }
  }
  return svg;
}

bool stands_side_by_side(const FigureSeries& series, bool along_x) {
  return series.style == SeriesStyle::bars &&
         (along_x ? series.x_lower.empty() : series.y_lower.empty());
}

}  // namespace

std::vector<std::string> category_lines(const std::string& name, double width) {
  return text_lines(name, width - 6.0, tick_text);
}

bool categories_are_turned(const FigureAxis& axis, double width) {
  return std::any_of(axis.categories.begin(), axis.categories.end(), [&](const auto& name) {
    const auto lines = category_lines(name, width);
    return lines.size() > 3 || std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
             return text_width(line, tick_text) > width - 4.0;
           });
  });
}

std::string panel_svg(const FigureAxis& x, const FigurePanel& panel, const PlacedPanel& placed,
                      const SeriesLooks& looks) {
  const Box& plot = placed.plot;
  LabelPlacement labels(plot);
  const auto scale = [](const PlotAxis& axis) {
    return axis.scale == AxisScale::logarithmic ? "logarithmic" : "linear";
  };
  std::string svg =
      fmt::format(R"(<g class="panel" data-left="{:.2f}" data-right="{:.2f}" data-top="{:.2f}" )"
                  R"(data-bottom="{:.2f}" )"
                  R"(data-x-scale="{}" data-x-from="{:.9g}" data-x-to="{:.9g}" data-y-scale="{}" )"
                  R"(data-y-from="{:.9g}" data-y-to="{:.9g}">)",
                  plot.left, plot.right, plot.top, plot.bottom, scale(placed.x), placed.x.from,
                  placed.x.to, scale(placed.y), placed.y.from, placed.y.to);
  svg += grid_svg(panel, placed, !x.categories.empty());
  // A nested <svg> cuts off what lies beyond the panel's edges.
  svg +=
      fmt::format(R"(<svg class="plot" x="{0:.2f}" y="{1:.2f}" width="{2:.2f}" height="{3:.2f}" )"
                  R"(viewBox="{0:.2f} {1:.2f} {2:.2f} {3:.2f}">)",
                  plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
  if (placed.y.shows(0.0)) {
    labels.avoid_segment(plot.left, placed.y.at(0.0), plot.right, placed.y.at(0.0));
  }
  svg += circles_svg(panel, placed, labels);
  const bool along_x = bars_along_x(panel);
  BarFraction fraction{0, 0, along_x || !x.categories.empty()};
  for (const auto& series : panel.series)
    fraction.count += stands_side_by_side(series, along_x) ? 1 : 0;
  fraction.count = std::max<std::size_t>(fraction.count, 1);
  const auto group = [&](const FigureSeries& series) {
    const std::size_t look = looks.at(series.name);
    return fmt::format(R"(<g class="series series-{}">)", look);
  };
  for (const auto& series : panel.series) {
    const std::string curve =
        curve_svg(series, looks.at(series.name), placed.x, placed.y, along_x, fraction, labels);
    if (stands_side_by_side(series, along_x)) ++fraction.index;
    if (!curve.empty()) svg += group(series) + curve + "</g>";
  }
  svg += lines_svg(panel, placed, labels);
  svg += "</svg>";
  svg += frame_svg(panel, placed);
  for (const auto& series : panel.series) {
    const std::string points =
        points_svg(series, looks.at(series.name), placed.x, placed.y, labels);
    if (!points.empty()) svg += group(series) + points + "</g>";
  }
  svg += panel_labels_svg(panel, placed, looks, labels);
  return svg + tick_labels_svg(x, panel, placed) + "</g>";
}

}  // namespace boresight::app
