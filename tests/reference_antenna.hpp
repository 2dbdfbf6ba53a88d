#pragma once

#include <numbers>
#include <vector>

#include "random_numbers.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>
#include <boresight/plant/wind/wind.hpp>

/// The elevation axis of the 70-m antenna: Sommerville's paper where it gives a number, the assumed
/// scale of physics elsewhere.
namespace boresight::reference {

inline constexpr double lbf_ft_s2 = 1.3558179483314004;  // kg m2
inline constexpr double mdeg = std::numbers::pi / 180.0 * 1e-3;
inline constexpr double rpm = two_pi / 60.0;

inline std::vector<plant::GearStage> gear_stages() {
  return {{134, 20}, {101, 21}, {113, 23}, {77, 20}, {754, 16}};
}

inline double gear_ratio() {
  return plant::gear_ratio(gear_stages());
}

inline double antenna_inertia() {
  return plant::reflected_inertia(2.41667e8 * lbf_ft_s2, gear_ratio());
}

/// Four motors with flywheels of that many disks.
inline double motor_inertia(double disks) {
  return 4.0 * (0.004108 + disks * 0.012358);
}

/// Rows 1 to 5 of Table 3.
inline constexpr double gear_train_inertia = 0.14146 + 0.02025 + 0.004989 + 0.002088 + 0.048402;

inline plant::HydraulicDrive hydraulic_drive() {
  return {4.0,     38.329e-6 / two_pi,
          0.938,   0.9412,
          1229e6,  0.02455,
          0.02457, plant::EfficiencyInStiffness::both};
}

inline plant::StructureSpecification structure() {
  plant::StructureSpecification structure;
  structure.antenna_inertia = antenna_inertia();
  structure.bull_gear_wind_fraction = 0.0;
  structure.bull_gear_beam_weight = 0.05;
  structure.modes = {{2.4, 0.01, 0.62, 0.75, 0.80},
                     {3.4, 0.01, 0.14, 0.15, 0.25},
                     {4.6, 0.01, 0.07, 0.05, -0.15},
                     {6.2, 0.01, 0.04, 0.05, 0.05}};
  structure.locked_rotor_frequency = 2.0;
  return structure;
}

inline plant::AntennaPlant antenna(double disks = 24.0) {
  plant::Drive drive;
  drive.oil_stiffness = plant::oil_stiffness(hydraulic_drive());
  drive.leakage_rate = 1.219;
  drive.viscous_friction = 0.9;
  drive.motor_inertia = motor_inertia(disks) + gear_train_inertia;
  drive.valve_corner = two_pi * 12.0;
  drive.tachometer_corner = two_pi * 20.0;
  return {drive, plant::make_structure(structure())};
}

inline plant::WindSite wind_site() {
  return {1.1, 0.005, 0.10, 1.0, 8.0, 70.0};
}

/// A plant with up to six modes, of no antenna in particular.
inline plant::AntennaPlant random_antenna(RandomNumbers& random) {
  plant::AntennaPlant plant = antenna();
  plant.drive.oil_stiffness *= random.log_uniform(0.3, 3.0);
  plant.drive.leakage_rate = random.log_uniform(0.05, 5.0);
  plant.drive.viscous_friction = random.uniform(0.0, 12.0);
  plant.drive.motor_inertia *= random.log_uniform(0.3, 3.0);
  plant.drive.valve_corner *= random.log_uniform(0.3, 3.0);
  plant.drive.valve_damping = random.uniform(0.3, 1.2);
  plant.drive.tachometer_corner *= random.log_uniform(0.3, 3.0);
  plant::StructureSpecification specification;
  specification.antenna_inertia = antenna_inertia() * random.log_uniform(0.3, 3.0);
  specification.locked_rotor_frequency = random.log_uniform(0.8, 4.0);
  specification.gear_damping_ratio = random.log_uniform(0.002, 0.05);
  const int modes = random.integer(1, 6);
  double wind = 0.0, boresight = 0.0;
  for (int i = 0; i < modes; ++i) {
    plant::StructureSpecification::Mode mode;
    mode.frequency = specification.locked_rotor_frequency * random.log_uniform(1.1, 8.0);
    mode.damping_ratio = random.log_uniform(0.002, 0.05);
    mode.inertia_fraction = random.uniform(0.1, 0.9) / modes;
    mode.wind_fraction = random.uniform(-0.2, 1.0);
    mode.beam_weight = random.uniform(-0.5, 1.0);
    wind += mode.wind_fraction;
    boresight += mode.beam_weight;
    specification.modes.push_back(mode);
  }
  specification.bull_gear_wind_fraction = 1.0 - wind;
  specification.bull_gear_beam_weight = 1.0 - boresight;
  plant.structure = plant::make_structure(specification);
  return plant;
}

}  // namespace boresight::reference
