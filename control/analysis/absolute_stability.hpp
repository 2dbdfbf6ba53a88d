#pragma once

#include <complex>
#include <functional>

#include <Eigen/Core>

namespace boresight::control {

/// Popov's criterion for a nonlinearity without memory in the sector 0 to 1.
struct PopovResult {
  bool proven = false;
  double slope = 0.0;      // q, s
  double distance = 0.0;   // least of 1 + Re (1 + j w q) L; above 0 if proven
  double frequency = 0.0;  // rad/s, where it is least
};

/// Whether a loop is stable for every nonlinearity f without memory with 0 <= f(x)/x <= 1, constant
/// or varying with x. `loop_gain(w)`: L, from the nonlinearity's output around the loop to its
/// input, negative feedback implied; all its poles in the left half plane but for one at 0 with a
/// positive residue. Proven if some q of 0 or more keeps 1 + Re (1 + j w q) L(jw) above 0 at every
/// frequency; the q of the largest distance is found. Sufficient, not necessary.
/// Source: V. M. Popov, Absolute stability of nonlinear systems of automatic control, Automation
/// and Remote Control 22, 1961; H. K. Khalil, Nonlinear Systems, 3rd ed., 2002, sec. 7.1.
/// `frequency`: grid, rad/s, rising.
/// @throws InvalidInput for an empty grid; NumericalFailure for a gain that is not finite.
PopovResult absolute_stability(const std::function<std::complex<double>(double)>& loop_gain,
                               const Eigen::ArrayXd& frequency);

}  // namespace boresight::control
