#pragma once

#include <optional>
#include <string>

#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The axis that a case is about, and what an error of it is worth at the sky.
struct PointingAxis {
  std::string name;  // "elevation", "azimuth", or "X" (lower) or "Y" (upper) of an X-Y mount
  std::optional<double> elevation;  // rad, that the case states
  /// plant::Antenna::boresight_factor: the cosine of the elevation for an azimuth axis, of the Y
  /// angle for an X axis, 1 (its largest) where the case states none; 1 for other axes.
  double boresight_factor = 1.0;
  std::optional<double> y_angle = std::nullopt;  // rad, that the case states for an X axis
};
PointingAxis pointing_axis(const Case& antenna);

}  // namespace boresight::io
