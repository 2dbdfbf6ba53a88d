#pragma once

#include <boresight/control/lqg/lqg.hpp>

namespace boresight::control {

/// The optimal controller for a cost that includes only the noise-driven part of the command, as a
/// limit on control effort does.
struct NoiseEffortDesign {
  plant::StateSpace controller;  // signals as LqgDesign::controller
  double cost = 0.0;             // least of any linear controller with these samples
};

/// Minimises the problem's cost + noise_effort_weight x (mean square of the command from the
/// measurement noise alone). LQG charges every cause of the command alike, so this is not an LQG
/// problem. With a single command it is a filtering problem. Every stabilising controller is the
/// LQG controller of `problem` with q = Q(z) (innovation) added to its command (D. C. Youla; K.
/// Zhou, J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, ch. 12). The added q raises the
/// cost by
///   (R + B'X B) |Q S^1/2|^2      (S: covariance of the innovations)
/// and the noise-driven command becomes
///   W (K e + Q i)
/// Here e and i are the estimation error and the innovation driven by the measurement noise alone,
/// and W is the scalar response of the command to q. W commutes with Q. Q is therefore the
/// stationary filter that estimates -K e of noise passed through W from such innovations plus white
/// noise. This takes one Riccati equation of states + sensors x states that commands reach. The
/// least cost is concave in the weight, and any weight w gives
///   mean square of the output >= cost(w) - w E^2
/// for every controller with a noise-driven command of at most E rms. This yields a lower bound,
/// less the contribution of the problem's own command weight: choose that small relative to w. The
/// controller has states + sensors x reached states + states of its own.
/// @throws InvalidInput for more than one command, or a weight that is not positive and finite; as
/// lqg.
NoiseEffortDesign noise_effort_lqg(const LqgProblem& problem, double noise_effort_weight);

/// The same from solved parts of a problem.
NoiseEffortDesign noise_effort_lqg(const LqgProblem& problem, const SampledLqgProblem& sampled,
                                   const LqgDesign& design, double noise_effort_weight);

}  // namespace boresight::control
