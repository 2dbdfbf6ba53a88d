#pragma once

#include <complex>
#include <functional>
#include <limits>

#include <Eigen/Core>

#include <boresight/control/analysis/crossovers.hpp>

namespace boresight::control {

/// A loop gain and its values on a grid fine enough to separate neighbouring crossovers.
struct LoopOnGrid {
  std::function<std::complex<double>(double)> gain;  // L at one angular frequency, rad/s
  Eigen::ArrayXd frequency;                          // rad/s, positive, rising strictly
  Eigen::ArrayXcd value;
  /// Relative error that each value may have: what is nearer to the unit circle or the axis has no
  /// certain side there.
  Eigen::ArrayXd uncertainty;
  /// A sharper estimate of it at one frequency, asked for where a tangency hangs on it; may be
  /// empty.
  std::function<double(double)> error = {};
  /// L turns by no more than this from point to point (rad) and changes by no more in ln|L|, where
  /// that is known: an extremum twice as far from the circle or the axis hides no crossover.
  double largest_turn = std::numeric_limits<double>::infinity();
};

/// Every crossover within the grid: sign changes of ln|L| and of the angle of L to the negative
/// real axis, located to 1e-15, and local extrema towards zero between grid points, which may hide
/// a pair of crossovers. A crossover on a grid point is found once. Where the grid begins or ends
/// with values of no certain side, L only approaches the circle or the axis (an integrator, a
/// roll-off), which is no crossover; neither is a pole or zero of L on the stability boundary,
/// where its angle jumps.
Crossovers crossovers_on_grid(const LoopOnGrid& loop, const CrossoverOptions& options = {});

}  // namespace boresight::control
