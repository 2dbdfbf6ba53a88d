#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/figures/panel_labels.hpp>
#include <boresight/app/figures/plot_axis.hpp>
#include <boresight/app/figures/series_look.hpp>
#include <boresight/app/figures/svg_text.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

constexpr double line_height = 13.0;
constexpr double descent = 3.0;  // of a line of text below its foot

std::string halo_text(double x, double y, const std::string& text, const char* colour,
                      bool upright = false) {
  const std::string place =
      upright ? fmt::format("transform=\"translate({:.2f} {:.2f}) rotate(-90)\"", x, y)
              : fmt::format(R"(x="{:.2f}" y="{:.2f}")", x, y);
  return fmt::format(
      R"(<text class="label" {} font-size="{}" fill="{}" stroke="#fff" stroke-width="3" )"
      R"(stroke-linejoin="round" paint-order="stroke">{}</text>)",
      place, label_text, colour, escaped_html(text));
}

Box text_box(double left, double foot, double width) {
  return {left - 1.0, foot - line_height + descent, left + width + 1.0, foot + descent};
}

// The box moved into the plot where it would stick out.
Box kept_within(Box box, const Box& plot) {
  const double right = std::min(0.0, plot.right - box.right);
  const double left = std::max(0.0, plot.left - box.left);
  const double down = std::max(0.0, plot.top - box.top);
  const double up = std::min(0.0, plot.bottom - box.bottom);
  box.left += right + left;
  box.right += right + left;
  box.top += down + up;
  box.bottom += down + up;
  return box;
}

std::string text_in(const Box& box, const std::string& text, const char* colour) {
  return halo_text(box.left + 1.0, box.bottom - descent, text, colour);
}

// Places all around a point, the nearer the better, right above it the best.
std::vector<LabelPlace> around(double x, double y, double width, double reach) {
  std::vector<LabelPlace> places;
  constexpr double height = line_height;
  for (const double distance : {6.0, 14.0, 24.0, 36.0, 52.0, 72.0, 96.0, 124.0}) {
    if (distance > reach) break;
    const double diagonal = 0.7 * distance;
    const double near = 0.12 * (distance - 6.0);
    const auto add = [&](double left, double top, double penalty) {
      places.push_back({{left - 1.0, top, left + width + 1.0, top + height}, near + penalty});
    };
    add(x + diagonal, y - diagonal - height, 0.0);
    add(x + distance, y - 0.5 * height, 0.2);
    add(x - 0.5 * width, y - distance - height, 0.3);
    add(x + diagonal, y + diagonal, 0.4);
    add(x - diagonal - width, y - diagonal - height, 0.5);
    add(x - distance - width, y - 0.5 * height, 0.6);
    add(x - 0.5 * width, y + distance, 0.7);
    add(x - diagonal - width, y + diagonal, 0.8);
  }
  return places;
}

// Beside a point in its row, so that it is plain which of the rows it belongs to: beside the bar,
// or on it where there is no room.
std::vector<LabelPlace> in_row(double x, double y, double width) {
  std::vector<LabelPlace> places;
  for (double distance = 5.0; distance < 400.0; distance += 6.0) {
    for (const double left : {x + distance, x - distance - width}) {
      places.push_back(
          {text_box(left, y + 4.0, width), 0.05 * (distance - 5.0) + (left > x ? 0.0 : 0.2)});
    }
  }
  return places;
}

// From a point to the label that is some way off.
std::string leader(double x, double y, const Box& box) {
  const double to_x = std::clamp(x, box.left, box.right);
  const double to_y = std::clamp(y, box.top, box.bottom);
  const double length = std::hypot(to_x - x, to_y - y);
  if (length < 11.0) return {};
  const double start = 4.5 / length;
  return fmt::format(
      R"(<path class="leader" d="M{:.2f} {:.2f}L{:.2f} {:.2f}" fill="none" stroke="#777" )"
      R"(stroke-width="0.6"/>)",
      x + start * (to_x - x), y + start * (to_y - y), to_x, to_y);
}

std::string named_point(double x, double y, const std::string& label, const char* colour, bool must,
                        bool rows, const PlacedPanel& placed, LabelPlacement& placement) {
  if (label.empty()) return {};
  const double width = text_width(label, label_text);
  const auto places = rows ? in_row(x, y, width) : around(x, y, width, must ? 1e3 : 30.0);
  const auto chosen = placement.place(places);
  // A name so long stands nowhere without being over others.
  const bool sentence = width > 0.5 * (placed.plot.right - placed.plot.left);
  if (!chosen && (!must || sentence)) return {};
  const Box box = chosen ? places[*chosen].box : kept_within(places.front().box, placed.plot);
  return (rows ? std::string() : leader(x, y, box)) + text_in(box, label, colour);
}

std::string horizontal_label(const FigureLine& line, const PlacedPanel& placed,
                             LabelPlacement& placement) {
  const double y = placed.y.at(line.at);
  const double width = text_width(line.label, label_text);
  std::vector<LabelPlace> places;
  const double room = placed.plot.right - placed.plot.left - width - 8.0;
  for (int step = 0; step <= 12; ++step) {
    const double left = placed.plot.right - 4.0 - width - std::max(0.0, room) * step / 12.0;
    places.push_back({text_box(left, y - descent - 1.0, width), 0.25 * step});
    places.push_back({text_box(left, y + line_height - 2.0, width), 0.25 * step + 0.6});
  }
  const auto chosen = placement.place(places);
  return text_in(chosen ? places[*chosen].box : kept_within(places.front().box, placed.plot),
                 line.label, "#333");
}

