#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/control/lqg/lqg.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::design {

/// What a sampled controller does on one plant. Rms in rad of motor over all time.
struct SampledJudgement {
  /// Largest magnitude of a closed-loop eigenvalue: stable below 1. Where it is not, rms and effort
  /// are NaN.
  double spectral_radius = 0.0;
  double wind_rms = 0.0;
  double noise_rms = 0.0;
  double beam_rms = 0.0;
  double valve_effort = 0.0;  // rad/s rms of the command from the sensors' noise
};

/// A local view of |S| = 1/|1 + L| at the valve command.
struct SampledPeak {
  double frequency = 0.0;  // rad/s
  double magnitude = 0.0;
};

/// One plant with the wind and the sensors' noise of its case, zero-order hold and one sample of
/// computation delay: prepared once, then controllers are judged on it in O(states^3). A controller
/// takes any of tachometer, encoder, motor_torque and drives valve_command; its other inputs
/// (references) rest.
class SampledSetting {
 public:
  /// `frequency`: rad/s, rising, where peaks are looked for (below the Nyquist frequency).
  /// Torque noise of 0 (not stated) counts as a thousandth of the wind's torque.
  /// @throws InvalidInput for another noise that is not positive (such a sensor leaves nothing to
  /// estimate), and as control::sampled_problem.
  SampledSetting(std::string name, const plant::AntennaPlant& plant,
                 const plant::ShapingFilter& wind, const control::SensorNoise& noise,
                 double sample_time, Eigen::ArrayXd frequency);

  const std::string& name() const { return name_; }
  /// For least beam rms: beam weight 1 and a command weight that is next to nothing.
  const control::LqgProblem& problem() const { return problem_; }
  const control::SampledLqgProblem& sampled() const { return sampled_; }
  const plant::AntennaPlant& plant() const { return plant_; }
  const Eigen::ArrayXd& frequency() const { return frequency_; }

  double spectral_radius(const plant::StateSpace& controller) const;
  SampledJudgement judge(const plant::StateSpace& controller) const;
  /// Parts of the same of a controller known to be stable here, at half the work and less.
  double beam_rms(const plant::StateSpace& controller) const;
  double valve_effort(const plant::StateSpace& controller) const;

  /// Response of a controller at `frequency`, one column a measured signal (tachometer, encoder,
  /// motor_torque): the same for every setting of these frequencies.
  static Eigen::ArrayXXcd controller_response(const plant::StateSpace& controller,
                                              const Eigen::ArrayXd& frequency);
  /// The highest |S|, between the frequencies by a parabola in the logarithms.
  SampledPeak highest_peak(const Eigen::ArrayXXcd& controller_response) const;

 private:
  struct ClosedLoop;
  ClosedLoop close(const plant::StateSpace& controller) const;
  Eigen::MatrixXd wind_jolts(const ClosedLoop& loop) const;
  Eigen::MatrixXd noise_jolts(const ClosedLoop& loop) const;
  double beam_variance(const ClosedLoop& loop, const Eigen::MatrixXd& covariance,
                       double direct_variance) const;

  std::string name_;
  plant::AntennaPlant plant_;
  control::LqgProblem problem_;
  control::SampledLqgProblem sampled_;
  Eigen::ArrayXd frequency_;
  Eigen::ArrayXXcd response_;  // of the sampled plant, one column a measured signal
};

}  // namespace boresight::design
