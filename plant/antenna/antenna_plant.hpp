#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// One structural mode as a mass on a spring from the bull gear, reflected to the motor shaft.
struct StructuralMode {
  double inertia = 0.0;        // kg m2
  double stiffness = 0.0;      // N m/rad
  double damping = 0.0;        // N m s/rad
  double wind_fraction = 0.0;  // fraction of the wind torque that acts on it
  double beam_weight = 0.0;    // fraction of its angle in the boresight angle
};

/// Bull gear, gearbox spring and structural modes, all at the motor shaft.
/// Wind fractions (bull gear and modes) sum to 1, and so do the beam weights of make_structure;
/// those of linear_plant(Antenna) to its wind_torque_factor and boresight_factor.
struct Structure {
  double bull_gear_inertia = 0.0;  // kg m2
  double gear_stiffness = 0.0;     // N m/rad, motor shaft to bull gear
  double gear_damping = 0.0;       // N m s/rad
  double bull_gear_wind_fraction = 0.0;
  double bull_gear_beam_weight = 1.0;
  std::vector<StructuralMode> modes;
};

/// A structure specified by frequencies and inertia fractions.
struct StructureSpecification {
  struct Mode {
    double frequency = 0.0;  // Hz, with the bull gear locked
    double damping_ratio = 0.01;
    double inertia_fraction = 0.0;  // of the antenna inertia; the rest sits at the bull gear
    double wind_fraction = 0.0;
    double beam_weight = 0.0;
  };
  double antenna_inertia = 0.0;  // kg m2 at the motor shaft
  double bull_gear_wind_fraction = 0.0;
  double bull_gear_beam_weight = 0.0;
  std::vector<Mode> modes;
  /// Lowest frequency with the motor held (Hz): sets the gear spring.
  double locked_rotor_frequency = 0.0;
  double gear_damping_ratio = 0.01;
};

/// Springs and masses of a specification: k_i = J_i (2 pi f_i)^2, c_i = 2 zeta_i J_i 2 pi f_i; the
/// gear spring from the characteristic equation of bull gear and modes on it with the motor held,
/// Kg = w^2 (Jb + sum J_i / (1 - (w/w_i)^2)), and Cg = 2 zeta Kg / w.
/// @throws InvalidInput unless 0 < sum of fractions < 1, every frequency is positive, the locked
/// rotor frequency lies below every mode's, and wind fractions and beam weights each sum to 1
/// within 1e-6.
Structure make_structure(const StructureSpecification& specification);

/// Whole antenna inertia at the motor shaft (kg m2).
double antenna_inertia(const Structure& structure);

/// Boresight angle for a unit of rotation of the rigid antenna: the sum of its beam weights.
double boresight_factor(const Structure& structure);

/// Oil, motors, valve and tachometer, all motors lumped at the motor shaft.
struct Drive {
  double oil_stiffness = 0.0;     // N m/rad
  double leakage_rate = 0.0;      // 1/s, stiffness/leakage damper
  double viscous_friction = 0.0;  // N m s/rad
  double motor_inertia = 0.0;     // kg m2: motors, flywheels, gear train, counter-torque motors
  double valve_corner = 0.0;      // rad/s
  double valve_damping = 0.7;
  double tachometer_corner = 0.0;  // rad/s, first-order lag
};

/// The linear antenna at the motor shaft, from physics of the reference antenna:
///   valve      xv'' + 2 zv wv xv' + wv^2 xv = wv^2 u        u, xv in rad/s of no-load motor speed
///   torque     Tm' = K (xv - w) - lambda Tm
///   motor      Jm w' = Tm - Bf w - Kg (tm - tb) - Cg (w - wb)
///   bull gear  Jb wb' = Kg (tm - tb) + Cg (w - wb) - sum[k_i (tb - q_i) + c_i (wb - q_i')] + wb Tw
///   modes      J_i q_i'' = k_i (tb - q_i) + c_i (wb - q_i') + w_i Tw
struct AntennaPlant {
  Drive drive;
  Structure structure;
};

/// Inertia at the motor shaft of the antenna with a rigid structure (kg m2).
double reflected_inertia(const AntennaPlant& plant);

/// Inputs valve_command (rad/s), wind_torque (N m). Outputs tachometer (rad/s), motor_torque (N m),
/// encoder (rad of motor, at the bull gear), `boresight` (boresight, rad of motor). 8 + 2 modes
/// states. The free rotation of the antenna is an eigenvalue at 0.
/// @throws InvalidInput for a parameter that is not finite, an inertia, stiffness, valve or
/// tachometer corner that is not positive, or a damping, leakage or friction below 0.
StateSpace to_state_space(const AntennaPlant& plant);

/// One mode of the plant.
struct PlantMode {
  std::complex<double> pole;       // rad/s, upper half plane
  double frequency = 0.0;          // |pole|/2 pi, Hz
  double damping_ratio = 0.0;      // -Re(pole)/|pole|
  std::string description;         // what moves most, or that it is hydraulic_mode; unique
  double participation = 0.0;      // of the described part, 0..1
  double oil_participation = 0.0;  // of motors and oil spring, whatever moves most
  /// d ln frequency^2/d ln oil_stiffness, leakage rate fixed. Without damping this is the oil
  /// spring's fraction of the mode's elastic energy, 1 for a rigid antenna. With strong damping it
  /// may leave 0 to 1.
  double oil_fraction = 0.0;
  double gear_fraction = 0.0;  // the same by the gear stiffness, its damping fixed
};

/// Modes in order of frequency. A part's participation is the sum of |left_k right_k| over its
/// states, normalised to 1 over all parts. A mode is described by the part of largest
/// participation; equal descriptions are numbered. hydraulic_mode is described as such, with the
/// participation of motors, oil spring, bull gear and gear spring together. If a structural mode
/// moves more, that description comes first.
std::vector<PlantMode> plant_modes(const AntennaPlant& plant);

/// The mode in which the whole antenna moves on the oil spring, with the structure's flexure in
/// series: the lowest of the modes that move the oil. Only this mode keeps its identity as inertia
/// or stiffness change. With oil stiffer than the structure, the motors' largest motion passes from
/// mode to mode above it. Its oil_fraction shows whether it is a measure of the oil. With a gear
/// spring far softer than the oil it is not, and mode_of_oil is.
/// If friction and leakage overdamp it, its two real poles p1, p2 are returned as one mode of
/// frequency sqrt(p1 p2) and damping ratio (p1 + p2)/(2 sqrt(p1 p2)) above 1. `modes`: in order of
/// frequency, as returned by plant_modes.
/// @throws NumericalFailure if no mode moves motors and oil.
PlantMode hydraulic_mode(const std::vector<PlantMode>& modes);

/// The mode of the largest oil_fraction: hydraulic_mode, if no other has more.
/// @throws NumericalFailure as hydraulic_mode.
PlantMode mode_of_oil(const std::vector<PlantMode>& modes);

}  // namespace boresight::plant
