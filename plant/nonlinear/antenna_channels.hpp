#pragma once

#include <array>

#include <Eigen/Core>

#include <boresight/plant/integration/nonlinear_channels.hpp>
#include <boresight/plant/nonlinear/drive_elements.hpp>

namespace boresight::plant {

/// What is nonlinear in the antenna, as the difference from the linear core of
/// to_feedback_system(NonlinearAntenna). Channels that this antenna does not need are left out.
class AntennaChannels final : public NonlinearChannels {
 public:
  enum Input : Eigen::Index {
    spool,
    spool_rate,
    manifold_1,  // N m, pressure at the valve: the side's with its lines' waves
    manifold_2,
    side_1,
    side_2,
    motor_rate,
    bristle,
    motor_angle,
    windup,
    windup_rate,
    input_count
  };
  enum Output : Eigen::Index {
    flow_1,               // rad/s into side 1, beyond the spool's
    flow_2,               // rad/s into side 2, beyond minus the spool's
    friction_and_offset,  // N m, offset included
    bristle_rate,         // rad/s
    softening_1,          // rad/s: what air takes from the flow into side 1
    softening_2,
    gear_deviation,  // N m, beyond the linear spring's
    spool_slew,      // rad/s2, beyond the unlimited spool speed
    output_count
  };

  AntennaChannels(const ServoValve& valve, const OilCircuit& oil, const MotorFriction& friction,
                  const OffsetTorque& offset, const GearContact& gear);

  Eigen::Index inputs() const override { return input_count; }
  Eigen::Index outputs() const override { return active_; }
  /// Position of a channel among the outputs, -1 if it is left out.
  Eigen::Index position(Output channel) const {
    return position_[static_cast<std::size_t>(channel)];
  }

  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const override;

  /// Functions of z that change their sign where n has a kink or the antenna its way of moving:
  /// motor reversal; spool at stroke limits and overlap edges; slew limits; sides at the make-up
  /// pressure; loss and return of contact in the gear.
  static constexpr Eigen::Index event_count = 13;
  void events(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> g) const;

 private:
  void flows(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
             Eigen::Ref<Eigen::MatrixXd> dn_dz) const;
  void friction(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const;

  ServoValve valve_;
  OilCircuit oil_;
  MotorFriction friction_;
  OffsetTorque offset_;
  GearContact gear_;
  std::array<Eigen::Index, output_count> position_{};
  Eigen::Index active_ = 0;
};

}  // namespace boresight::plant
