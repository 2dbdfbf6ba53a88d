#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <boresight/app/figures/axis_ticks.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/figures/label_placement.hpp>
#include <boresight/app/figures/plot_axis.hpp>

namespace boresight::app {

inline constexpr double tick_text = 11.0;   // px
inline constexpr double label_text = 11.0;  // of marks, lines and points
inline constexpr double axis_text = 12.0;
inline constexpr double category_width = 230.0;  // of names on a y axis, broken where longer

/// Which of the looks each series' name has.
using SeriesLooks = std::map<std::string, std::size_t>;

/// A panel with its place on the drawing.
struct PlacedPanel {
  Box plot;
  PlotAxis x, y;
  AxisTicks x_ticks, y_ticks;
  bool lowest = true;  // has the numbers of the x axis
};

/// Frame, grid, ticks, curves, lines, circles, marks and labels; not the axes' names.
std::string panel_svg(const FigureAxis& x, const FigurePanel& panel, const PlacedPanel& placed,
                      const SeriesLooks& looks);

/// Lines of a category's name, one below the other, for x (about `width` wide).
std::vector<std::string> category_lines(const std::string& name, double width);

/// Whether the names of x's categories are turned to fit.
bool categories_are_turned(const FigureAxis& axis, double width);

}  // namespace boresight::app
