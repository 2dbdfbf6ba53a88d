#include <fmt/format.h>

#include <boresight/app/report/axis_wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {

std::string words_of(const io::PointingAxis& axis) {
  if (axis.name != "azimuth") return axis.name + " axis";
  return axis.name + " axis, cross-elevation error at " +
         (axis.elevation ? fmt::format("{:.4g} deg elevation", *axis.elevation / degree)
                         : std::string("the horizon"));
}

}  // namespace boresight::app
