#include <cmath>
#include <cstdlib>
#include <string>

#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/figures/figure_number.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

double six_digits(double value) {
  const std::string text = figure_number(value);
  return text.empty() ? NAN : std::strtod(text.c_str(), nullptr);
}

void six_digits(io::Visitor& v, std::string_view key, const std::vector<double>& values,
                std::string_view meaning) {
  std::vector<double> rounded;
  for (const double value : values) rounded.push_back(six_digits(value));
  v.numbers(key, rounded, unit::none, meaning);
}

void place(io::Visitor& v, double x, double y) {
  v.number("x", six_digits(x), unit::none, "Where, along x.");
  v.number("y", six_digits(y), unit::none, "Where, along y.");
}

std::string_view style_name(SeriesStyle style) {
  switch (style) {
    case SeriesStyle::line:
      return "line";
    case SeriesStyle::dashed:
      return "dashed";
    case SeriesStyle::steps:
      return "steps";
    case SeriesStyle::points:
      return "points";
    case SeriesStyle::line_and_points:
      return "line and points";
    case SeriesStyle::bars:
      return "bars";
  }
  return "line";
}

void describe(io::Visitor& v, const FigureAxis& axis) {
  v.defined_as("figure_axis", "An axis of a figure, with the unit of its numbers.");
  v.text("label", axis.label, "What it is of.");
  v.text("unit", axis.unit, "Empty for a plain number.");
  v.word("scale", axis.scale == AxisScale::logarithmic ? "logarithmic" : "linear",
         {"linear", "logarithmic"}, "How numbers are spread along it.");
  v.members_if(!axis.categories.empty(), [&] {
    v.texts("categories", axis.categories, "Names at 0, 1, 2, ... instead of numbers.");
  });
  v.optional_members(axis.lowest, [&](double lowest) {
    v.number("lowest", six_digits(lowest), unit::none,
             "What is shown at least, where not everything is.", {.finite = true});
  });
  v.optional_members(axis.highest, [&](double highest) {
    v.number("highest", six_digits(highest), unit::none,
             "What is shown at most, where not everything is.", {.finite = true});
  });
}

void describe(io::Visitor& v, const FigureSeries& series) {
  v.text("name", series.name, "As the legend has it; empty for none.");
  v.word("style", style_name(series.style),
         {"line", "dashed", "steps", "points", "line and points", "bars"}, "How it is drawn.");
  six_digits(v, "x", series.x, "In the axis's unit; null leaves a gap.");
  six_digits(v, "y", series.y, "In the axis's unit; null leaves a gap.");
  const auto bounds = [&](std::string_view key, const std::vector<double>& values) {
    v.members_if(!values.empty(),
                 [&] { six_digits(v, key, values, "An end of the interval about each point."); });
  };
  bounds("x_lower", series.x_lower);
  bounds("x_upper", series.x_upper);
  bounds("y_lower", series.y_lower);
  bounds("y_upper", series.y_upper);
  v.members_if(!series.labels.empty(),
               [&] { v.texts("labels", series.labels, "What each point is called."); });
}

void describe(io::Visitor& v, const FigurePanel& panel) {
  v.group("y", "Upwards.", [&] { describe(v, panel.y); });
  v.list("series", panel.series, "Curves, points and bars.",
         [&](const FigureSeries& series) { describe(v, series); });
  v.members_if(!panel.marks.empty(), [&] {
    v.list("marks", panel.marks, "Points of the plane that are named.",
           [&](const FigureMark& mark) {
             place(v, mark.x, mark.y);
             v.text("label", mark.label, "Its name.");
           });
  });
  v.members_if(!panel.lines.empty(), [&] {
    v.list("lines", panel.lines, "Lines across the panel: budgets, limits, rules.",
           [&](const FigureLine& line) {
             const bool horizontal = line.direction == FigureLine::Direction::horizontal;
             v.word("direction", horizontal ? "horizontal" : "vertical", {"horizontal", "vertical"},
                    "Which way it runs.");
             v.number("at", six_digits(line.at), unit::none, "Its value on the other axis.");
             v.text("label", line.label, "Its name.");
           });
  });
  v.members_if(!panel.circles.empty(), [&] {
    v.list("circles", panel.circles, "Circles in the panel's plane: disk margins.",
           [&](const FigureCircle& circle) {
             place(v, circle.x, circle.y);
             v.number("radius", six_digits(circle.radius), unit::none, "In units of both axes.");
             v.text("label", circle.label, "Its name.");
           });
  });
}

}  // namespace

void describe(io::Visitor& v, const Figure& figure) {
  v.defined_as("figure", "A plot of one or more panels, one above the other on the same x axis.");
  v.text("id", figure.id, "Unique in the report.", {.pattern = "^[a-z0-9-]+$"});
  v.text("section", figure.section, "Heading of the text report's section that it belongs to.");
  v.text("title", figure.title, "What it shows.");
  v.text("caption", figure.caption, "What is seen, under which conditions.");
  v.group("x", "Of all panels.", [&] { describe(v, figure.x); });
  v.flag("equal_scales", figure.equal_scales, "One unit of x is as long as one of y.");
  v.list("panels", figure.panels, "From the top.",
         [&](const FigurePanel& panel) { describe(v, panel); });
}

void describe_figures(io::Visitor& v, const std::vector<Figure>& figures) {
  v.list("figures", figures, "Plots of what was found, every point of them.");
}

}  // namespace boresight::app
