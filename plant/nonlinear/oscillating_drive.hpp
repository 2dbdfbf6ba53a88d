#pragma once

#include <complex>
#include <limits>

#include <Eigen/Core>

#include <boresight/plant/antenna/friction.hpp>

namespace boresight::plant {

/// Oil, motors and a rigid antenna with dry friction, at the motor shaft, without the valve's
/// dynamics:
///   T' = K (x sqrt(1 - T sign(x)/Ts) - w) - lambda T,   J w' = T - F(w),
/// x being the port's opening as no-load motor speed. At rest F takes any value up to the larger of
/// breakaway and Coulomb torque.
struct FrictionDrive {
  double oil_stiffness = 0.0;  // K, N m/rad
  double leakage_rate = 0.0;   // lambda, 1/s
  double inertia = 0.0;        // J, kg m2, of motors and antenna
  FrictionCurve friction;
  double viscous_friction = 0.0;  // N m s/rad, in addition to that of the curve
  double supply_torque = std::numeric_limits<double>::infinity();  // Ts, less that of the return
};

/// Its steady oscillation under a sinusoidal opening: the describing function of oil, leakage and
/// friction together. An opening of amplitude below T |j w + lambda|/K, with the breakaway torque
/// T, does not move the motor; above it the motion is stick-slip and the rate no sinusoid, so that
/// the describing function of friction alone (equivalent_friction) predicts too large limit cycles.
struct DriveOscillation {
  std::complex<double> rate;    // fundamental of the motor rate, per opening
  std::complex<double> torque;  // fundamental of the motor torque, N m s/rad
  /// The motor's angle (rad) at equal steps of a period, the first one step after the opening's
  /// upward passage through 0. The middle of its range is 0.
  Eigen::ArrayXd angle;
  // At the end of a period, from which the next oscillation may start.
  double end_torque = 0.0;  // N m
  double end_rate = 0.0;    // rad/s
};

/// The oscillation for an opening of this amplitude (rad/s) and frequency (rad/s), both above 0,
/// after the periods in which its fundamental settles to a thousandth, at most 20. Starts from the
/// end of `before`. By the implicit Euler method in 300 steps a period, which adds 0.01 to the
/// damping ratio of the hydraulic mode: 2 % of the fundamental below it and 4 % above, 10 % at a
/// damping ratio of 0.1 at its frequency. At low frequencies slips are overdamped.
DriveOscillation oscillation_of(const FrictionDrive& drive, double frequency, double amplitude,
                                const DriveOscillation& before);

}  // namespace boresight::plant
