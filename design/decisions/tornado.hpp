#pragma once

#include <functional>
#include <vector>

namespace boresight::design {

/// Effect of one input alone, all others at their median.
struct TornadoBar {
  std::size_t input = 0;
  double at_low = 0.0, at_high = 0.0;  // the function at the input's low and high quantile
  /// Largest less smallest of these two values and the value with every input at its median. An
  /// input with its extreme at the median therefore has a swing too.
  double swing = 0.0;
};

struct Tornado {
  double at_median = 0.0;
  std::vector<TornadoBar> bars;  // widest first; equal ones in the inputs' order
};

/// Moves one input at a time from the `low` to the `high` quantile of its own distribution. It does
/// not include interactions; sobol_indices does. Cost: 2 inputs + 1 evaluations.
/// @throws InvalidInput for no inputs or quantiles that are not 0 < low < 0.5 < high < 1;
/// NumericalFailure for a value that is not finite, naming the input.
Tornado tornado(std::size_t inputs,
                const std::function<double(const std::vector<double>& fractions)>& function,
                double low = 0.05, double high = 0.95);

}  // namespace boresight::design
