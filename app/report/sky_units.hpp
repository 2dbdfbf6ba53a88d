#pragma once

#include <numbers>

namespace boresight::app {

/// Units of reports: 1 mdeg in rad, and the imperial inertia in kg m2.
inline constexpr double millidegree = std::numbers::pi / 180e3;
inline constexpr double pound_foot_second_squared = 1.3558179483314004;
inline constexpr double megapascal = 1e6;

}  // namespace boresight::app
