#pragma once

#include <complex>
#include <functional>
#include <limits>

#include <Eigen/Core>

#include <boresight/control/analysis/crossovers.hpp>

namespace boresight::control {

/// A loop gain with its values on a grid that separates neighbouring crossovers.
struct LoopOnGrid {
  std::function<std::complex<double>(double)> gain;  // L at one angular frequency, rad/s
  Eigen::ArrayXd frequency;                          // rad/s, positive, rising strictly
  Eigen::ArrayXcd value;
  /// Relative error of each value. A value nearer than this to the unit circle or the axis has no
  /// certain side.
  Eigen::ArrayXd uncertainty;
  /// A more accurate estimate of that error at one frequency, called where a tangency depends on
  /// it; may be empty.
  std::function<double(double)> error = {};
  /// Largest change of angle (rad) and of ln|L| from point to point, where known. An extremum twice
  /// as far from the circle or the axis hides no crossover.
  double largest_turn = std::numeric_limits<double>::infinity();
};

/// Every crossover within the grid: sign changes of ln|L| and of the angle of L to the negative
/// real axis, located to 1e-15. Local extrema towards zero between grid points, which may hide a
/// pair of crossovers, are searched too. A crossover on a grid point is reported once. If the grid
/// begins or ends with values of no certain side, L only approaches the circle or the axis (an
/// integrator, a roll-off), which is not a crossover. A pole or zero of L on the stability
/// boundary, where the angle jumps, is not a crossover either.
Crossovers crossovers_on_grid(const LoopOnGrid& loop, const CrossoverOptions& options = {});

}  // namespace boresight::control
