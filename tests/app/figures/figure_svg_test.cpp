#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/app/figures/svg_text.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// An element with what the tests look at. The reader refuses what is not well-formed: unknown
// entities, unclosed or wrongly closed tags, attributes without quotes or twice.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
  std::vector<std::string> inside;  // classes of the elements around it
};

std::string unescaped(const std::string& text) {
  static const std::map<std::string, std::string> entities{
      {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"#39", "'"}};
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '<') throw std::runtime_error("< within text");
    if (text[i] != '&') {
      plain += text[i];
      continue;
    }
    const std::size_t end = text.find(';', i);
    if (end == std::string::npos) throw std::runtime_error("open entity");
    plain += entities.at(text.substr(i + 1, end - i - 1));
    i = end;
  }
  return plain;
}

Element element_of(std::string tag) {
  Element element;
  std::size_t at = std::min(tag.find(' '), tag.size());
  element.name = tag.substr(0, at);
  while (at < tag.size()) {
    const std::size_t start = tag.find_first_not_of(' ', at);
    if (start == std::string::npos) break;
    const std::size_t equal = tag.find("=\"", start);
    const std::size_t end = equal == std::string::npos ? equal : tag.find('"', equal + 2);
    if (end == std::string::npos) throw std::runtime_error("attribute: " + tag);
    const std::string value = unescaped(tag.substr(equal + 2, end - equal - 2));
    if (!element.attributes.emplace(tag.substr(start, equal - start), value).second) {
      throw std::runtime_error("twice: " + tag);
    }
    at = end + 1;
  }
  return element;
}

std::vector<Element> elements_of(const std::string& svg) {
  std::vector<Element> elements;
  std::vector<std::size_t> open;
  std::size_t at = 0;
  while (at < svg.size()) {
    const std::size_t tag = std::min(svg.find('<', at), svg.size());
    const std::string text = unescaped(svg.substr(at, tag - at));
    if (!open.empty()) elements[open.back()].text += text;
    if (tag == svg.size()) break;
    const std::size_t end = svg.find('>', tag);
    if (end == std::string::npos) throw std::runtime_error("open tag");
    std::string inner = svg.substr(tag + 1, end - tag - 1);
    at = end + 1;
    if (inner.front() == '/') {
      if (open.empty() || elements[open.back()].name != inner.substr(1)) {
        throw std::runtime_error("closed wrongly: " + inner);
      }
      open.pop_back();
      continue;
    }
    const bool empty = inner.back() == '/';
    if (empty) inner.pop_back();
    Element element = element_of(inner);
    for (const std::size_t i : open) element.inside.push_back(elements[i].attributes["class"]);
    if (open.empty() && !elements.empty()) throw std::runtime_error("second root");
    elements.push_back(element);
    if (!empty) open.push_back(elements.size() - 1);
  }
  if (!open.empty()) throw std::runtime_error("not closed: " + elements[open.back()].name);
  return elements;
}

std::vector<Element> of_class(const std::string& svg, const std::string& name) {
  std::vector<Element> found;
  for (auto& element : elements_of(svg)) {
    if (element.attributes["class"] == name) found.push_back(element);
  }
  return found;
}

double number(const Element& element, const std::string& attribute) {
  return std::stod(element.attributes.at(attribute));
}

// Values of a place, by what the panel says of itself.
double value_at(const Element& panel, const std::string& axis, double place) {
  const double start = number(panel, axis == "x" ? "data-left" : "data-bottom");
  const double end = number(panel, axis == "x" ? "data-right" : "data-top");
  const double from = number(panel, "data-" + axis + "-from");
  const double to = number(panel, "data-" + axis + "-to");
  const double along = (place - start) / (end - start);
  if (panel.attributes.at("data-" + axis + "-scale") == "logarithmic") {
    return from * std::pow(to / from, along);
  }
  return from + along * (to - from);
}

struct Place {
  double x = 0.0, y = 0.0;
  bool starts = false;
};

