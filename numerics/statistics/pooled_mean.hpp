#pragma once

#include <vector>

#include <boresight/numerics/statistics/uncertain.hpp>

namespace boresight::numerics {

/// Mean of several estimates of one quantity.
struct PooledMean {
  Uncertain mean;
  /// Standard deviation between the estimates beyond their own uncertainties.
  double between = 0.0;
  /// Cochran's Q, the sum of the squared departures from the mean over the estimates' own
  /// variances, and its degrees of freedom. Q far above them indicates that the estimates
  /// contradict each other.
  double heterogeneity = 0.0;
  int degrees_of_freedom = 0;

  /// Q over its degrees of freedom; 0 for one estimate.
  double reduced_chi_squared() const;
};

/// Random-effects mean (DerSimonian and Laird, Controlled Clinical Trials 7, 1986) of independent
/// estimates: weights 1/(u^2 + between^2).
/// @throws InvalidInput for no estimate or an uncertainty that is not positive and finite.
PooledMean pooled_mean(const std::vector<Uncertain>& estimates);

}  // namespace boresight::numerics
