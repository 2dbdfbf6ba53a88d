#pragma once

#include <array>
#include <complex>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// The sensors that a controller reads, in this order wherever they are listed.
inline constexpr std::array sensor_names{"tachometer", "encoder", "motor_torque"};

/// Amplitude of a zero-order hold, sin(wT/2)/(wT/2). `frequency`: w, rad/s, 0 or more;
/// `sample_time`: T, s.
double hold_amplitude(double frequency, double sample_time);

/// The frequency response of a sampled controller from each sensor to the valve demand as the plant
/// receives it: C (z I - A)^-1 B + D at z = e^(jwT), times hold_amplitude. The hold's delay of T/2
/// and the computation's of T are not included; they are the dead time of the loop. From the Schur
/// form of A, one substitution of O(states^2) per frequency. Constant after construction, so that
/// threads can share it.
class SensorResponse {
 public:
  /// `controller`: sampled, inputs among sensor_names, first output valve_demand.
  explicit SensorResponse(const plant::StateSpace& controller);

  /// By sensor, 0 for one that is not read. `frequency`: rad/s, above 0.
  std::array<std::complex<double>, 3> at(double frequency) const;

 private:
  double sample_time_ = 0.0;
  Eigen::MatrixXcd schur_;               // upper triangular, of A - I
  Eigen::RowVectorXcd output_;           // C U
  Eigen::MatrixXcd input_;               // U^H B, by sensor
  std::array<double, 3> feedthrough_{};  // by sensor
};

}  // namespace boresight::control