// Corners of a path of M and L.
std::vector<Place> corners(const std::string& path) {
  std::vector<Place> places;
  std::string spaced;
  for (const char c : path) {
    if (c == 'M' || c == 'L' || c == 'Z') {
      spaced += std::string(" ") + c + " ";
    } else {
      spaced += c;
    }
  }
  std::istringstream words(spaced);
  std::string word;
  while (words >> word) {
    if (word != "M" && word != "L") continue;
    Place place{0.0, 0.0, word == "M"};
    words >> place.x >> place.y;
    places.push_back(place);
  }
  return places;
}

double distance_to_path(const std::vector<Place>& path, double x, double y) {
  double minimum = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].starts) continue;
    const Place a = path[i - 1], b = path[i];
    const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    const double along =
        squared > 0.0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
    minimum = std::min(minimum, std::hypot(x - a.x - along * dx, y - a.y - along * dy));
  }
  return minimum;
}

Figure resonances(AxisScale scale) {
  Figure figure;
  figure.id = "peaks";
  figure.title = "Peaks";
  figure.x = {"frequency", "Hz", scale, {}};
  FigurePanel panel;
  panel.y = {"magnitude", "", scale, {}};
  for (const double damping : {0.01, 0.1, 0.5}) {
    FigureSeries series;
    series.name = "damping " + std::to_string(damping);
    for (int i = 0; i <= 700; ++i) {
      const double w = 0.02 * std::pow(1.01, i);
      series.x.push_back(w);
      series.y.push_back(1.0 / std::hypot(1.0 - w * w, 2.0 * damping * w));
    }
    panel.series.push_back(series);
  }
  figure.panels = {panel};
  return figure;
}

TEST(FigureSvg, DrawsEveryPointWhereItsValueStands) {
  for (const auto scale : {AxisScale::linear, AxisScale::logarithmic}) {
    const Figure figure = resonances(scale);
    const std::string svg = to_svg(figure);
    const auto panel = of_class(svg, "panel").at(0);
    const auto curves = of_class(svg, "curve");
    ASSERT_EQ(curves.size(), 3U);
    const double left = number(panel, "data-left"), right = number(panel, "data-right");
    const double top = number(panel, "data-top"), bottom = number(panel, "data-bottom");
    for (std::size_t s = 0; s < curves.size(); ++s) {
      const auto path = corners(curves[s].attributes.at("d"));
      EXPECT_LT(path.size(), figure.panels[0].series[s].x.size());
      for (std::size_t i = 0; i < figure.panels[0].series[s].x.size(); i += 3) {
        // The place by bisection of the inverse mapping: none of the drawing's own code.
        const auto place_of = [&](const std::string& axis, double value, double low, double high) {
          for (int step = 0; step < 60; ++step) {
            const double middle = 0.5 * (low + high);
            (value_at(panel, axis, middle) < value ? low : high) = middle;
          }
          return low;
        };
        const double x = place_of("x", figure.panels[0].series[s].x[i], left, right);
        const double y = place_of("y", figure.panels[0].series[s].y[i], bottom, top);
        ASSERT_LT(distance_to_path(path, x, y), 0.06) << s << " " << i;
      }
    }
  }
}

TEST(FigureSvg, HoldsEveryPointWithinItsPanel) {
  Figure figure = resonances(AxisScale::linear);
  figure.panels[0].series[0].y_lower.assign(701, -3.0);
  figure.panels[0].series[0].y_upper.assign(701, 77.0);
  const auto panel = of_class(to_svg(figure), "panel").at(0);
  EXPECT_LE(number(panel, "data-y-from"), -3.0);
  EXPECT_GE(number(panel, "data-y-to"), 77.0);
  EXPECT_DOUBLE_EQ(number(panel, "data-x-from"), 0.02);
}

