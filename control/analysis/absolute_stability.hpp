#pragma once

#include <complex>
#include <functional>

#include <Eigen/Core>

namespace boresight::control {

/// A distance above this is a proof, with a reserve for what lies between the frequencies of a
/// grid.
inline constexpr double min_popov_distance = 0.02;

/// Popov's criterion for a nonlinearity without memory in the sector 0 to 1.
struct PopovResult {
  bool proven = false;
  double slope = 0.0;      // q, s
  double distance = 0.0;   // least of 1 + Re (1 + j w q) L on the grid
  double frequency = 0.0;  // rad/s, where it is least
};

/// Whether a loop is stable for every time-invariant nonlinearity f without memory with
/// 0 <= f(x)/x <= 1. Every motion then tends to rest with f(x) = 0: of a dead zone or freeze,
/// within its width. A constant load shifts only the state of an integral, and changes nothing.
/// `loop_gain(w)`: L, from the nonlinearity's output around the loop to its input, negative
/// feedback implied; all its poles in the left half plane but for one at 0 with a positive residue,
/// for which the caller answers. Proven if some q of 0 or more keeps 1 + Re (1 + j w q) L(jw)
/// positive at every frequency; the q of the largest distance is found. Sufficient, not necessary.
/// Source: V. M. Popov, Absolute stability of nonlinear systems of automatic control, Automation
/// and Remote Control 22, 1961; f that is 0 within a width or jumps: A. Kh. Gelig, G. A. Leonov, V.
/// A. Yakubovich, Stability of Stationary Sets in Control Systems with Discontinuous
/// Nonlinearities, 2004, ch. 3.
/// `frequency`: grid, rad/s, rising.
/// @throws InvalidInput for an empty grid; NumericalFailure for a gain that is not finite.
PopovResult absolute_stability(const std::function<std::complex<double>(double)>& loop_gain,
                               const Eigen::ArrayXd& frequency);

}  // namespace boresight::control
