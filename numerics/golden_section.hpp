#pragma once

#include <functional>

namespace boresight::numerics {

/// Place of the maximum of a function with one maximum in [low, high], to `tolerance`.
double golden_section_maximum(const std::function<double(double)>& value, double low, double high,
                              double tolerance);

}  // namespace boresight::numerics