TEST(FigureSvg, LeavesGapsAtUndefinedValues) {
  Figure figure;
  figure.panels.resize(1);
  FigureSeries series{"gap", SeriesStyle::line, {0, 1, 2, 3, 4, 5}, {1, 2, std::nan(""), 4, 5, 6}};
  figure.panels[0].series = {series};
  const auto path = corners(of_class(to_svg(figure), "curve").at(0).attributes.at("d"));
  EXPECT_EQ(std::count_if(path.begin(), path.end(), [](const Place& p) { return p.starts; }), 2);
  // On a logarithmic axis what is not positive has no place either.
  figure.panels[0].y.scale = AxisScale::logarithmic;
  figure.panels[0].series[0].y = {1, 2, 0.0, 4, 5, 6};
  const auto other = corners(of_class(to_svg(figure), "curve").at(0).attributes.at("d"));
  EXPECT_EQ(std::count_if(other.begin(), other.end(), [](const Place& p) { return p.starts; }), 2);
}

TEST(FigureSvg, EscapesWhateverIsNamed) {
  Figure figure;
  const std::string hostile = "a < b & \"c\" > 'd'</svg><script>";
  figure.title = figure.caption = hostile;
  figure.x.label = hostile;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.y.label = hostile;
  panel.series = {{hostile, SeriesStyle::points, {0, 1}, {1, 2}, {}, {}, {}, {}, {hostile, "x"}}};
  panel.marks = {{0.5, 1.5, hostile}};
  panel.lines = {{FigureLine::Direction::horizontal, 1.2, hostile}};
  const std::string svg = to_svg(figure);
  std::vector<Element> elements;
  ASSERT_NO_THROW(elements = elements_of(svg));
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  const auto title = std::find_if(elements.begin(), elements.end(),
                                  [](const Element& e) { return e.name == "title"; });
  ASSERT_NE(title, elements.end());
  EXPECT_EQ(title->text, hostile);
}

TEST(FigureSvg, TellsSeriesApartInGrey) {
  Figure figure;
  figure.panels.resize(1);
  for (int i = 0; i < 6; ++i) {
    const double level = i;
    figure.panels[0].series.push_back(
        {"s" + std::to_string(i), SeriesStyle::line_and_points, {0, 1, 2}, {level, level, level}});
  }
  const std::string svg = to_svg(figure);
  std::set<std::string> dashes, shapes;
  for (auto& curve : of_class(svg, "curve")) dashes.insert(curve.attributes["stroke-dasharray"]);
  for (auto& points : of_class(svg, "points")) {
    const std::string& path = points.attributes["d"];
    // The first marker without its place.
    std::string shape;
    const std::string marker = path.substr(0, path.find('Z'));
    const auto places = corners(marker);
    for (const auto& place : places) {
      shape += std::to_string(std::lround(10.0 * (place.x - places[0].x))) + "," +
               std::to_string(std::lround(10.0 * (place.y - places[0].y))) + " ";
    }
    shapes.insert(shape);
  }
  EXPECT_EQ(dashes.size(), 6U);
  EXPECT_EQ(shapes.size(), 6U);
}

TEST(FigureSvg, GivesOneNameOneLookInEveryPanel) {
  Figure figure;
  figure.panels.resize(2);
  const FigureSeries a{"a", SeriesStyle::line, {0, 1}, {0, 1}},
      b{"b", SeriesStyle::line, {0, 1}, {1, 0}};
  figure.panels[0].series = {a, b};
  figure.panels[1].series = {b};
  const auto curves = of_class(to_svg(figure), "curve");
  ASSERT_EQ(curves.size(), 3U);
  EXPECT_EQ(curves[1].attributes.at("stroke"), curves[2].attributes.at("stroke"));
  EXPECT_NE(curves[0].attributes.at("stroke"), curves[1].attributes.at("stroke"));
}

