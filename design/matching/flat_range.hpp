#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace boresight::design {

/// Where a curve is least, and how flat it is there; along its axis, between points by straight
/// lines.
struct FlatRange {
  double lowest = 0.0, highest = 0.0;
};

/// Number of the least value; the first of equal ones, none where all are NaN.
std::optional<std::size_t> least_of(const std::vector<double>& values);

/// The range of the axis around the least value within `share` of it (0.05: 5 %). NaN values are
/// gaps that end the range; NaN where all values are. `values`: one a point of the axis, which
/// rises.
FlatRange flat_range(const std::vector<double>& axis, const std::vector<double>& values,
                     double share);

}  // namespace boresight::design
