#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/figures/block_diagram.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/svg_text.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using control::LoopPath;

constexpr double letters = 11.0;
constexpr double row_height = 15.0;
constexpr double padding = 8.0;
constexpr double gap = 26.0;  // between parts of a row: an arrow with its name
constexpr double sum_radius = 7.0;
constexpr double row_gap = 44.0;  // between the rows of the feedbacks

struct Point {
  double x = 0.0, y = 0.0;
};

// A diagram under construction, y downwards.
class Drawing {
 public:
  void arrow(const std::vector<Point>& corners) {
    line(corners);
    const Point& end = corners.back();
    const Point& before = corners[corners.size() - 2];
    const double length = std::hypot(end.x - before.x, end.y - before.y);
    const double along_x = 7.0 * (end.x - before.x) / length;
    const double along_y = 7.0 * (end.y - before.y) / length;
    svg_ += fmt::format(R"(<path class="head" d="M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z" )"
                        R"(fill="#222"/>)",
                        end.x, end.y, end.x - along_x - 0.45 * along_y,
                        end.y - along_y + 0.45 * along_x, end.x - along_x + 0.45 * along_y,
                        end.y - along_y - 0.45 * along_x);
  }

  void line(const std::vector<Point>& corners) {
    std::string path;
    for (const Point& corner : corners) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', corner.x, corner.y);
      place(signals_, corner);
    }
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    signals_.x.push_back(none);
    signals_.y.push_back(none);
    svg_ += fmt::format(
        R"(<path class="signal" d="{}" fill="none" stroke="#222" stroke-width="1.1"/>)", path);
  }

  void text(Point at, const std::string& words, const char* anchor = "middle",
            const char* weight = "normal") {
    svg_ += fmt::format(
        R"(<text x="{:.1f}" y="{:.1f}" font-size="{}" text-anchor="{}" font-weight="{}" )"
        R"(fill="#222">{}</text>)",
        at.x, at.y, letters, anchor, weight, escaped_html(words));
  }

  // About a centre; the first line is its name.
  void block(Point centre, double width, const std::vector<std::string>& lines) {
    const double height = height_of(lines);
    svg_ += fmt::format(
        R"(<rect class="block" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" rx="2" )"
        R"(fill="#fff" stroke="#222" stroke-width="1.3"/>)",
        centre.x - 0.5 * width, centre.y - 0.5 * height, width, height);
    double foot = centre.y - 0.5 * height + padding + letters - 1.0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      text({centre.x, foot}, lines[i], "middle", i == 0 ? "bold" : "normal");
      foot += row_height;
    }
    place(blocks_, centre);
    blocks_.labels.push_back(fmt::format("{}", fmt::join(lines, "; ")));
  }

  // With the sign of what enters from below.
  void sum(Point centre, const char* below) {
    svg_ += fmt::format(
        R"(<circle class="sum" cx="{:.1f}" cy="{:.1f}" r="{}" fill="#fff" stroke="#222" )"
        R"(stroke-width="1.3"/>)",
        centre.x, centre.y, sum_radius);
    text({centre.x + 12.0, centre.y + 19.0}, below);
  }

  static double height_of(const std::vector<std::string>& lines) {
    return 2.0 * padding + row_height * static_cast<double>(lines.size()) - 4.0;
  }

  static double width_of(const std::vector<std::string>& lines) {
    double width = 0.0;
    for (const auto& words : lines) width = std::max(width, text_width(words, letters));
    return width * 1.06 + 2.0 * padding;  // the first is bold
  }

  Figure figure(double width, double height) && {
    Figure figure;
    figure.x = make_axis("to the right", "");
    FigurePanel panel = make_panel(make_axis("upwards", ""));
    panel.series = {std::move(signals_), std::move(blocks_)};
    figure.panels.push_back(std::move(panel));
    figure.equal_scales = true;
    figure.drawing = {width, height, std::move(svg_)};
    return figure;
  }

 private:
  static void place(FigureSeries& series, Point at) {
    series.x.push_back(at.x);
    series.y.push_back(-at.y);
  }

  std::string svg_;
  FigureSeries signals_ = make_series("signals", SeriesStyle::line);
  FigureSeries blocks_ = make_series("blocks", SeriesStyle::points);
};

// The factors of a path, one a line, with its gains.
std::vector<std::string> path_lines(const std::string& name, LoopPath path,
                                    const control::LoopStructure& structure,
                                    const std::vector<std::string>& gains) {
  std::vector<std::string> lines{name};
  std::size_t next = 0;
  for (const auto& block : structure.blocks()) {
    const std::size_t first = next;
    next += block.gains.size();
    if (block.path != path) continue;
    std::string words = factor_text(block);
    for (std::size_t i = 0; i < block.gains.size() && !gains.empty(); ++i) {
      const bool is_factor = block.kind == control::BlockKind::gain;
      if (!is_factor) words += (i == 0 ? ":  " : ", ") + block.gains[i].symbol;
      words += " = " + gains[first + i];
    }
    lines.push_back(std::move(words));
  }
  return lines;
}

