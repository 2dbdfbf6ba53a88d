#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::plant {
namespace {

void require_positive(const char* function, const char* argument, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InvalidInput(
        fmt::format("{}: expected a positive finite {}, found {}", function, argument, value));
  }
}

double total_displacement(const HydraulicDrive& drive) {
  return drive.motor_count * drive.displacement;
}

}  // namespace

double bulk_modulus_from_slosh(double line_length, double slosh_frequency, double density) {
  require_positive("bulk_modulus_from_slosh", "line length", line_length);
  require_positive("bulk_modulus_from_slosh", "slosh frequency", slosh_frequency);
  require_positive("bulk_modulus_from_slosh", "density", density);
  const double wave_speed = 2.0 * line_length * slosh_frequency;
  return wave_speed * wave_speed * density;
}

double slosh_frequency(double line_length, double bulk_modulus, double density) {
  require_positive("slosh_frequency", "line length", line_length);
  require_positive("slosh_frequency", "bulk modulus", bulk_modulus);
  require_positive("slosh_frequency", "density", density);
  return std::sqrt(bulk_modulus / density) / (2.0 * line_length);
}

double oil_stiffness(const HydraulicDrive& drive) {
  require_positive("oil_stiffness", "motor count", drive.motor_count);
  require_positive("oil_stiffness", "displacement", drive.displacement);
  require_positive("oil_stiffness", "torque efficiency", drive.torque_efficiency);
  require_positive("oil_stiffness", "volumetric efficiency", drive.volumetric_efficiency);
  require_positive("oil_stiffness", "bulk modulus", drive.bulk_modulus);
  require_positive("oil_stiffness", "volume V1", drive.volume_1);
  require_positive("oil_stiffness", "volume V2", drive.volume_2);
  const double efficiency = drive.efficiency_in_stiffness == EfficiencyInStiffness::both
                                ? drive.torque_efficiency * drive.volumetric_efficiency
                                : 1.0;
  const double displacement = total_displacement(drive);
  return efficiency * drive.bulk_modulus * displacement * displacement *
         (1.0 / drive.volume_1 + 1.0 / drive.volume_2);
}

double torque_per_pressure(const HydraulicDrive& drive) {
  return drive.torque_efficiency * total_displacement(drive);
}

double hydraulic_frequency(double oil_stiffness, double reflected_inertia) {
  require_positive("hydraulic_frequency", "oil stiffness", oil_stiffness);
  require_positive("hydraulic_frequency", "reflected inertia", reflected_inertia);
  return std::sqrt(oil_stiffness / reflected_inertia) / two_pi;
}

double inertia_from_resonance(double oil_stiffness, double frequency) {
  require_positive("inertia_from_resonance", "oil stiffness", oil_stiffness);
  require_positive("inertia_from_resonance", "frequency", frequency);
  const double angular = two_pi * frequency;
  return oil_stiffness / (angular * angular);
}

double hydraulic_damping(double oil_stiffness, double reflected_inertia, double leakage_rate,
                         double viscous_friction) {
  require_positive("hydraulic_damping", "oil stiffness", oil_stiffness);
  require_positive("hydraulic_damping", "reflected inertia", reflected_inertia);
  const double natural =
      std::sqrt((oil_stiffness + viscous_friction * leakage_rate) / reflected_inertia);
  return (leakage_rate + viscous_friction / reflected_inertia) / (2.0 * natural);
}

}  // namespace boresight::plant