TEST(FigureSvg, DrawsBarsFromZeroOrOverWhatTheySpan) {
  Figure figure;
  figure.x.label = "rms";
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.y.categories = {"one", "two"};
  panel.series = {{"", SeriesStyle::bars, {3, 5}, {0, 1}}};
  std::string svg = to_svg(figure);
  const auto bars = [&] {
    std::vector<Element> found;
    for (auto& element : elements_of(svg)) {
      if (element.name == "rect") found.push_back(element);
    }
    return found;
  };
  auto frame = of_class(svg, "panel").at(0);
  ASSERT_EQ(bars().size(), 2U);
  EXPECT_NEAR(value_at(frame, "x", number(bars()[0], "x")), 0.0, 1e-3);
  EXPECT_NEAR(value_at(frame, "x", number(bars()[1], "x") + number(bars()[1], "width")), 5.0, 1e-2);
  EXPECT_LT(number(bars()[0], "y"), number(bars()[1], "y"));  // names from the top
  panel.series[0].x_lower = {2, 4};
  panel.series[0].x_upper = {3, 5};
  svg = to_svg(figure);
  frame = of_class(svg, "panel").at(0);
  EXPECT_NEAR(value_at(frame, "x", number(bars()[1], "x")), 4.0, 1e-2);
}

TEST(FigureSvg, KeepsLabelsOfMarksApart) {
  Figure figure;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.series = {{"", SeriesStyle::line, {0, 10}, {0, 10}}};
  for (int i = 0; i < 9; ++i)
    panel.marks.push_back({5.0 + 0.02 * i, 5.0, "a mark called " + std::to_string(i)});
  struct Extent {
    double left, foot;
  };
  std::vector<Extent> labels;
  for (const auto& label : of_class(to_svg(figure), "label")) {
    labels.push_back({number(label, "x"), number(label, "y")});
  }
  ASSERT_EQ(labels.size(), 9U);
  constexpr double width = 85.0, height = 12.0;  // at least what the text takes
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_TRUE(std::abs(labels[i].left - labels[j].left) > width ||
                  std::abs(labels[i].foot - labels[j].foot) > height)
          << i << " " << j;
    }
  }
}

TEST(FigureSvg, KeepsUprightNamesOfLinesApartFromLongOnes) {
  Figure figure;
  figure.x.lowest = 0.0;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.series = {{"", SeriesStyle::line, {0, 24}, {0.3, 0.6}}};
  panel.marks = {{0.0, 0.5, "PI 0.4987"}, {0.0, 0.3, "DPF+C 0.2910"}};
  using enum FigureLine::Direction;
  panel.lines = {{vertical, 5.9, "equal pole pairs (R = 0.5)"},
                 {vertical, 2.8, "equal pole pairs (R = 0.25)"},
                 {vertical, 0.0, "maximum acceleration (R = 0.027)"}};
  const auto labels = of_class(to_svg(figure), "label");
  ASSERT_EQ(labels.size(), 5U);
  struct Extent {
    double left, top, right, bottom;
  };
  std::vector<Extent> boxes;
  constexpr double size = 11.0;
  for (const auto& label : labels) {
    const double width = text_width(label.text, size);
    if (!label.attributes.contains("transform")) {
      const double x = number(label, "x"), y = number(label, "y");
      boxes.push_back({x, y - 0.8 * size, x + width, y + 0.2 * size});
      continue;
    }
    double x = 0.0, y = 0.0;
    std::istringstream place(label.attributes.at("transform").substr(10));  // translate(
    ASSERT_TRUE(place >> x >> y);
    boxes.push_back({x - 0.8 * size, y - width, x + 0.2 * size, y});
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_TRUE(boxes[i].right <= boxes[j].left || boxes[j].right <= boxes[i].left ||
                  boxes[i].bottom <= boxes[j].top || boxes[j].bottom <= boxes[i].top)
          << labels[i].text << ", " << labels[j].text;
    }
  }
}

