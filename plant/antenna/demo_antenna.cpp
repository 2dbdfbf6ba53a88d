#include <optional>

#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::plant {

Antenna demo_antenna() {
  constexpr double revolution = two_pi;
  constexpr double psi = 6894.757293168361;         // Pa
  constexpr double lbf_ft_s2 = 1.3558179483314004;  // kg m2
  constexpr double arc_second = degree / 3600.0;

  Antenna antenna;
  antenna.inertia = 2.41667e8 * lbf_ft_s2;
  antenna.gear_train.stages = {{134, 20}, {101, 21}, {113, 23}, {77, 20}, {754, 16}};
  // Four intermediate shafts with their gears, and the counter-torque motors: Table 1.
  antenna.gear_train.assemblies = {
      {1.5876, 4, 1}, {5.2576, 4, 2}, {31.294, 4, 3}, {194.5418, 4, 4}, {0.01207, 4, 0}};
  antenna.hydraulics = {.motor_count = 4.0,
                        .displacement = 38.329e-6 / revolution,
                        .torque_efficiency = 0.938,
                        .volumetric_efficiency = 0.9412,
                        .bulk_modulus = 1229e6,
                        .volume_1 = 0.02455,
                        .volume_2 = 0.02457};
  antenna.flywheels = {
      .motor_inertia = 0.3007, .counted_disks = 24.0, .disk_inertia = 0.012358, .disks = 24.0};
  antenna.drive = {.leakage_rate = 1.219,
                   .viscous_friction = 0.9,
                   .valve_frequency = 12.0,
                   .valve_damping = 0.7,
                   .supply_pressure = 2000.0 * psi,
                   .tracking_rate = 15.0 * arc_second,
                   .slew_rate = 0.25 * degree,
                   .rated_flow = std::nullopt,
                   .rated_pressure_drop = std::nullopt};
  antenna.friction_curve = {.coulomb_torque = 10.33,
                            .breakaway_torque = 16.83,
                            .stribeck_rate = 0.15,
                            .saturating_torque = 63.29,
                            .saturating_rate = 1.5,
                            .viscous_friction = 2.075};
  antenna.structure = {.locked_rotor_frequency = 2.0,
                       .bull_gear_beam_weight = 0.05,
                       .modes = {{2.4, 0.01, 0.62, 0.75, 0.80},
                                 {3.4, 0.01, 0.14, 0.15, 0.25},
                                 {4.6, 0.01, 0.07, 0.05, -0.15},
                                 {6.2, 0.01, 0.04, 0.05, 0.05}}};
  antenna.sensors = {.encoder_noise = 1e-4 * degree,
                     .tachometer_noise = 0.02,
                     .torque_noise = 0.5,
                     .noise_bandwidth = 25.0,
                     .tachometer_frequency = 20.0};
  antenna.dead_time = 0.03;
  antenna.nonlinear = {.return_pressure = 60.0 * psi,
                       .null_leakage_share = 0.1,
                       .case_leakage_share = 0.1,
                       .valve_stroke = 150.0,
                       .valve_stroke_time = 0.05,
                       .makeup_pressure = 20.0 * psi,
                       .oil_density = 850.0,
                       .line_lengths = {13.11, 13.94, 14.77, 15.60},
                       .line_damping_ratio = 0.01,
                       .bristle_stiffness = 2500.0,
                       .bristle_damping = 5.0,
                       .offset_torque = -5.65,
                       .preload_torque = 20.0,
                       .backlash = 0.1};
  return antenna;
}

}  // namespace boresight::plant
