#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/antenna/hydraulics.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>
#include <boresight/plant/integration/feedback_system.hpp>
#include <boresight/plant/nonlinear/drive_elements.hpp>

namespace boresight::plant {

/// The antenna with all differences from AntennaPlant: orifice flow, pressures on both sides,
/// lines, bristle friction, gravity's offset, backlash, valve limits.
struct NonlinearAntenna {
  ServoValve valve;
  OilCircuit oil;
  MotorFriction friction;
  OffsetTorque offset;
  GearContact gear;
  double motor_inertia = 0.0;      // kg m2: motors, flywheels, gear train, counter-torque motors
  double viscous_friction = 0.0;   // N m s/rad, in addition to that of the friction curve
  double tachometer_corner = 0.0;  // rad/s, first-order lag
  StructureModel structure;
};

/// Data of a nonlinear antenna beyond its linear plant and hydraulic drive.
struct DriveDetails {
  double supply_pressure = 0.0;  // Pa
  double return_pressure = 0.0;  // Pa
  double supply_droop = 0.0;     // Pa per rad/s of port opening
  /// Fractions of the leakage rate that flow through the valve's centre, and from either side to
  /// the case. The rest flows across the motors. With neither, the sides' mean pressure drifts.
  double null_leakage_share = 0.1;
  double case_leakage_share = 0.0;
  double stroke_limit = 0.0;  // these four as ServoValve
  double slew_limit = std::numeric_limits<double>::infinity();
  double overlap = 0.0;
  double null_offset = 0.0;
  double laminar_pressure = 1e4;  // Pa across an edge of the valve
  double makeup_pressure = 0.0;   // Pa
  /// Rate (1/s) at which an open make-up valve fills a side.
  double makeup_rate = 100.0;
  double air_fraction = 0.0;
  double oil_density = 0.0;          // kg/m3
  std::vector<double> line_lengths;  // m, one a motor; empty: motors at the valve
  double line_damping_ratio = 0.0;
  int modes_per_line = 2;
  MotorFriction friction;
  OffsetTorque offset;
  double preload_torque = 0.0;  // these two as GearContact
  double backlash = std::numeric_limits<double>::infinity();
};

/// The nonlinear antenna whose small motion about rest is that of `plant`, except for friction and
/// lines. The friction of `details` replaces the plant's viscous friction. The volumes determine
/// the sides' stiffnesses, whose sum is the plant's oil stiffness.
/// @throws InvalidInput for a drive as torque_per_pressure, fractions that are negative or sum to
/// more than 1, and as to_feedback_system.
NonlinearAntenna make_nonlinear_antenna(const AntennaPlant& plant, const HydraulicDrive& drive,
                                        const DriveDetails& details);

/// Indices of the states of to_feedback_system(antenna). The structure's states begin at
/// `structure`, followed by those of the line modes.
struct AntennaStates {
  enum : Eigen::Index {
    spool,       // rad/s, valve spool as no-load motor speed
    spool_rate,  // rad/s: its speed over the valve's corner
    side_1,      // N m, mean pressure of the side that drives upwards
    side_2,      // N m
    motor_angle,
    motor_rate,
    tachometer,  // rad/s
    bristle,     // rad; rests at 0 without bristles
    structure
  };
};

/// The antenna as a linear core with nonlinear channels.
///
/// Core, at the motor shaft (K1, K2: stiffness of either side; gx, g0, gc: leakage conductances):
///   spool      as ServoValve
///   side 1     p1' =  K1 (q1 - w - gx (p1 - p2) + g0 (ps + pr - 2 p1) - gc p1)
///   side 2     p2' = -K2 (q2 - w - gx (p1 - p2)) + K2 (g0 (ps + pr - 2 p2) - gc p2)
///   lines      pk' = 2 K r (flow into the line at both ends, times +-1 by the mode's shape)
///                    - 2 zeta wk pk - wk rk,   rk' = wk pk
///   motor      Jm w' = T - Bf w - friction - offset - gear torque,
///              T the mean over the motors of inlet less outlet torque at their ports
///   structure  as structure_dynamics, driven by the gear torque and the wind
///   tachometer w through a first-order lag
/// Orifice (o the port opening, s(y) a square root that keeps its sign):
///   o > 0: q1 = o s(2 (ps - p1)/(ps - pr)), q2 = o s(2 (p2 - pr)/(ps - pr)), and mirrored for o <
///   0
/// so that q1 = q2 = o sqrt(1 - sign(o) T/(ps - pr)) if both sides lie about their mean, as in the
/// physics of the reference antenna.
///
/// Inputs: valve_command (rad/s), then the wind forces of the structure (wind_torque). Observed:
/// tachometer, motor_torque, encoder, `boresight` as in to_state_space(AntennaPlant), then
/// motor_rate, motor_angle, spool, friction_torque (offset included), gear_torque. For each motor k
/// also inlet_pressure_k and outlet_pressure_k (Pa); for positive torque the inlet pressure is the
/// higher. Valid at any speed, elevation and pressure; linearise() computes the small-signal model
/// at a point.
/// @throws InvalidInput for a parameter that is not finite or out of its range, naming it.
FeedbackSystem to_feedback_system(const NonlinearAntenna& antenna);

/// Rotation of the whole antenna by one radian of motor, as a direction of the states.
Eigen::VectorXd rigid_rotation(const NonlinearAntenna& antenna);

/// State at rest, in balance except for offset and friction: both sides at mean pressure, bristles
/// straight.
Eigen::VectorXd state_at_rest(const NonlinearAntenna& antenna);

/// Stored energy (J at the motor shaft's scale: N m rad): kinetic energy of motors and structure,
/// springs, oil compressed about the mean pressure, bristle deflection. Without air; the gear with
/// its preload.
double stored_energy(const NonlinearAntenna& antenna, const Eigen::VectorXd& state);

}  // namespace boresight::plant
