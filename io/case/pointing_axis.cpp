#include <cmath>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/pointing_axis.hpp>

namespace boresight::io {

PointingAxis pointing_axis(const Case& antenna) {
  PointingAxis axis;
  axis.name = antenna.axis;
  if (antenna.antenna->elevation) axis.elevation = antenna.antenna->elevation->value;
  if (antenna.antenna->y_angle) axis.y_angle = antenna.antenna->y_angle->value;
  if (antenna.axis == "azimuth" && axis.elevation) {
    // Beyond the zenith (a plunged dish) it is positive too.
    axis.boresight_factor = std::abs(std::cos(*axis.elevation));
  } else if (antenna.axis == "X" && axis.y_angle) {
    axis.boresight_factor = std::cos(*axis.y_angle);
  }
  return axis;
}

}  // namespace boresight::io