std::string equation(const control::LoopStructure& structure) {
  const bool pressure = structure.has(LoopPath::pressure);
  const bool compliance = structure.has(LoopPath::compliance);
  return fmt::format(
      "u = R (r \u2212 tachometer){}, r = P (command \u2212 {}), at the motor shaft.",
      pressure ? " \u2212 Q torque" : "", compliance ? "encoder + C torque" : "encoder");
}

// What N(s) is, of the first notch.
std::string notch_text(const control::LoopStructure& structure) {
  const auto& blocks = structure.blocks();
  const auto notch =
      std::ranges::find(blocks, control::BlockKind::notch, &control::LoopBlock::kind);
  if (notch == blocks.end()) return {};
  const auto symbol = [&](std::size_t i) { return notch->gains[i].symbol; };
  return fmt::format(
      " N(s) = (s\u00b2 + 2 {1} {0} s + {0}\u00b2)/(s\u00b2 + 2 {2} {0} s + {0}\u00b2).", symbol(0),
      symbol(1), symbol(2));
}

// Where the feedbacks leave the antenna and come back, from the first to the last row.
struct Rows {
  double main = 0.0;
  double pressure = 0.0, rate = 0.0, compliance = 0.0, position = 0.0;
};

}  // namespace

std::string factor_text(const control::LoopBlock& block) {
  const auto& first = block.gains.front().symbol;
  switch (block.kind) {
    case control::BlockKind::gain:
      return first;
    case control::BlockKind::integral:
      return fmt::format("1 + {}/s", first);
    case control::BlockKind::lag:
      return fmt::format("1/(1 + s/{})", first);
    case control::BlockKind::lead:
      return fmt::format("1 + s/{}", first);
    case control::BlockKind::washout:
      return fmt::format("s/(s + {})", first);
    case control::BlockKind::notch:
      return "N(s)";
    case control::BlockKind::dead_zone:
      return "dead zone of the integral";
    case control::BlockKind::freeze:
      return "freeze of the integral";
  }
  return first;
}

