#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/app/figures/panel_svg.hpp>
#include <boresight/app/figures/series_svg.hpp>
#include <boresight/app/figures/svg_text.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

constexpr double drawing_width = 720.0;
constexpr double legend_row = 18.0;
constexpr double sample_room = 34.0;  // of a legend's sample with its gap
constexpr double entry_gap = 20.0;

struct LegendEntry {
  const FigureSeries* series = nullptr;
  std::size_t look = 0;
  double x = 0.0;
  int row = 0;
};
using Legend = std::vector<LegendEntry>;

void require_lengths(const Figure& figure, const FigureSeries& series) {
  const auto require = [&](const char* what, std::size_t found, bool optional) {
    if (found == series.x.size() || (optional && found == 0)) return;
    throw InvalidInput(
        fmt::format("to_svg: figure '{}': expected {} values of {} in series '{}', found {}",
                    figure.id, series.x.size(), what, series.name, found));
  };
  require("y", series.y.size(), false);
  require("x_lower", series.x_lower.size(), true);
  require("x_upper", series.x_upper.size(), true);
  require("y_lower", series.y_lower.size(), true);
  require("y_upper", series.y_upper.size(), true);
  require("labels", series.labels.size(), true);
}

// By first appearance; a series without a name that is alone in its panel looks like the first.
SeriesLooks looks_of(const Figure& figure) {
  SeriesLooks looks;
  bool alone = true;
  for (const auto& panel : figure.panels) {
    for (const auto& series : panel.series) {
      if (!series.name.empty()) looks.emplace(series.name, looks.size());
      if (series.name.empty() && panel.series.size() > 1) alone = false;
    }
  }
  looks.emplace("", alone ? 0 : looks.size());
  return looks;
}

Legend legend_of(const FigurePanel& panel, const SeriesLooks& looks) {
  Legend legend;
  for (const auto& series : panel.series) {
    const bool there = std::any_of(legend.begin(), legend.end(), [&](const LegendEntry& entry) {
      return entry.series->name == series.name;
    });
    if (!series.name.empty() && !there) legend.push_back({&series, looks.at(series.name)});
  }
  return legend;
}

std::vector<std::size_t> looks_in(const Legend& legend) {
  std::vector<std::size_t> looks;
  for (const auto& entry : legend) looks.push_back(entry.look);
  std::sort(looks.begin(), looks.end());
  return looks;
}

// Lays a legend out in rows from `left` to `right`, the first row from `start` on. Returns how many
// rows there are.
int lay_out(Legend& legend, double start, double left, double right) {
  double x = start;
  int row = 0;
  for (auto& entry : legend) {
    const double width = sample_room + text_width(entry.series->name, label_text);
    if (x + width > right && x > left) {
      ++row;
      x = left;
    }
    entry.x = x;
    entry.row = row;
    x += width + entry_gap;
  }
  return legend.empty() ? 0 : row + 1;
}

std::string legend_svg(const Legend& legend, double foot) {
  if (legend.empty()) return {};
  std::string svg = fmt::format(R"(<g class="legend" font-size="{}" fill="#222">)", label_text);
  for (const auto& entry : legend) {
    const double y = foot + legend_row * entry.row;
    svg += fmt::format(R"(<g class="series-{}">)", entry.look) +
           legend_sample_svg(*entry.series, entry.look, entry.x + 13.0, y - 4.0) +
           fmt::format(R"(<text x="{:.2f}" y="{:.2f}">{}</text></g>)", entry.x + sample_room, y,
                       escaped_html(entry.series->name));
  }
  return svg + "</g>";
}

std::string axis_name(const FigureAxis& axis) {
  return axis.unit.empty() ? axis.label : fmt::format("{} ({})", axis.label, axis.unit);
}

double plot_height(const Figure& figure, const FigurePanel& panel) {
  if (!panel.y.categories.empty()) {
    std::size_t lines = 1;
    for (const auto& name : panel.y.categories) {
      lines = std::max(lines, text_lines(name, category_width, tick_text).size());
    }
    const auto bars = std::count_if(panel.series.begin(), panel.series.end(), [](const auto& s) {
      return s.style == SeriesStyle::bars && s.x_lower.empty();
    });
    const double each = 13.0 * static_cast<double>(lines) + 10.0 +
                        7.0 * static_cast<double>(std::max<std::ptrdiff_t>(bars - 1, 0));
    return std::max(60.0, each * static_cast<double>(panel.y.categories.size()));
  }
  switch (figure.panels.size()) {
    case 1:
      return 300.0;
    case 2:
      return 205.0;
    default:
      return 155.0;
  }
}

double widest(const std::vector<std::string>& texts) {
  double width = 0.0;
  for (const auto& text : texts) width = std::max(width, text_width(text, tick_text));
  return width;
}

// The axes stretched so that one unit of x is as long as one of y.
void make_equal(PlotAxis& x, PlotAxis& y, double width, double height) {
  const double scale = std::min(width / (x.to - x.from), height / (y.to - y.from));
  const auto stretch = [scale](PlotAxis& axis, double room) {
    const double more = 0.5 * (room / scale - (axis.to - axis.from));
    axis.from -= more;
    axis.to += more;
  };
  stretch(x, width);
  stretch(y, height);
}

// Room below the lowest panel for the numbers or names of the x axis.
double foot_room(const FigureAxis& axis, double width) {
  if (axis.categories.empty()) return 24.0;
  const double slot = width / static_cast<double>(axis.categories.size());
  if (categories_are_turned(axis, slot)) return 24.0 + 0.58 * widest(axis.categories);
  std::size_t lines = 1;
  for (const auto& name : axis.categories)
    lines = std::max(lines, category_lines(name, slot).size());
  return 9.0 + 13.0 * static_cast<double>(lines);
}

std::string svg_of(const Figure& figure, double width, double height, const std::string& body) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" class="figure" role="img" width="{0:.0f}" )"
      R"(height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}" font-family="'DejaVu Sans', Verdana, )"
      R"(Arial, sans-serif">)"
      "<title>{2}</title><desc>{3}</desc>{4}</svg>\n",
      width, height, escaped_html(figure.title), escaped_html(figure.caption), body);
}

}  // namespace

