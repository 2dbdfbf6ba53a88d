#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace boresight::numerics {

/// A positive number that other results rest on, with its standard uncertainty (1 sigma, same
/// unit).
struct UncertainInput {
  std::string name;
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

/// A result as a function of all inputs, in their order.
struct PropagationTarget {
  std::string name;
  std::function<double(std::span<const double>)> evaluate;
  /// The result is 1/g of what `evaluate` returns: for ratios with a pole, whose g passes smoothly
  /// through 0 where the ratio passes through infinity.
  bool reciprocal = false;
};

/// Share of one input in a result's variance.
struct Contribution {
  std::string input;
  double share = 0.0;
};

struct PropagatedResult {
  std::string name;
  double value = 0.0;
  /// First order; for a reciprocal target of the value itself.
  double standard_uncertainty = 0.0;
  /// Central 95 % interval. A reciprocal target's upper end is infinity where g's lower end is not
  /// positive.
  double lower = 0.0;
  double upper = 0.0;
  /// Share of the draws in which g <= 0 (reciprocal targets only).
  double beyond_pole = 0.0;
  /// Inputs by share of the first-order variance, largest first; those below 1 % left out.
  std::vector<Contribution> contributions;
};

struct PropagationOptions {
  int draws = 20000;
  std::uint64_t seed = 1;
};

/// Propagates input uncertainties by Monte Carlo (GUM Supplement 1): independent log-normal inputs
/// with median `value` and logarithmic standard deviation standard_uncertainty/value, so that none
/// turns negative; the interval is that of the draws' quantiles. The same draws serve every target.
/// Deterministic by seed. O(draws x targets).
/// @throws InvalidInput for an input that is not positive, an uncertainty that is negative, or
/// fewer than 100 draws.
std::vector<PropagatedResult> propagate(const std::vector<UncertainInput>& inputs,
                                        const std::vector<PropagationTarget>& targets,
                                        const PropagationOptions& options = {});

}  // namespace boresight::numerics