Figure block_diagram(const std::string& id, const std::string& section,
                     const control::LoopStructure& structure, const std::vector<std::string>& gains,
                     double dead_time) {
  if (!gains.empty() && gains.size() != structure.gains().size()) {
    throw InvalidInput(fmt::format("block_diagram: expected {} gains or none, found {}",
                                   structure.gains().size(), gains.size()));
  }
  const bool pressure = structure.has(LoopPath::pressure);
  const bool compliance = structure.has(LoopPath::compliance);
  const auto position_lines = path_lines("P", LoopPath::position, structure, gains);
  const auto rate_lines = path_lines("R", LoopPath::rate, structure, gains);
  const auto pressure_lines = path_lines("Q", LoopPath::pressure, structure, gains);
  const auto compliance_lines = path_lines("C", LoopPath::compliance, structure, gains);
  const std::vector<std::string> delay_lines{"dead time", fmt::format("{:g} s", dead_time)};
  const std::vector<std::string> antenna_lines{"antenna", "valve, drive,", "gear, structure"};

  Rows rows;
  const double tallest =
      std::max({Drawing::height_of(position_lines), Drawing::height_of(rate_lines),
                Drawing::height_of(antenna_lines)});
  rows.main = 34.0 + 0.5 * tallest;
  double below = rows.main + 0.5 * tallest;
  const auto next_row = [&below](double height) {
    const double centre = below + 0.5 * std::max(row_gap, height + 16.0);
    below = centre + 0.5 * std::max(0.0, height);
    return centre;
  };
  if (pressure) rows.pressure = next_row(Drawing::height_of(pressure_lines));
  rows.rate = next_row(0.0);
  if (compliance) rows.compliance = next_row(Drawing::height_of(compliance_lines));
  rows.position = next_row(0.0);

  // From the left: what stands on the main row, each after a gap.
  Drawing drawing;
  double x = 4.0;
  const auto advance = [&x](double width) {
    const double centre = x + gap + 0.5 * width;
    x += gap + width;
    return centre;
  };
  const double start = x;
  const double position_sum = advance(2.0 * sum_radius) + 28.0;
  x += 28.0;
  const double position_width = Drawing::width_of(position_lines);
  const double position_at = advance(position_width);
  const double rate_sum = advance(2.0 * sum_radius);
  const double rate_width = Drawing::width_of(rate_lines);
  const double rate_at = advance(rate_width);
  std::optional<double> pressure_sum;
  if (pressure) pressure_sum = advance(2.0 * sum_radius);
  const double delay_width = Drawing::width_of(delay_lines);
  const double delay_at = advance(delay_width);
  const double antenna_width = Drawing::width_of(antenna_lines);
  // Right of the pressure path's block.
  if (pressure_sum) x = std::max(x, *pressure_sum + 0.5 * Drawing::width_of(pressure_lines));
  const double antenna_at = advance(antenna_width);
  const double end = x + 74.0;

  const double y = rows.main;
  drawing.text({start, y - 6.0}, "command", "start");
  drawing.arrow({{start, y}, {position_sum - sum_radius, y}});
  drawing.arrow({{position_sum + sum_radius, y}, {position_at - 0.5 * position_width, y}});
  drawing.text({rate_sum - sum_radius - 0.5 * gap, y - 6.0}, "r");
  drawing.arrow({{position_at + 0.5 * position_width, y}, {rate_sum - sum_radius, y}});
  drawing.arrow({{rate_sum + sum_radius, y}, {rate_at - 0.5 * rate_width, y}});
  double from = rate_at + 0.5 * rate_width;
  if (pressure_sum) {
    drawing.arrow({{from, y}, {*pressure_sum - sum_radius, y}});
    from = *pressure_sum + sum_radius;
  }
  drawing.text({from + 0.45 * gap, y - 6.0}, "u");
  drawing.arrow({{from, y}, {delay_at - 0.5 * delay_width, y}});
  drawing.arrow({{delay_at + 0.5 * delay_width, y}, {antenna_at - 0.5 * antenna_width, y}});
  const double antenna_height = Drawing::height_of(antenna_lines);
  drawing.text({antenna_at, 12.0}, "wind torque");
  drawing.arrow({{antenna_at, 16.0}, {antenna_at, y - 0.5 * antenna_height}});
  drawing.text({end, y - 6.0}, "boresight", "end");
  drawing.arrow({{antenna_at + 0.5 * antenna_width, y}, {end, y}});

  // Measured signals leave the antenna below: torque, tachometer, encoder.
  const double foot = y + 0.5 * antenna_height;
  const double torque_tap = antenna_at - 0.3 * antenna_width;
  const double encoder_tap = antenna_at + 0.3 * antenna_width;
  const double torque_row = compliance ? rows.compliance : rows.pressure;
  if (pressure_sum) {
    const double width = Drawing::width_of(pressure_lines);
    const double top = rows.pressure - 0.5 * Drawing::height_of(pressure_lines);
    drawing.text({torque_tap - 4.0, foot + 14.0}, "torque", "end");
    drawing.arrow({{torque_tap, foot},
                   {torque_tap, rows.pressure},
                   {*pressure_sum + 0.5 * width, rows.pressure}});
    drawing.arrow({{*pressure_sum, top}, {*pressure_sum, y + sum_radius}});
    drawing.block({*pressure_sum, rows.pressure}, width, pressure_lines);
    drawing.sum({*pressure_sum, y}, "\u2212");
  }
  drawing.arrow({{antenna_at, foot},
                 {antenna_at, rows.rate},
                 {rate_sum, rows.rate},
                 {rate_sum, y + sum_radius}});
  drawing.text({0.5 * (rate_sum + antenna_at), rows.rate - 5.0}, "tachometer");
  drawing.sum({rate_sum, y}, "\u2212");
  if (compliance) {
    const double width = Drawing::width_of(compliance_lines);
    const double at = rate_at;
    if (!pressure) drawing.text({torque_tap - 4.0, foot + 14.0}, "torque", "end");
    drawing.arrow({{torque_tap, foot}, {torque_tap, torque_row}, {at + 0.5 * width, torque_row}});
    const double joins = position_at;
    drawing.arrow(
        {{at - 0.5 * width, torque_row}, {joins, torque_row}, {joins, rows.position - sum_radius}});
    drawing.block({at, torque_row}, width, compliance_lines);
    drawing.arrow(
        {{encoder_tap, foot}, {encoder_tap, rows.position}, {joins + sum_radius, rows.position}});
    drawing.arrow({{joins - sum_radius, rows.position},
                   {position_sum, rows.position},
                   {position_sum, y + sum_radius}});
    drawing.sum({joins, rows.position}, "");
    drawing.text({joins + 12.0, rows.position - 10.0}, "\u2212");
  } else {
    drawing.arrow({{encoder_tap, foot},
                   {encoder_tap, rows.position},
                   {position_sum, rows.position},
                   {position_sum, y + sum_radius}});
  }
  drawing.text({0.5 * (rate_at + antenna_at), rows.position - 5.0}, "encoder");
  drawing.sum({position_sum, y}, "\u2212");
  drawing.block({position_at, y}, position_width, position_lines);
  drawing.block({rate_at, y}, rate_width, rate_lines);
  drawing.block({delay_at, y}, delay_width, delay_lines);
  drawing.block({antenna_at, y}, antenna_width, antenna_lines);

  Figure figure = std::move(drawing).figure(end + 4.0, rows.position + 16.0);
  figure.id = id;
  figure.section = section;
  figure.title = "Block diagram of the controller";
  figure.caption = fmt::format("{}: {} Each compensator is the product of its factors.{}",
                               structure.name(), equation(structure), notch_text(structure));
  return figure;
}

}  // namespace boresight::app
