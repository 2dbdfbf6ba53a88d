#pragma once

#include <complex>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace boresight::control {

/// A place where the loop gain L crosses the unit circle or the negative real axis.
struct Crossover {
  double frequency = 0.0;  // rad/s
  /// At a gain crossover the phase margin in degrees, in (-180, 180]; at a phase crossover the
  /// factor 1/|L| that would bring L to -1.
  double margin = 0.0;
};

/// Every crossover within the grid, and the margins nearest to instability. Nothing is
/// extrapolated: what lies outside the grid is not seen. For a stable loop only.
struct Margins {
  std::vector<Crossover> gain_crossovers;
  std::vector<Crossover> phase_crossovers;
  /// Smallest factor above 1 and largest below 1 that make the loop unstable; infinity and 0 where
  /// there is none.
  double increasing_gain_margin = 0.0;
  double decreasing_gain_margin = 0.0;
  /// Smallest |phase margin| over the gain crossovers, degrees; 180 where there is none.
  double phase_margin_deg = 180.0;
  /// Smallest extra dead time that makes the loop unstable (s); infinity where there is none.
  double delay_margin = 0.0;
};

/// `loop_gain`: L(j w), w in rad/s, with S = 1/(1 + L). `frequency`: rising grid (rad/s) fine
/// enough to separate neighbouring crossings; each crossing is bisected to 1e-12 in ln w.
Margins margins(const std::function<std::complex<double>(double)>& loop_gain,
                const Eigen::ArrayXd& frequency);

}  // namespace boresight::control
