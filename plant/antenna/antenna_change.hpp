#pragma once

#include <string>
#include <vector>

#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::plant {

/// One number of an antenna that is set, or multiplied, by its path. Paths are the keys of the case
/// file ("oil.bulk_modulus", "structure.mode[0].frequency"), and beside these:
///   at_shaft.antenna_inertia, at_shaft.motor_inertia, at_shaft.gear_train_inertia,
///   at_shaft.oil_stiffness    as ShaftNumbers; scaled, they start from what the parts make,
///   structure.frequencies     all modes and the locked rotor; to be scaled only,
///   structure.wind_torque_factor.
struct AntennaChange {
  enum class How { set, scale };
  std::string path;
  How how = How::set;
  double number = 0.0;
};

/// The changes "set" and "scale".
AntennaChange set_to(std::string path, double number);
AntennaChange scaled_by(std::string path, double factor);

/// The antenna with these changes, applied one after the other; all else is unchanged.
/// @throws InvalidInput for a path that the antenna does not have, a number that is not finite, and
/// a number without effect because one of at_shaft replaces it.
Antenna changed(Antenna antenna, const std::vector<AntennaChange>& changes);

/// The paths that an antenna has, in the order of its members.
std::vector<std::string> change_paths(const Antenna& antenna);

}  // namespace boresight::plant
