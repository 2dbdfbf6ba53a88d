#pragma once

#include <boresight/control/lqg/lqg.hpp>

namespace boresight::control {

/// The controller that is best where only the part of the command that the sensors' noise drives is
/// charged, as a limit on valve effort does.
struct NoiseEffortDesign {
  plant::StateSpace controller;  // signals as LqgDesign::controller
  double cost = 0.0;             // the least of any linear controller with these samples
};

/// Least of the problem's cost + noise_effort_weight x (mean square of the command from the
/// measurement noise alone). LQG charges every cause of the command alike, so this is no LQG
/// problem; but with a single command it is a filtering one. Every stabilising controller is the
/// LQG of `problem` with q = Q(z) (innovation) added to its command (D. C. Youla; K. Zhou, J. C.
/// Doyle, K. Glover, Robust and Optimal Control, 1996, ch. 12). That costs
///   (R + B'X B) |Q S^1/2|^2      more (S: covariance of the innovations), and makes the
///   noise-driven W (K e + Q i)                command, with e and i the estimation error and
///   innovation that the
/// measurement noise alone drives and W the scalar response of the command to q. W commutes with Q,
/// so that Q is the stationary filter that estimates -K e of noise passed through W from such
/// innovations plus white noise: one Riccati equation of states + sensors x states that commands
/// reach. Since the least cost is concave in the weight, and any weight w gives
///   mean square of the output >= cost(w) - w E^2
/// for every controller with a noise-driven command of at most E rms, this is the way to a bound
/// (less what the problem's own command weight charges: choose it small against w).
/// The controller has states + sensors x reached states + states of its own.
/// @throws InvalidInput for more than one command, or a weight that is not positive and finite; as
/// lqg.
NoiseEffortDesign noise_effort_lqg(const LqgProblem& problem, double noise_effort_weight);

/// The same from a problem's parts already solved.
NoiseEffortDesign noise_effort_lqg(const LqgProblem& problem, const SampledLqgProblem& sampled,
                                   const LqgDesign& design, double noise_effort_weight);

}  // namespace boresight::control
