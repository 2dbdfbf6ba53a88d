#pragma once

#include <numbers>
#include <vector>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

/// The antenna of the examples: the elevation axis of a 70-m dish on four hydraulic motors with 24
/// flywheel disks each. Put your own numbers here. SI, at the motor shaft.
namespace elevation_axis {

inline constexpr double two_pi = 2.0 * std::numbers::pi;
inline constexpr double mdeg = std::numbers::pi / 180e3;  // rad

inline const std::vector<boresight::plant::GearStage> gear_stages{
    {134, 20}, {101, 21}, {113, 23}, {77, 20}, {754, 16}};
inline constexpr double motor_inertia = 4.0 * 0.3007;   // kg m2, with flywheels
inline constexpr double gear_train_inertia = 0.217088;  // kg m2
inline constexpr double dish_inertia = 3.2766e8;        // kg m2, about the elevation axis

inline double gear_ratio() {
  return boresight::plant::gear_ratio(gear_stages);
}

inline boresight::plant::HydraulicDrive hydraulic_drive() {
  return {.motor_count = 4.0,
          .displacement = 38.329e-6 / two_pi,
          .torque_efficiency = 0.938,
          .volumetric_efficiency = 0.9412,
          .bulk_modulus = 1229e6,
          .volume_1 = 0.02455,
          .volume_2 = 0.02457};
}

inline boresight::plant::AntennaPlant plant() {
  using namespace boresight::plant;
  StructureSpecification structure;
  structure.antenna_inertia = reflected_inertia(dish_inertia, gear_ratio());
  structure.bull_gear_beam_weight = 0.05;
  // Hz, damping ratio, fractions of inertia and wind torque, weight in the boresight angle.
  structure.modes = {{2.4, 0.01, 0.62, 0.75, 0.80},
                     {3.4, 0.01, 0.14, 0.15, 0.25},
                     {4.6, 0.01, 0.07, 0.05, -0.15},
                     {6.2, 0.01, 0.04, 0.05, 0.05}};
  structure.locked_rotor_frequency = 2.0;
  return {.drive = {.oil_stiffness = oil_stiffness(hydraulic_drive()),
                    .leakage_rate = 1.219,
                    .viscous_friction = 0.9,
                    .motor_inertia = motor_inertia + gear_train_inertia,
                    .valve_corner = two_pi * 12.0,
                    .valve_damping = 0.7,
                    .tachometer_corner = two_pi * 20.0},
          .structure = make_structure(structure)};
}

/// Tracking in a wind of 10 m/s.
inline boresight::design::TrackingProblem tracking_problem() {
  boresight::design::TrackingProblem problem;
  problem.plant = plant();
  problem.gear_ratio = gear_ratio();
  problem.delay = 0.03;
  problem.noise = {.encoder_rms = 0.1 * mdeg * gear_ratio(), .tachometer_rms = 0.02};
  problem.wind.site = {.air_density = 1.1,
                       .surface_drag = 0.005,
                       .torque_coefficient = 0.10,
                       .gradient_coefficient = 1.0,
                       .coherence_decay = 8.0,
                       .dish_diameter = 70.0};
  problem.wind.mean_speed = 10.0;
  return problem;
}

}  // namespace elevation_axis
