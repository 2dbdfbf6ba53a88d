#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/control/lqg/lqg.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::design {

/// Results of a sampled controller on one plant. Rms in rad of motor over all time.
struct SampledEvaluation {
  /// Largest magnitude of a closed-loop eigenvalue: stable below 1. Otherwise rms and effort are
  /// NaN.
  double spectral_radius = 0.0;
  double wind_rms = 0.0;
  double noise_rms = 0.0;
  double boresight_rms = 0.0;
  double control_effort = 0.0;  // rad/s rms of the command from the sensors' noise
};

/// A local maximum of |S| = 1/|1 + L|.
struct SampledPeak {
  double frequency = 0.0;  // rad/s
  double magnitude = 0.0;
};

/// A controller as a function of tachometer, encoder and motor_torque, in this order: zeros for a
/// sensor that it does not read. Other inputs (references) are 0 and left out.
/// @throws InvalidInput without the output valve_command.
plant::StateSpace from_sensors(const plant::StateSpace& controller);

/// Gramians of a controller's states in the closed loop, for weighted balancing (P. M. R.
/// Wortelboer, Frequency-weighted balanced reduction of closed-loop mechanical servo-systems,
/// thesis, Delft 1994).
struct ControllerGramians {
  Eigen::MatrixXd covariance;  // of the states, by wind and noise
  Eigen::MatrixXd cost_to_go;  // x'Y x: what the state x costs from then on, alone
};

/// One plant with the wind and the sensors' noise of its case, zero-order hold and one sample of
/// computation delay. It is prepared once; each controller is then evaluated in O(states^3). A
/// controller takes any of tachometer, encoder, motor_torque and drives valve_command; its other
/// inputs (references) are 0.
class SampledSetting {
 public:
  /// `frequency`: rad/s, rising, below the Nyquist frequency; the grid of the search for Ms. Torque
  /// noise of 0 (not stated) is replaced by a thousandth of the wind's torque. `encoder_gain`: by
  /// which the encoder's reading counts more than the angle, as small motion across an edge between
  /// two of its codes does.
  /// @throws InvalidInput for another noise that is not positive (a noiseless sensor leaves nothing
  /// to estimate), and as control::sampled_problem.
  SampledSetting(std::string name, const plant::AntennaPlant& plant,
                 const plant::ShapingFilter& wind, const control::SensorNoise& noise,
                 double sample_time, Eigen::ArrayXd frequency, double encoder_gain = 1.0);

  /// The names of tachometer, encoder and motor_torque, in this order.
  static const std::vector<std::string>& sensors();

  const std::string& name() const { return name_; }
  /// For least boresight rms: cost 1 on the boresight and a negligible cost on the command.
  const control::LqgProblem& problem() const { return problem_; }
  const control::SampledLqgProblem& sampled() const { return sampled_; }
  const plant::AntennaPlant& plant() const { return plant_; }
  const Eigen::ArrayXd& frequency() const { return frequency_; }

  double spectral_radius(const plant::StateSpace& controller) const;
  SampledEvaluation evaluate(const plant::StateSpace& controller) const;
  /// Parts of the same for a controller known to be stable here, at half the cost or less.
  double boresight_rms(const plant::StateSpace& controller) const;
  double control_effort(const plant::StateSpace& controller) const;

  /// In the closed loop of a controller that is stable here. Cost: boresight (rad^2), plus
  /// `command_weight` (s^2) per mean square of the command.
  ControllerGramians controller_gramians(const plant::StateSpace& controller,
                                         double command_weight) const;

  /// Response of a controller at `frequency`, one column per measured signal (tachometer, encoder,
  /// motor_torque): the same for every setting with these frequencies.
  static Eigen::ArrayXXcd controller_response(const plant::StateSpace& controller,
                                              const Eigen::ArrayXd& frequency);
  /// Ms at the valve command, also between the frequencies: the return difference is interpolated.
  SampledPeak highest_peak(const Eigen::ArrayXXcd& controller_response) const;
  /// The same of the position loop: cut at the encoder alone, with tachometer and torque fed back.
  SampledPeak highest_position_peak(const Eigen::ArrayXXcd& controller_response) const;
  /// The same of the gain from the encoder's reading to the motor torque, N m/rad, with tachometer
  /// and torque fed back. Of a plant whose motor friction locks, so that it does not move.
  SampledPeak highest_locked_motor_gain(const Eigen::ArrayXXcd& controller_response) const;

 private:
  struct ClosedLoop;
  ClosedLoop close(const plant::StateSpace& controller) const;
  Eigen::MatrixXd wind_jolts(const ClosedLoop& loop) const;
  Eigen::MatrixXd noise_jolts(const ClosedLoop& loop) const;
  double boresight_variance(const ClosedLoop& loop, const Eigen::MatrixXd& covariance,
                            double direct_variance) const;
  SampledPeak highest_of(const Eigen::ArrayXcd& numerator,
                         const Eigen::ArrayXcd& denominator) const;

  std::string name_;
  plant::AntennaPlant plant_;
  control::LqgProblem problem_;
  control::SampledLqgProblem sampled_;
  Eigen::ArrayXd frequency_;
  Eigen::ArrayXXcd response_;  // of the sampled plant, one column per measured signal
};

/// 1 + L of the loops of tachometer and motor torque, without the encoder's. Responses of the plant
/// to the command and of the controller to the sensors, frequencies x sensors.
Eigen::ArrayXcd inner_return_difference(const Eigen::ArrayXXcd& plant,
                                        const Eigen::ArrayXXcd& controller);

}  // namespace boresight::design