// Along the line, reading upwards; beside it where the panel is too low for that or all is taken.
std::string vertical_label(const FigureLine& line, const PlacedPanel& placed,
                           LabelPlacement& placement) {
  const double x = placed.x.at(line.at);
  const double width = text_width(line.label, label_text);
  std::vector<LabelPlace> places;
  const double room = placed.plot.bottom - placed.plot.top - width - 8.0;
  constexpr int steps = 24;
  for (int step = 0; step <= steps && room > 0.0; ++step) {
    const double top = placed.plot.top + 4.0 + room * step / steps;
    for (const double left : {x + 2.0, x - 2.0 - line_height}) {
      places.push_back({{left, top, left + line_height, top + width + 2.0},
                        3.2 * step / steps + (left > x ? 0.0 : 0.3)});
    }
  }
  const std::size_t upright = places.size();
  const double height = placed.plot.bottom - placed.plot.top - line_height - 4.0;
  for (int step = 0; step <= steps; ++step) {
    const double foot = placed.plot.top + line_height + height * step / steps;
    for (const double left : {x + 4.0, x - 4.0 - width}) {
      places.push_back(
          {text_box(left, foot, width), 6.0 + 3.2 * step / steps + (left > x ? 0.0 : 0.3)});
    }
  }
  const auto chosen = placement.place(places);
  if (chosen && *chosen < upright) {
    const Box& box = places[*chosen].box;
    return halo_text(box.right - descent, box.bottom - 1.0, line.label, "#333", true);
  }
  return text_in(chosen ? places[*chosen].box : kept_within(places[upright].box, placed.plot),
                 line.label, "#333");
}

std::string circle_label(const FigureCircle& circle, const PlacedPanel& placed,
                         LabelPlacement& placement) {
  const double width = text_width(circle.label, label_text);
  const double rx = std::abs(placed.x.at(circle.x + circle.radius) - placed.x.at(circle.x));
  const double ry = std::abs(placed.y.at(circle.y + circle.radius) - placed.y.at(circle.y));
  std::vector<LabelPlace> places;
  for (int step = 0; step < 16; ++step) {
    const double angle = two_pi * step / 16.0;
    const double x = placed.x.at(circle.x) - (rx + 4.0) * std::cos(angle);
    const double y = placed.y.at(circle.y) - (ry + 4.0) * std::sin(angle);
    const double left = x - 0.5 * width * (1.0 + std::cos(angle));
    const double foot = y + 4.0 - 6.0 * std::sin(angle);
    places.push_back({text_box(left, foot, width), 0.05 * step});
  }
  const auto chosen = placement.place(places);
  return text_in(chosen ? places[*chosen].box : kept_within(places.front().box, placed.plot),
                 circle.label, "#333");
}

}  // namespace

std::string panel_labels_svg(const FigurePanel& panel, const PlacedPanel& placed,
                             const SeriesLooks& looks, LabelPlacement& placement) {
  // So few points are all named, as marks are.
  constexpr std::size_t few = 15;
  std::string svg;
  const bool rows = bars_along_x(panel);
  const auto shown = [&](double x, double y) { return placed.x.shows(x) && placed.y.shows(y); };
  for (const auto& mark : panel.marks) {
    if (!shown(mark.x, mark.y)) continue;
    const double x = placed.x.at(mark.x), y = placed.y.at(mark.y);
    placement.avoid({x - 4.0, y - 4.0, x + 4.0, y + 4.0});
    svg += fmt::format(
        R"(<circle class="mark" cx="{:.2f}" cy="{:.2f}" r="3.6" fill="#fff" stroke="#111" )"
        R"(stroke-width="1.2"/>)",
        x, y);
  }
  for (const auto& mark : panel.marks) {
    if (!shown(mark.x, mark.y)) continue;
    svg += named_point(placed.x.at(mark.x), placed.y.at(mark.y), mark.label, "#111", true, rows,
                       placed, placement);
  }
  for (const auto& series : panel.series) {
    for (std::size_t i = 0; i < series.labels.size(); ++i) {
      if (!shown(series.x[i], series.y[i])) continue;
      svg += named_point(placed.x.at(series.x[i]), placed.y.at(series.y[i]), series.labels[i],
                         rows ? "#111" : series_look(looks.at(series.name)).colour,
                         series.labels.size() <= few, rows, placed, placement);
    }
  }
  // The longest first: the shorter ones find room between them.
  std::vector<const FigureLine*> lines;
  for (const auto& line : panel.lines) {
    if (!line.label.empty()) lines.push_back(&line);
  }
  std::ranges::stable_sort(lines, std::greater{}, [](const FigureLine* line) {
    return text_width(line->label, label_text);
  });
  for (const FigureLine* const labelled : lines) {
    const FigureLine& line = *labelled;
    if (line.direction == FigureLine::Direction::horizontal && placed.y.shows(line.at)) {
      svg += horizontal_label(line, placed, placement);
    }
    if (line.direction == FigureLine::Direction::vertical && placed.x.shows(line.at)) {
      svg += vertical_label(line, placed, placement);
    }
  }
  for (const auto& circle : panel.circles) {
    if (!circle.label.empty()) svg += circle_label(circle, placed, placement);
  }
  return svg;
}

}  // namespace boresight::app
