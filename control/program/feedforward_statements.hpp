#pragma once

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/program/program.hpp>

namespace boresight::control::program {

/// The feedforward of AntennaController as statements, SI at the motor. Parts whose gains are 0 are
/// left out.
class FeedforwardStatements {
 public:
  /// What a controller makes of the torque that it expects of the commanded motion.
  enum class MotionTorque {
    unused,         // it reads no torque
    friction_only,  // subtracts friction from the measured torque: loops
    whole,          // subtracts all of it: a state space
  };

  /// Declares parameters and states.
  FeedforwardStatements(Builder& builder, const Feedforward& feedforward, double sample_time,
                        MotionTorque motion_torque);

  /// In steady motion with this rate (rad/s).
  void start(Builder& builder, const Expression& rate) const;
  /// Of the commanded motion at this sample; `next_rate`: at the next one.
  void compute(Builder& builder, const Expression& rate, const Expression& acceleration,
               const Expression& next_rate) const;
  void advance(Builder& builder) const;

  // Computed by the statements above.
  const Expression& rate_feedforward() const { return rate_command_; }    // rad/s
  const Expression& valve_feedforward() const { return valve_command_; }  // rad/s
  /// N m, to be subtracted from the measured torque; only with has_motion_torque.
  Expression motion_torque() const;
  bool has_motion_torque() const;

 private:
  void friction(Builder& builder, const Expression& rate) const;
  void valve(Builder& builder, Expression flow, Expression torque) const;

  bool has_friction_, has_supply_;
  MotionTorque motion_;
  Expression sample_time_;
  Expression rate_to_rate_, acceleration_to_rate_, rate_to_valve_, acceleration_to_valve_;
  Expression rate_to_torque_, acceleration_to_torque_;
  Expression friction_to_valve_, change_to_valve_, supply_torque_, largest_load_;
  Expression coulomb_, bump_, stribeck_rate_, saturating_, saturating_rate_, viscous_, rest_;
  Expression last_friction_, built_friction_;
  Expression rate_command_, valve_command_, torque_, flow_, load_, friction_, speed_;
};

}  // namespace boresight::control::program
