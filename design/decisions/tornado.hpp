#pragma once

#include <functional>
#include <vector>

namespace boresight::design {

/// What one input does alone, all others at their median.
struct TornadoBar {
  std::size_t input = 0;
  double at_low = 0.0, at_high = 0.0;  // the function at the input's low and high share
  /// Largest less smallest of these two and the value with every input at its median: an input
  /// whose middle is worst shows too.
  double swing = 0.0;
};

struct Tornado {
  double at_median = 0.0;
  std::vector<TornadoBar> bars;  // widest first; equal ones in the inputs' order
};

/// Moves one input at a time from its `low` to its `high` share of its own distribution. It shows
/// no interactions: sobol_indices does. 2 inputs + 1 evaluations.
/// @throws InvalidInput for no inputs or shares that are not 0 < low < 0.5 < high < 1;
/// NumericalFailure for a value that is not finite, naming the input.
Tornado tornado(std::size_t inputs,
                const std::function<double(const std::vector<double>& shares)>& function,
                double low = 0.05, double high = 0.95);

}  // namespace boresight::design
