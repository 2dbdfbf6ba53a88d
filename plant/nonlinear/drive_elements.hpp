#pragma once

#include <vector>

#include <boresight/numerics/value_and_derivative.hpp>
#include <boresight/plant/antenna/friction.hpp>

/// The parts of the hydraulic drive at the motor shaft, all motors lumped. Pressures are written as
/// the torque they would give on all motors together, e_t D p (N m), flows as the motor speed that
/// takes them, q/(e_v D) (rad/s): one magnitude for all states.
namespace boresight::plant {

/// Servo valve of second order, its opening counted as the no-load motor speed (rad/s) it gives at
/// the supply pressure: xv'' + 2 zeta w xv' + w^2 xv = w^2 u.
struct ServoValve {
  double corner = 0.0;   // rad/s
  double damping = 0.7;  // of critical
  /// Port fully open (rad/s): the spool may move on, the flow does not grow.
  double stroke_limit = 0.0;
  /// Largest spool speed (rad/s2): pilot flow. Infinite: none.
  double slew_limit = 0.0;
  /// Spool travel about the centre over which both ports are covered (rad/s).
  double overlap = 0.0;
  /// Opening at zero command (rad/s).
  double null_offset = 0.0;
};

/// Port opening of a spool position: odd, 0 within the overlap, then in proportion, constant beyond
/// the stroke limit: overlap <= stroke_limit.
numerics::ValueAndDerivative port_opening(const ServoValve& valve, double spool);

/// One motor's pair of oil lines (inlet and outlet alike), closed by the motor at one end and the
/// valve at the other: half-wave modes k c/(2L), k = 1..modes, driven by both ends' flows.
struct OilLine {
  double length = 0.0;         // m
  double half_wave = 0.0;      // Hz: the slosh frequency c/(2L)
  double damping_ratio = 0.0;  // of each of its modes
};

/// Oil between valve and motors: two sides of trapped volume, lines, leakage.
struct OilCircuit {
  /// e_t e_v beta D^2/V of either side (N m/rad): their sum is the oil stiffness of the linear
  /// model.
  double stiffness_1 = 0.0;
  double stiffness_2 = 0.0;
  /// Leakage conductances, rad/s per N m: across the motors; through the valve's centre, from the
  /// supply to each side and from each side to the return; from each side to the case.
  double cross_leakage = 0.0;
  double null_leakage = 0.0;
  double case_leakage = 0.0;
  double supply_torque = 0.0;  // N m
  double return_torque = 0.0;  // N m
  /// Fall of the supply with the port's opening (N m per rad/s), which is the flow taken from it
  /// where the load is small.
  double supply_droop = 0.0;
  /// Pressure difference (N m) below which the orifice's square root turns into a straight line.
  double laminar_torque = 0.0;
  /// Make-up valves: flow from the return as soon as a side falls below this torque (N m), rad/s
  /// per N m: keeps the oil from cavitating. Conductance 0: none.
  double makeup_torque = 0.0;
  double makeup_conductance = 0.0;
  /// Undissolved air by volume at the atmosphere's pressure; softens the oil where pressures are
  /// low. 0: none.
  double air_fraction = 0.0;
  /// beta e_t D and the atmosphere's pressure as torque (N m): used for the air only.
  double bulk_modulus_torque = 0.0;
  double atmosphere_torque = 0.0;
  double polytropic_exponent = 1.4;
  double torque_per_pressure = 0.0;  // N m/Pa: turns torques into port pressures
  /// One entry a motor. Their volume is in proportion to length. Without entries the motors sit at
  /// the valve.
  std::vector<OilLine> lines;
  int modes_per_line = 2;
};

/// How much the air softens a side at torque-equivalent pressure p, beta_eff/beta
///   1/(1 + (beta/n p) a (p_a/p)^(1/n)),   p absolute
/// (H. E. Merritt, Hydraulic Control Systems, 1967, ch. 2, with a polytropic gas). 1 without air;
/// below a thousandth of an atmosphere its value there.
numerics::ValueAndDerivative stiffness_ratio(const OilCircuit& oil, double torque);

/// Flow of the make-up valve of a side (rad/s) at torque-equivalent pressure p: conductance times
/// max(0, makeup_torque - p).
numerics::ValueAndDerivative makeup_flow(const OilCircuit& oil, double torque);

/// Friction of motors, gears and bearings at the motor shaft: LuGre bristles on a steady curve,
///   z' = w - stiffness |w| z / g(w),   T = stiffness z + damping z' + Bv w,
/// with g + Bv |w| the curve (C. Canudas de Wit et al., IEEE Trans. Automatic Control 40(3), 1995).
/// A stiffness of 0: no bristles, T = g(w) tanh(w/smoothing_rate) + Bv w instead.
struct MotorFriction {
  FrictionCurve curve;
  double bristle_stiffness = 0.0;  // N m/rad
  double bristle_damping = 0.0;    // N m s/rad
  double smoothing_rate = 0.01;    // rad/s
};

/// Gravity's torque about the elevation axis at the motor shaft, that friction tests see as an
/// offset: constant + cosine cos(elevation) + sine sin(elevation).
struct OffsetTorque {
  double constant = 0.0;  // N m
  double cosine = 0.0;
  double sine = 0.0;
  double elevation = 0.0;   // rad, where the antenna's motor angle is 0
  double gear_ratio = 1.0;  // motor turns per turn of the antenna
};

/// Torque at a motor angle (rad); the drive has to give it.
numerics::ValueAndDerivative offset_torque(const OffsetTorque& offset, double motor_angle);

/// Gear spring in two halves that counter-torque motors press against opposite flanks: both carry
/// while the windup stays below the preload's, then one half crosses its backlash.
struct GearContact {
  double stiffness = 0.0;       // N m/rad, both halves in contact
  double damping = 0.0;         // N m s/rad, the same
  double preload_torque = 0.0;  // N m of each half at rest
  /// Windup a flank crosses without contact (rad of motor). Infinite: contact is never lost and
  /// the spring linear.
  double backlash = 0.0;
};

/// Torque on the bull gear (N m), and what it changes with.
struct GearTorque {
  double value = 0.0;
  double by_windup = 0.0;
  double by_windup_rate = 0.0;
};

/// The two halves at a windup (motor minus bull gear, rad) and its rate: half the stiffness times
/// each half's compression beyond its flank; the damper of a half works only in contact, fully from
/// a tenth of the preload on. Continuous.
GearTorque gear_torque(const GearContact& gear, double windup, double windup_rate);

/// Energy the gear's springs hold at a windup (N m rad), the preload's included.
double gear_energy(const GearContact& gear, double windup);

/// @throws InvalidInput naming a parameter that is not finite or out of its range. Limits may be
/// infinite if their description allows it.
void validate(const ServoValve& valve);
void validate(const OilCircuit& oil);
void validate(const MotorFriction& friction);
void validate(const OffsetTorque& offset);
void validate(const GearContact& gear);

}  // namespace boresight::plant
