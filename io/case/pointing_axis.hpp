#pragma once

#include <optional>
#include <string>

#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The axis that a case is about, and what an error of it is worth at the sky.
struct PointingAxis {
  std::string name;                 // "elevation" or "azimuth"
  std::optional<double> elevation;  // rad, that the case states
  /// plant::Antenna::boresight_factor: the cosine of the elevation for an azimuth axis, 1 (its
  /// largest, at the horizon) where the case states none; 1 for an elevation axis.
  double boresight_factor = 1.0;
};
PointingAxis pointing_axis(const Case& antenna);

}  // namespace boresight::io
