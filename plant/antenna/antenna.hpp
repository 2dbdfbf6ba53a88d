#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/friction.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::plant {

/// Equal bodies that turn together behind the first `stages` reductions of a gear train.
struct GearAssembly {
  double inertia = 0.0;  // kg m2, of one about its own axis
  double count = 1.0;
  std::size_t stages = 0;
};

struct GearTrain {
  std::vector<GearStage> stages;  // from the motor to the antenna axis
  std::vector<GearAssembly> assemblies;
};

/// What the motors of a HydraulicDrive turn of their own.
struct Flywheels {
  double motor_inertia = 0.0;  // kg m2, of one motor with `counted_disks` disks on it
  double counted_disks = 0.0;
  double disk_inertia = 0.0;  // kg m2
  double disks = 0.0;         // on each motor
};

/// Valve, leakage and supply.
struct DriveRatings {
  double leakage_rate = 0.0;      // 1/s, as Drive
  double viscous_friction = 0.0;  // N m s/rad, of the linear plant
  double valve_frequency = 0.0;   // Hz
  double valve_damping = 0.7;     // of critical
  double supply_pressure = 0.0;   // Pa
  double tracking_rate = 0.0;     // rad/s at the sky
  double slew_rate = 0.0;         // rad/s at the sky
  double return_pressure = 0.0;   // Pa; NonlinearDrive::return_pressure where there is one
  /// Flow of the fully open valve (m3/s) at a total pressure drop over both edges (Pa).
  std::optional<double> rated_flow, rated_pressure_drop;
};

/// The flexible antenna by its frequencies with the bull gear held; see StructureSpecification.
struct AntennaStructure {
  double locked_rotor_frequency = 0.0;  // Hz
  double gear_damping_ratio = 0.01;
  double bull_gear_wind_fraction = 0.0;
  double bull_gear_beam_weight = 0.0;
  std::vector<StructureSpecification::Mode> modes;
  /// Multiplies the wind torque on bull gear and modes.
  double wind_torque_factor = 1.0;
};

/// Standard deviations of white noise up to the bandwidth, and the tachometer's lag.
struct Sensors {
  double encoder_noise = 0.0;         // rad at the sky
  double tachometer_noise = 0.0;      // rad/s of motor
  double torque_noise = 0.0;          // N m
  double noise_bandwidth = 0.0;       // Hz
  double tachometer_frequency = 0.0;  // Hz, first-order lag
};

/// What the linear plant leaves out of the drive; see DriveDetails.
struct NonlinearDrive {
  double return_pressure = 0.0;  // Pa
  double null_leakage_share = 0.1;
  double case_leakage_share = 0.0;
  double valve_stroke = 0.0;       // rad/s, no-load motor speed with the valve fully open
  double valve_stroke_time = 0.0;  // s, from the centre to fully open
  double valve_overlap = 0.0;      // fraction of the stroke
  double makeup_pressure = 0.0;    // Pa
  double air_fraction = 0.0;
  double oil_density = 0.0;          // kg/m3, of the lines' oil
  std::vector<double> line_lengths;  // m, one a motor; empty: motors at the valve
  double line_damping_ratio = 0.0;
  double bristle_stiffness = 0.0;  // N m/rad
  double bristle_damping = 0.0;    // N m s/rad
  double offset_torque = 0.0;      // N m: constant, and by the cosine and sine of the elevation
  double offset_cosine = 0.0;
  double offset_sine = 0.0;
  double preload_torque = 0.0;                                // N m, of each half of the gear train
  double backlash = std::numeric_limits<double>::infinity();  // rad of motor; infinite: none
};

/// Numbers found at the motor shaft by a test. Each takes the place of what the parts add up to.
struct ShaftNumbers {
  std::optional<double> antenna_inertia;     // kg m2
  std::optional<double> motor_inertia;       // kg m2, of all motors with their flywheels
  std::optional<double> gear_train_inertia;  // kg m2, with counter-torque motors
  std::optional<double> oil_stiffness;       // N m/rad
};

/// One axis of an antenna in SI units (frequencies in Hz), each number at the shaft where its part
/// turns. What follows from several of them is computed by the functions below and stored nowhere.
struct Antenna {
  double inertia = 0.0;    // kg m2, about the antenna axis
  double elevation = 0.0;  // rad, where the motor angle is 0
  /// Boresight error at the sky over the error of the axis: 1 for an elevation axis, the cosine of
  /// the elevation for an azimuth axis, whose boresight error is cross-elevation, and the cosine of
  /// the Y angle for the lower axis of an X-Y mount.
  double boresight_factor = 1.0;
  GearTrain gear_train;
  HydraulicDrive hydraulics;
  Flywheels flywheels;
  DriveRatings drive;
  FrictionCurve friction_curve;  // at the motor shaft, all motors
  AntennaStructure structure;
  Sensors sensors;
  double dead_time = 0.0;  // s, of controller and hold
  std::optional<NonlinearDrive> nonlinear;
  ShaftNumbers at_shaft;
};

/// Motor turns per turn of the antenna. @throws InvalidInput as gear_ratio(stages).
double gear_ratio(const Antenna& antenna);

/// An angle, rate or noise at the sky as the motors have it, and back: times and over the ratio.
double sky_to_motor(const Antenna& antenna, double at_sky);
double motor_to_sky(const Antenna& antenna, double of_motor);

/// Inertias at the motor shaft (kg m2): of the antenna without gear train, of gear train and
/// counter-torque motors, of all motors with their flywheels.
double antenna_inertia(const Antenna& antenna);
double gear_train_inertia(const Antenna& antenna);
double motor_inertia(const Antenna& antenna);

/// Oil spring at the motor shaft (N m/rad): at_shaft.oil_stiffness, else
/// oil_stiffness(HydraulicDrive).
double oil_stiffness(const Antenna& antenna);

/// The structure reflected to the motor shaft.
StructureSpecification structure_specification(const Antenna& antenna);

/// The linear plant at the motor shaft, whose beam weights sum to the boresight_factor.
/// @throws InvalidInput as gear_ratio, oil_stiffness and make_structure.
AntennaPlant linear_plant(const Antenna& antenna);

/// @throws InvalidInput for a number that no antenna has, naming it: those of linear_plant and
/// to_state_space, and any that is not finite or below 0 where that has no meaning. The nonlinear
/// numbers are checked by nonlinear_antenna.
void validate(const Antenna& antenna);

/// The elevation axis of a 70-m antenna on four hydraulic motors with 24 flywheel disks each.
/// Gear train, inertias, motors and oil by J. Sommerville, Determination of 70-Meter Antenna
/// Elevation-Axis Inertia, Jet Propulsion Laboratory (sections II and III, Tables 1 to 3); valve,
/// friction, structure, sensors and nonlinear drive are usual of such drives, and assumed.
Antenna demo_antenna();

}  // namespace boresight::plant