TEST(FigureSvg, LeavesOutNamesTooLongForTheirRow) {
  Figure figure;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.y.categories = {"plant 1", "plant 2"};
  panel.series = {{"rms", SeriesStyle::bars, {1, 2}, {0, 1}}};
  panel.series[0].labels = {std::string(130, 'a'), "short"};
  const auto labels = of_class(to_svg(figure), "label");
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].text, "short");
}

TEST(FigureSvg, MarksWhatIsCutOffByAnArrowAtTheEdge) {
  Figure figure;
  figure.x.lowest = 0.0;
  figure.x.highest = 10.0;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.y.categories = {"within", "end beyond", "all beyond"};
  panel.series = {{"", SeriesStyle::points, {5, 6, 50}, {0, 1, 2}}};
  panel.series[0].x_lower = {4, 5, 40};
  const auto arrows = [&](std::vector<double> upper) {
    panel.series[0].x_upper = std::move(upper);
    const std::string svg = to_svg(figure);
    const double right = number(of_class(svg, "panel").at(0), "data-right");
    const std::string tail = fmt::format("M{:.2f} ", right - 6.0);
    const std::string path = of_class(svg, "interval").at(0).attributes.at("d");
    int count = 0;
    for (auto at = path.find(tail); at != std::string::npos; at = path.find(tail, at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(arrows({6, 7, 60}), 2);  // both ends of the last
  EXPECT_EQ(arrows({6, 30, 60}), 3);
}

TEST(FigureSvg, DrawsANyquistPlaneWithEqualScales) {
  Figure figure;
  figure.equal_scales = true;
  figure.x.lowest = -3.0;
  figure.x.highest = 1.0;
  figure.panels.resize(1);
  figure.panels[0].series = {{"L", SeriesStyle::line, {-100, -1, 0}, {-50, -1, 0}}};
  figure.panels[0].y.lowest = -2.0;
  figure.panels[0].y.highest = 1.0;
  figure.panels[0].circles = {{-1.0, 0.0, 0.5, "peak 2"}};
  const std::string svg = to_svg(figure);
  const auto panel = of_class(svg, "panel").at(0);
  const auto circle = of_class(svg, "circle").at(0);
  EXPECT_NEAR(number(circle, "rx"), number(circle, "ry"), 0.02);
  EXPECT_NEAR(value_at(panel, "x", number(circle, "cx") + number(circle, "rx")), -0.5, 1e-2);
  EXPECT_NEAR(value_at(panel, "y", number(circle, "cy") - number(circle, "ry")), 0.5, 1e-2);
}

TEST(FigureSvg, IsTheSameEachTimeAndStandsAlone) {
  const Figure figure = resonances(AxisScale::logarithmic);
  const std::string svg = to_svg(figure);
  EXPECT_EQ(svg, to_svg(figure));
  for (const char* foreign : {"<script", "<style", "href", "url(", " id=", "nan", "inf"}) {
    EXPECT_EQ(svg.find(foreign), std::string::npos) << foreign;
  }
}

TEST(FigureSvg, RefusesWhatCannotBeDrawn) {
  Figure figure;
  figure.id = "broken";
  figure.panels.resize(1);
  figure.panels[0].series = {{"s", SeriesStyle::line, {0, 1, 2}, {0, 1}}};
  EXPECT_THROW(to_svg(figure), InvalidInput);
  figure.panels[0].series = {{"s", SeriesStyle::line, {0, 1, 2}, {0, -1, 0}}};
  EXPECT_NO_THROW(to_svg(figure));
  figure.panels[0].y.scale = AxisScale::logarithmic;
  EXPECT_THROW(to_svg(figure), InvalidInput);
}

TEST(FigureSvg, DrawsAnEmptyFigure) {
  EXPECT_NO_THROW(elements_of(to_svg(Figure{})));
  Figure figure;
  figure.panels.resize(1);
  figure.panels[0].series = {{"nothing", SeriesStyle::line_and_points, {}, {}}};
  const std::string svg = to_svg(figure);
  EXPECT_NO_THROW(elements_of(svg));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace boresight::app
