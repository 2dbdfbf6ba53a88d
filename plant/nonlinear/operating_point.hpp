#pragma once

#include <Eigen/Core>

#include <boresight/plant/integration/feedback_system.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::plant {

/// The small-signal model about a state and input: inputs u, outputs y, A + G N C and so on with
/// N = dn/dz there. At a kink (spool centred, motor at rest) that of the side the channels choose:
/// spool opening upwards, motion upwards.
/// @throws InvalidInput as feedback_matrices, for sizes that do not fit or elements that are not
/// finite; NumericalFailure naming the channel if n or dn/dz is not finite there.
StateSpace linearise(const FeedbackSystem& system, const Eigen::VectorXd& state,
                     const Eigen::VectorXd& input);

/// What is observed in a state under an input: y = Cy x + Dy u + Ey n(z).
/// @throws as linearise.
Eigen::VectorXd observed(const FeedbackSystem& system, const Eigen::VectorXd& state,
                         const Eigen::VectorXd& input);

/// Motion to be held.
struct Trim {
  double motor_rate = 0.0;   // rad/s
  double motor_angle = 0.0;  // rad: sets the elevation and so gravity's offset
  Eigen::VectorXd wind;      // N m, one a wind force of the structure; empty: none
};

/// Where a motion is steady: nothing changes but angles, all at the motor's rate.
struct OperatingPoint {
  Eigen::VectorXd state;
  Eigen::VectorXd input;  // of to_feedback_system: valve command, wind
  int iterations = 0;
  /// Largest rate of change left, relative to the largest of its terms.
  double residual = 0.0;
};

/// The steady motion and the valve command that holds it, by Newton's method. With bristles at rest
/// (rate 0) friction may hold any torque up to the breakaway's: they are taken as straight, so that
/// the pressures carry the load.
/// @throws InvalidInput as to_feedback_system and for wind of the wrong length; NumericalFailure if
/// there is no such point: more speed or load than the supply can give, or a valve whose overlap
/// leaves the command undetermined.
OperatingPoint trim(const NonlinearAntenna& antenna, const Trim& motion);

/// The state of an antenna at rest that friction holds: the bristles bent by gravity's offset; or,
/// where that would break them away, straight and the offset carried by the pressures.
/// @throws as trim.
Eigen::VectorXd state_held_by_friction(const NonlinearAntenna& antenna);

}  // namespace boresight::plant
