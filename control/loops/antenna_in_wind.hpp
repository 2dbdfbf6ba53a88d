#pragma once

#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/linear/state_space.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::control {

/// The antenna with the shaping filter of its wind torque. Inputs: valve_command (rad/s),
/// wind_white_noise (unit intensity gives the wind spectrum). Outputs: tachometer, motor_torque,
/// encoder and boresight (`boresight`) as plant::to_state_space, held_command (rad/s: the command
/// in effect).
plant::StateSpace antenna_in_wind(const plant::AntennaPlant& plant,
                                  const plant::ShapingFilter& wind);

/// Variance of a noise sample read every `sample_time` (s), for noise of this rms that is white
/// over `bandwidth` (Hz). The samples have the same density up to the Nyquist frequency.
double sample_variance(double rms, double bandwidth, double sample_time);

/// Boresight and valve rms in steady state, in any sampled loop around antenna_in_wind.
struct SampledPointing {
  double boresight_rms = 0.0;   // rad of motor, over all time
  double wind_rms = 0.0;        // part from the wind
  double noise_rms = 0.0;       // part from sensor noise
  double control_effort = 0.0;  // rad/s rms of the command from sensor noise
};

/// With wind of unit intensity at wind_white_noise and the noise of the sensors that the controller
/// reads.
/// @throws as sampled_loop_rms.
SampledPointing sampled_pointing(const SampledLoop& loop, const SensorNoise& noise);

}  // namespace boresight::control
