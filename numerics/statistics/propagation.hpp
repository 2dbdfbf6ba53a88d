#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace boresight::numerics {

/// A positive input with its standard uncertainty (1 sigma, same unit).
struct UncertainInput {
  std::string name;
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

/// A result as a function of all inputs, in their order.
struct PropagationTarget {
  std::string name;
  std::function<double(std::span<const double>)> evaluate;
  /// The result is 1/g, g the value of `evaluate`. For ratios with a pole: g passes smoothly
  /// through 0 where the ratio passes through infinity.
  bool reciprocal = false;
};

/// Fraction of a result's variance due to one input.
struct Contribution {
  std::string input;
  double fraction = 0.0;
};

struct PropagatedResult {
  std::string name;
  double value = 0.0;
  /// To first order; for a reciprocal target that of the value itself.
  double standard_uncertainty = 0.0;
  /// Central 95 % interval. A reciprocal target's upper end is infinity where g's lower end is not
  /// positive.
  double lower = 0.0;
  double upper = 0.0;
  /// Fraction of the samples with g <= 0 (reciprocal targets only).
  double beyond_pole = 0.0;
  /// Inputs by fraction of the first-order variance, largest first; those below 1 % are left out.
  std::vector<Contribution> contributions;
};

struct PropagationOptions {
  int random_samples = 20000;
  std::uint64_t seed = 1;
};

/// Propagates input uncertainties by Monte Carlo (GUM Supplement 1). Inputs are independent and
/// log-normal, with median `value` and logarithmic standard deviation standard_uncertainty/value,
/// so none is negative. The interval has the samples' quantiles. All targets use the same samples.
/// Deterministic by seed. O(samples x targets).
/// @throws InvalidInput for an input that is not positive, an uncertainty that is negative, or
/// fewer than 100 samples.
std::vector<PropagatedResult> propagate(const std::vector<UncertainInput>& inputs,
                                        const std::vector<PropagationTarget>& targets,
                                        const PropagationOptions& options = {});

}  // namespace boresight::numerics
