#pragma once

#include <array>
#include <complex>
#include <optional>

#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/point_response.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// Any linear controller of the antenna, continuous or sampled, in the form that these functions
/// require. All signals are at the motor shaft:
///   inputs   tachometer (rad/s), encoder (rad), motor_torque (N m); those not read are omitted
///   output   valve_demand (rad/s), the complete demand; nothing is subtracted outside
/// If its position loop can be opened, it also has both of
///   input    rate_disturbance (rad/s), added to its rate command
///   output   rate_command (rad/s), with or without the disturbance at once (feedthrough 1 or 0)
/// A continuous controller acts through a dead time. A sampled one acts through a zero-order hold,
/// one sample time after its samples are taken. Examples are to_state_space(Controller) and
/// lqg_controller.
///
/// Ports named `reference` or `angle_reference` are set to 0 and removed; a valve_command counts as
/// valve_demand.
/// @throws InvalidInput for other ports; without any of tachometer, encoder and motor_torque;
/// without valve_demand; with only one of rate_disturbance and rate_command; and as
/// plant::validate.
plant::StateSpace antenna_state_space_controller(const plant::StateSpace& controller);

/// The same with the position loop open. Inputs: tachometer and motor_torque, if read; output:
/// valve_demand. States that neither input reaches are removed. The loop is cut at rate_command if
/// the controller has one, otherwise at its encoder.
/// @throws InvalidInput as antenna_state_space_controller, and for a controller that reads neither.
plant::StateSpace rate_loop_of(const plant::StateSpace& controller);

/// A closed loop at one frequency, at the motor shaft.
struct ControlledPoint {
  /// Loop gains, S = 1/(1 + L), in the order of loop_breaks; NaN if the controller has no such
  /// loop.
  std::array<std::complex<double>, 3> loop_gain;
  std::complex<double> boresight_by_wind;  // rad/(N m)
  /// Boresight (rad) and valve demand (rad/s) by the noise of tachometer, encoder and motor torque.
  std::array<std::complex<double>, 3> boresight_by_noise, demand_by_noise;
};

/// The frequency response of an antenna with a state-space controller. The plant takes O(modes)
/// operations, the controller O(states^2); dead time, hold and samples are exact. With a sampled
/// controller the loop gain is that of the sampled loop (all aliases included). The boresight
/// response is then the component at the frequency of the wind itself, without the components
/// folded to other frequencies. Use one object per thread.
class ControlledAntenna {
 public:
  /// `delay`: s, dead time of a continuous controller; ignored for a sampled one.
  /// @throws InvalidInput as antenna_state_space_controller, and for a negative delay.
  ControlledAntenna(const plant::AntennaPlant& plant, const plant::StateSpace& controller,
                    double delay);

  /// `frequency`: rad/s, above 0.
  ControlledPoint at(double frequency);
  bool has(LoopBreak loop_break) const;
  /// Whether the controller reads the sensor: tachometer, encoder, motor torque.
  const std::array<bool, 3>& reads() const { return reads_; }
  /// pi/T; infinite for a continuous controller.
  double nyquist_frequency() const;

 private:
  plant::PointResponse plant_;
  plant::DenseResponse controller_;
  std::optional<plant::DenseResponse> sampled_plant_;  // under a sampled controller
  double delay_;
  double sample_time_;
  std::array<bool, 3> reads_{};
  std::array<Eigen::Index, 3> column_{};
  Eigen::Index demand_ = 0, rate_command_ = -1, rate_disturbance_ = -1;
  Eigen::MatrixXcd response_, sampled_response_;
};

/// The largest |boresight / wind torque| over all frequencies, rad/(N m) of motor, between two
/// certified bounds. For a continuous controller the dead time is exact. For a sampled one the
/// torque is held from sample to sample and the boresight is evaluated at the samples: the exact
/// sampled loop. With more than 80 states in that loop the Hamiltonian matrices would take minutes.
/// The result is then the largest value on a refined grid, with an infinite upper bound and
/// `closed` false. The loop must be stable, which is not tested here.
/// @throws as antenna_state_space_controller and peak_gain.
PeakGain worst_compliance(const plant::AntennaPlant& plant, const plant::StateSpace& controller,
                          double delay, const PeakGainOptions& options = {});

}  // namespace boresight::control
