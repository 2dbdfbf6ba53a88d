#pragma once

#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::numerics {

/// Interval of a positive value whose logarithm has a normal error of this standard uncertainty:
/// value exp(+-1.96 relative). @throws InvalidInput for a value that is not positive and an
/// uncertainty that is negative or not finite.
Interval lognormal_interval(double value, double relative_uncertainty);

}  // namespace boresight::numerics
