#pragma once

#include <boresight/numerics/angles.hpp>

namespace boresight::app {

/// Units of reports beside those of angles: the imperial inertia in kg m2, 1 MPa in Pa.
inline constexpr double pound_foot_second_squared = 1.3558179483314004;
inline constexpr double megapascal = 1e6;

}  // namespace boresight::app
