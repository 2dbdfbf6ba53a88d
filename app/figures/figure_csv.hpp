#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// A field of a CSV file: quoted where a separator, a quote or a line break would be misread (RFC
/// 4180).
std::string csv_field(const std::string& text);

/// The points of every series in long form: panel, series, x, y, intervals where there are any and
/// labels, the axes' names and units in the header. The numbers are those of figures_json.
std::string to_csv(const Figure& figure);

/// Writes ID.csv for each figure into a folder, made if it is not there, each file whole or not at
/// all. @throws InvalidInput if it cannot be written to.
void write_curves(const std::vector<Figure>& figures, const std::string& folder);

}  // namespace boresight::app
