#pragma once

#include <string>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/figures/label_placement.hpp>
#include <boresight/app/figures/plot_axis.hpp>

namespace boresight::app {

/// Position of a series of bars among those of the panel.
struct BarFraction {
  std::size_t index = 0, count = 1;
  bool categories = false;  // they stand at names, not at numbers
};

/// What is cut off at the panel's edge: bands, curves and bars of a series.
std::string curve_svg(const FigureSeries& series, std::size_t look, const PlotAxis& x,
                      const PlotAxis& y, bool along_x, const BarFraction& fraction,
                      LabelPlacement& labels);

/// Elements drawn completely or not at all: markers and interval bars.
std::string points_svg(const FigureSeries& series, std::size_t look, const PlotAxis& x,
                       const PlotAxis& y, LabelPlacement& labels);

/// A sample of the series for a legend, 26 wide about (x, y).
std::string legend_sample_svg(const FigureSeries& series, std::size_t look, double x, double y);

/// The path data of a marker about (x, y); eight shapes.
std::string marker_path(int shape, double x, double y, double size);

}  // namespace boresight::app
