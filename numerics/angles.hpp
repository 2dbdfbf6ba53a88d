#pragma once

#include <numbers>

namespace boresight {

/// A whole turn, and a degree and a thousandth of one, in radians.
inline constexpr double two_pi = 2.0 * std::numbers::pi;
inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr double millidegree = std::numbers::pi / 180e3;

}  // namespace boresight
