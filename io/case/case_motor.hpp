#pragma once

#include <optional>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

struct MotorEntry {
  long count = 1;
  Quantity inertia;  // one motor as built, flywheel included
  double flywheel_disks = 0.0;
  Quantity rotor_inertia;                                          // one bare motor
  Quantity disk_inertia;                                           // one flywheel disk
  bool disk_inertia_stated = true;                                 // else of a solid disk
  std::optional<Quantity> disk_radius, disk_length, disk_density;  // where a solid disk is stated
  Quantity displacement;
  Quantity torque_efficiency;
  Quantity volumetric_efficiency;
};

}  // namespace boresight::io
