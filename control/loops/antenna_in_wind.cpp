#include <algorithm>
#include <cmath>

#include <boresight/control/loops/antenna_in_wind.hpp>

namespace boresight::control {

plant::StateSpace antenna_in_wind(const plant::AntennaPlant& plant,
                                  const plant::ShapingFilter& wind) {
  const auto command =
      plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {"valve_command"}, {"held_command"});
  auto filter = plant::to_state_space(wind, "wind_torque");
  filter.inputs = {"wind_white_noise"};
  return plant::connect({plant::to_state_space(plant), command, filter},
                        {"valve_command", "wind_white_noise"},
                        {"tachometer", "motor_torque", "encoder", "beam", "held_command"});
}

double sample_variance(double rms, double bandwidth, double sample_time) {
  return rms * rms / (2.0 * bandwidth * sample_time);
}

SampledPointing sampled_pointing(const SampledLoop& loop, const SensorNoise& noise) {
  SampledLoopNoise wind, sensors;
  wind.disturbance_intensity["wind_white_noise"] = 1.0;
  for (const auto& [name, rms] :
       {std::pair("tachometer", noise.tachometer_rms), std::pair("encoder", noise.encoder_rms),
        std::pair("motor_torque", noise.torque_rms)}) {
    const auto& taken = loop.controller.inputs;
    if (std::ranges::find(taken, name) == taken.end()) continue;
    sensors.measurement_variance[name] =
        sample_variance(rms, noise.bandwidth, loop.controller.sample_time);
  }
  SampledPointing result;
  result.wind_rms = sampled_loop_rms(loop, wind, {"beam"}).over_time[0];
  const auto from_noise = sampled_loop_rms(loop, sensors, {"beam", "held_command"});
  result.noise_rms = from_noise.over_time[0];
  result.control_effort = from_noise.over_time[1];
  result.boresight_rms = std::hypot(result.wind_rms, result.noise_rms);
  return result;
}

}  // namespace boresight::control
