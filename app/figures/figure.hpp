#pragma once

#include <optional>
#include <string>
#include <vector>

namespace boresight::app {

enum class AxisScale { linear, logarithmic };

struct FigureAxis {
  std::string label = {};  // "frequency"
  std::string unit = {};   // "Hz"; empty: a plain number
  AxisScale scale = AxisScale::linear;
  /// Names at 0, 1, 2, ... in place of numbers, on a y axis from the top; empty: numbers.
  std::vector<std::string> categories = {};
  /// What is shown at least and at most; none: all points, marks, lines and circles.
  std::optional<double> lowest = std::nullopt, highest = std::nullopt;
};

enum class SeriesStyle { line, dashed, steps, points, line_and_points, bars };

/// One curve or set of points. `x` and `y` are of one length; NaN in either leaves a gap. Series of
/// one name look alike in every panel; one without a name is not in the legend.
struct FigureSeries {
  std::string name = {};
  SeriesStyle style = SeriesStyle::line;
  std::vector<double> x = {}, y = {};
  /// Intervals about the points, empty or of the length of `x`: a band about lines of y, bars about
  /// points. For style `bars` they are the extent of the bars. Without them a bar extends from 0 to
  /// the value, along x if the y axis has categories, else along y. Bars of several series are
  /// drawn side by side; bars with an extent are drawn on one another.
  std::vector<double> x_lower = {}, x_upper = {}, y_lower = {}, y_upper = {};
  /// What a point is called, empty or of the length of `x`.
  std::vector<std::string> labels = {};
};

/// A point of the plane that is named: a peak, a crossover, an optimum.
struct FigureMark {
  double x = 0.0, y = 0.0;
  std::string label = {};
};

/// A line across the whole panel: a budget, a limit, a rule.
struct FigureLine {
  enum class Direction { horizontal, vertical };
  Direction direction = Direction::horizontal;
  double at = 0.0;
  std::string label = {};
};

/// A circle in the plane of a panel: a disk margin.
struct FigureCircle {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string label = {};
};

struct FigurePanel {
  FigureAxis y;
  std::vector<FigureSeries> series;
  std::vector<FigureMark> marks;
  std::vector<FigureLine> lines;
  std::vector<FigureCircle> circles;
};

/// A drawing instead of a plot: SVG elements in a box from (0, 0), y downwards.
struct FigureDrawing {
  double width = 0.0, height = 0.0;
  std::string elements = {};  // empty: a plot
};

/// A plot of one or more panels, one above the other on the same x axis. Values are in the unit
/// that the axis names: those a reader sees, not SI.
struct Figure {
  std::string id;       // of [a-z0-9-], unique in a report: file name, anchor
  std::string section;  // heading of the report's section under which it is shown
  std::string title;
  std::string caption;  // what is seen under which conditions, in a sentence or two
  FigureAxis x;
  std::vector<FigurePanel> panels;
  bool equal_scales = false;  // one unit of x as long as one of y: a Nyquist plot
  /// For a diagram: drawn instead of the panels, which then list its parts by position.
  FigureDrawing drawing = {};
};

}  // namespace boresight::app
