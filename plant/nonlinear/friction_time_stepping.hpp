#pragma once

#include <limits>

#include <Eigen/Core>

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/nonlinear/drive_elements.hpp>

namespace boresight::plant {

/// The linear antenna with dry friction and orifice flow, for fast simulation in fixed steps:
///   Tm' = K (xv sqrt(1 - Tm sign(xv)/Ts) - w) - lambda Tm,
///   Jm w' = Tm - To - F(w) - Bf w - gear torque,
/// all else as AntennaPlant, with F of MotorFriction. Without backlash, oil lines, air and limits
/// of the valve.
struct FrictionAntenna {
  AntennaPlant linear;  // with the viscous friction in addition to that of the curve
  MotorFriction friction;
  double offset_torque = 0.0;                                      // To, N m
  double supply_torque = std::numeric_limits<double>::infinity();  // Ts, less that of the return
};

/// Within a step the linear part is exact, with friction torque and the flow's loss constant. The
/// friction torque is that of the rate at the end of the step, with the bristles by the implicit
/// Euler method, so that no step is too long for their stiffness. Of first order in the step.
/// Friction without bristles gets ones that are stiff within a step.
class FrictionTimeStepping {
 public:
  /// At rest, the motor torque in balance with the offset torque.
  /// @throws InvalidInput as to_state_space and validate(friction), for a curve without dry
  /// friction, and for a step (s) that is not above 0.
  FrictionTimeStepping(const FrictionAntenna& antenna, double step);

  /// One step, the valve command (rad/s) held.
  void advance(double valve_command);

  double holding_command() const { return holding_command_; }  // rad/s, of the state at the start
  double tachometer() const { return state_[tachometer_state]; }  // rad/s
  double motor_rate() const { return state_[rate_state]; }        // rad/s
  double motor_torque() const { return state_[torque_state]; }    // N m
  double encoder() const { return state_[encoder_state]; }        // rad of motor
  double boresight() const { return boresight_.dot(state_); }     // rad of motor

 private:
  // As in to_state_space(AntennaPlant).
  enum : Eigen::Index {
    valve_state = 0,
    torque_state = 2,
    rate_state = 3,
    encoder_state = 5,
    tachometer_state = 7
  };
  double open_fraction(double opening, double torque) const;
  double rate_with_friction(double free_rate);

  MotorFriction friction_;
  double smallest_friction_;  // N m
  double step_;               // s
  double offset_torque_, supply_torque_;
  double oil_stiffness_;
  double rate_per_torque_;  // rad/s that a torque of 1 N m on the motor adds in a step
  double holding_command_;
  Eigen::MatrixXd transition_;
  Eigen::VectorXd by_command_, by_motor_torque_, by_flow_;
  Eigen::RowVectorXd boresight_;
  Eigen::VectorXd state_, next_;
  double bristle_ = 0.0;  // rad
};

}  // namespace boresight::plant
