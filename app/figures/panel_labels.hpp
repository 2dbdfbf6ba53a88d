#pragma once

#include <string>

#include <boresight/app/figures/panel_svg.hpp>

namespace boresight::app {

/// The labels of a panel's lines, circles, marks and points, each where it covers neither another
/// nor more of the curves than it must; marks themselves. Labels of points for which there is no
/// room are left out where there are many; those of marks, lines and circles are not.
std::string panel_labels_svg(const FigurePanel& panel, const PlacedPanel& placed,
                             const SeriesLooks& looks, LabelPlacement& placement);

}  // namespace boresight::app
