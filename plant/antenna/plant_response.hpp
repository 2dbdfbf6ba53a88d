#pragma once

#include <Eigen/Core>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::plant {

/// What the drive sees of the structure, frequency by frequency: O(modes) each, made once and
/// shared by every drive in front of it (other flywheels, friction, oil, valve).
struct StructureResponse {
  Eigen::ArrayXd frequency;  // rad/s
  Eigen::ArrayXcd
      inertial_stiffness;          // b: dynamic stiffness of bull gear and modes, gear spring free
  Eigen::ArrayXcd gear_stiffness;  // G = Kg + s Cg
  Eigen::ArrayXcd wind_at_bull_gear;  // torque at the bull gear per wind torque, bull gear held
  Eigen::ArrayXcd boresight_per_bull_gear;  // rad/rad
  Eigen::ArrayXcd boresight_per_wind;       // rad/(N m), bull gear held: bending no encoder sees
};

StructureResponse structure_response(const Structure& structure, const Eigen::ArrayXd& frequency);

/// Responses from valve command (rad/s) and wind torque (N m) to tachometer (rad/s), motor torque
/// (N m), encoder and boresight (rad of motor) at s = j frequency.
struct PlantResponse {
  Eigen::ArrayXd frequency;  // rad/s
  Eigen::ArrayXcd tachometer_command, torque_command, encoder_command, boresight_command;
  Eigen::ArrayXcd tachometer_wind, torque_wind, encoder_wind, boresight_wind;
};

/// Closes the drive onto the structure: a few complex operations a frequency, whatever the number
/// of modes. The two-by-two elimination keeps the small difference of the coupled stiffnesses
/// exact, so that it holds down to frequencies far below the first mode.
PlantResponse plant_response(const StructureResponse& structure, const Drive& drive);

/// The same from the whole plant.
PlantResponse plant_response(const AntennaPlant& plant, const Eigen::ArrayXd& frequency);

/// Angular frequencies from `lowest` to `highest` (Hz), `points_per_decade` on a logarithmic grid,
/// plus 25 points within +-4 zeta w of each pole of the plant with damping ratio below 0.1: where a
/// response can turn faster than the plain grid follows.
Eigen::ArrayXd frequency_grid(const AntennaPlant& plant, double lowest, double highest,
                              int points_per_decade);

}  // namespace boresight::plant
