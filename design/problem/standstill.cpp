#include <cmath>

#include <boresight/design/problem/standstill.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::design {

std::vector<double> standstill_friction(const plant::Antenna& antenna) {
  const double step = std::sqrt(12.0) * sky_to_motor(antenna, antenna.sensors.encoder_noise);
  if (!(step > 0.0)) return {};
  const auto mode = plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna)));
  constexpr double sixth = 1.0 / 6.0;
  const double rate = 0.5 * step * sixth * two_pi * mode.frequency;
  const double friction = plant::equivalent_friction(antenna.friction_curve, rate);
  std::vector<double> slopes;
  for (const double part : {sixth, 2.0 * sixth, 1.0}) {
    if (part * friction > antenna.drive.viscous_friction) slopes.push_back(part * friction);
  }
  return slopes;
}

}  // namespace boresight::design
