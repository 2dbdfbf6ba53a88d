#pragma once

#include <string>
#include <string_view>

#include <boresight/io/case/pointing_axis.hpp>

namespace boresight::app {

/// "elevation axis"; "azimuth axis, cross-elevation error at 60 deg elevation", or "at the horizon"
/// where the case states no elevation; "X axis of an X-Y mount at Y = 30 deg, boresight error =
/// axis error x cos(Y)".
std::string words_of(const io::PointingAxis& axis);

/// The same without "elevation axis" or "azimuth axis" where the title already names it: empty, or
/// "cross-elevation error at 60 deg elevation".
std::string words_beside(std::string_view title, const io::PointingAxis& axis);

}  // namespace boresight::app
