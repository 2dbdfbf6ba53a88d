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

/// Any linear controller of the antenna, continuous or sampled, as the functions here take it:
///   inputs   tachometer (rad/s), encoder (rad), motor_torque (N m), what it does not read left out
///   output   valve_demand (rad/s), what it asks of the valve; nothing is subtracted outside
/// all at the motor shaft, and, where its position loop can be opened, both of
///   input    rate_disturbance (rad/s), added to its rate command
///   output   rate_command (rad/s), with or without the disturbance at once (feedthrough 1 or 0)
/// A continuous one acts through a dead time; a sampled one through a zero-order hold, one sample
/// time after its samples are taken. to_state_space(ControlLaw) is such a controller, as is an
/// lqg_controller.
///
/// Ports that are `reference` or `angle_reference` rest at 0 and are left out, a valve_command is
/// a valve_demand.
/// @throws InvalidInput for other ports, none of tachometer, encoder and motor_torque, no
/// valve_demand, one of rate_disturbance and rate_command without the other, and as
/// plant::validate.
plant::StateSpace antenna_state_space_controller(const plant::StateSpace& controller);

/// The same with the position loop open: inputs tachometer and motor_torque as far as it reads
/// them, output valve_demand, without the states that neither reaches. Where the controller has a
/// rate_command, that is cut; else its encoder.
/// @throws InvalidInput as antenna_state_space_controller, and for a controller that reads neither.
plant::StateSpace rate_loop_of(const plant::StateSpace& controller);

/// A closed loop at one frequency, at the motor shaft.
struct ControlledPoint {
  /// Loop gains, S = 1/(1 + L), in the order of loop_breaks; not a number where the controller has
  /// no such loop.
  std::array<std::complex<double>, 3> loop_gain;
  std::complex<double> beam_by_wind;  // rad/(N m)
  /// Beam (rad) and valve demand (rad/s) by the noise of tachometer, encoder and motor torque.
  std::array<std::complex<double>, 3> beam_by_noise, demand_by_noise;
};

/// The frequency response of an antenna under a state-space controller: the plant's in O(modes),
/// the controller's in O(states^2), dead time, hold and samples exact. Under a sampled controller
/// the loop gain is that of the sampled loop (all aliases in it), and the beam's response is the
/// part at the frequency of the wind itself: what is folded to other frequencies is left out. One
/// object a thread.
class ControlledAntenna {
 public:
  /// `delay`: s, dead time of a continuous controller; not read for a sampled one.
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

/// The largest |beam / wind torque| over all frequencies between two certified bounds, rad/(N m) of
/// motor. Under a continuous controller with its exact dead time. Under a sampled one the torque is
/// held from sample to sample and the beam looked at with the samples: the exact sampled loop; with
/// more than 80 states in it, where the Hamiltonian matrices take minutes, what a refined grid
/// sees, the upper bound infinite and `closed` false. The loop must be stable, which is not tested
/// here.
/// @throws as antenna_state_space_controller and peak_gain.
PeakGain worst_compliance(const plant::AntennaPlant& plant, const plant::StateSpace& controller,
                          double delay, const PeakGainOptions& options = {});

}  // namespace boresight::control
