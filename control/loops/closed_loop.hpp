#pragma once

#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::control {

/// Order of the rational dead time in the state-space methods; see
/// StabilityVerdict::dead_time_residue.
inline constexpr int delay_order = 8;

/// Plant, controller and rational dead time as one state space. Inputs: wind_torque (N m),
/// encoder_noise (rad), tachometer_noise (rad/s), rate_disturbance (rad/s) and, if the controller
/// feeds torque back, torque_noise (N m). Outputs: boresight (`boresight`) and encoder (rad),
/// tachometer (rad/s), motor_torque (N m), valve_demand (rad/s).
plant::StateSpace closed_loop(const plant::AntennaPlant& plant, const Controller& controller,
                              double delay);

/// Stability by eigenvalues, position loop open and closed.
struct StabilityVerdict {
  double rate_loop_abscissa = 0.0;    // 1/s, largest real part with the position loop open
  double closed_loop_abscissa = 0.0;  // 1/s, both closed
  /// max over frequency of |Delta L / (1 + L)|, at the valve with both loops closed and with the
  /// rate loop alone. Delta L is the error of the rational dead time. Below 1 the exact loop has as
  /// many unstable poles as the rational one (Nyquist), so the verdict by eigenvalues holds for the
  /// exact dead time.
  double dead_time_residue = 0.0;

  bool stable() const {
    return rate_loop_abscissa < 0.0 && closed_loop_abscissa < 0.0 && dead_time_residue < 1.0;
  }
};

/// With the position loop open, the free angle and the position integrator are removed, because
/// nothing restores them. `frequency`: grid (rad/s) for the residue. A state space: by the exact
/// sampled loop (sampled_closed_loop), ln(spectral radius)/T, without residue; having no rate loop,
/// it has one abscissa. `delay` is then unused, here and in lyapunov_rms (sampled_loop_rms).
StabilityVerdict stability(const plant::AntennaPlant& plant, const Controller& controller,
                           double delay, const Eigen::ArrayXd& frequency);

/// Boresight rms (rad of motor) by Lyapunov equations on the state space, independent of the
/// frequency response. Wind enters through its shaping filter; sensor noise is white without band
/// limit.
struct LyapunovRms {
  double wind = 0.0;
  double noise = 0.0;
  double total = 0.0;
  double relative_residual = 0.0;
};

/// @throws NumericalFailure if the closed loop is unstable.
LyapunovRms lyapunov_rms(const plant::AntennaPlant& plant, const Controller& controller,
                         double delay, const plant::ShapingFilter& wind, const SensorNoise& noise);

}  // namespace boresight::control