std::string to_svg(const Figure& figure) {
  if (!figure.drawing.elements.empty()) {
    return svg_of(figure, std::ceil(std::max(figure.drawing.width, drawing_width)),
                  std::ceil(figure.drawing.height), figure.drawing.elements);
  }
  for (const auto& panel : figure.panels) {
    for (const auto& series : panel.series) require_lengths(figure, series);
  }
  const SeriesLooks looks = looks_of(figure);
  std::vector<Legend> legends;
  for (const auto& panel : figure.panels) legends.push_back(legend_of(panel, looks));
  const bool shared = std::all_of(legends.begin(), legends.end(), [&](const Legend& legend) {
    return looks_in(legend) == looks_in(legends.front());
  });

  PlotAxis x = x_range(figure);
  std::vector<PlacedPanel> placed;
  double left = 46.0;
  for (const auto& panel : figure.panels) {
    PlacedPanel next;
    next.y = y_range(figure, panel);
    if (!panel.y.categories.empty()) std::swap(next.y.from, next.y.to);  // the first at the top
    const double height = plot_height(figure, panel);
    next.y_ticks = axis_ticks(panel.y, next.y.from, next.y.to, static_cast<int>(height / 42.0));
    const double names = widest(next.y_ticks.labels);
    left = std::max(left,
                    14.0 + (panel.y.categories.empty() ? names : std::min(names, category_width)));
    placed.push_back(next);
  }
  double right = drawing_width - 18.0;
  if (figure.equal_scales) right = std::min(right, left + 460.0);
  const double width = right - left;

  double top = 6.0;
  std::string body;
  if (shared && !legends.empty()) {
    Legend& legend = legends.front();
    const int rows = lay_out(legend, left, left, drawing_width - 6.0);
    body += legend_svg(legend, top + 11.0);
    top += legend_row * rows;
  }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const FigurePanel& panel = figure.panels[i];
    PlacedPanel& here = placed[i];
    const std::string name = axis_name(panel.y);
    if (!name.empty()) {
      body += fmt::format(
          R"(<text class="name" x="{:.2f}" y="{:.2f}" font-size="{}" font-weight="600" )"
          R"(fill="#222">{}</text>)",
          left, top + 12.0, axis_text, escaped_html(name));
    }
    double head = name.empty() ? 0.0 : 20.0;
    if (!shared) {
      const double start = left + (name.empty() ? 0.0 : text_width(name, axis_text) * 1.1 + 24.0);
      const int rows = lay_out(legends[i], start, left, drawing_width - 6.0);
      body += legend_svg(legends[i], top + 12.0);
      head = std::max(head, legend_row * rows + 2.0);
    }
    top += head;
    const double height =
        figure.equal_scales
            ? std::clamp(width * (here.y.to - here.y.from) / (x.to - x.from), 220.0, 460.0)
            : plot_height(figure, panel);
    PlotAxis panel_x = x;
    if (figure.equal_scales) make_equal(panel_x, here.y, width, height);
    panel_x.start = left;
    panel_x.end = right;
    here.x = panel_x;
    here.plot = {left, top, right, top + height};
    here.y.start = top + height;
    here.y.end = top;
    here.lowest = i + 1 == placed.size();
    here.x_ticks = axis_ticks(figure.x, here.x.from, here.x.to, static_cast<int>(width / 75.0));
    here.y_ticks = axis_ticks(panel.y, here.y.from, here.y.to, static_cast<int>(height / 42.0));
    body += panel_svg(figure.x, panel, here, looks);
    top += height + (here.lowest ? foot_room(figure.x, width) : 12.0);
  }
  const std::string name = axis_name(figure.x);
  if (!name.empty()) {
    body +=
        fmt::format(R"(<text class="name" x="{:.2f}" y="{:.2f}" font-size="{}" font-weight="600" )"
                    R"(text-anchor="middle" fill="#222">{}</text>)",
                    0.5 * (left + right), top + 14.0, axis_text, escaped_html(name));
    top += 22.0;
  }
  const double full_width =
      figure.equal_scales ? std::max(right + 18.0, drawing_width) : drawing_width;
  return svg_of(figure, full_width, std::ceil(top + 2.0), body);
}

}  // namespace boresight::app
