#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace boresight::design {

/// Range of a curve's axis around its minimum, interpolated linearly between points.
struct FlatRange {
  double lowest = 0.0, highest = 0.0;
};

/// Index of the least value; the first of equal ones, none where all are NaN.
std::optional<std::size_t> least_of(const std::vector<double>& values);

/// The range of the axis around the least value within the fraction `fraction` of it (0.05: 5 %).
/// NaN values are gaps that end the range; the result is NaN where all values are. `values`: one
/// per point of `axis`, which must rise.
FlatRange flat_range(const std::vector<double>& axis, const std::vector<double>& values,
                     double fraction);

}  // namespace boresight::design
