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
/// friction together. With leakage an opening below that of the breakaway torque moves nothing, so
/// that the rate is no sinusoid; the describing function of friction alone (equivalent_friction)
/// predicts limit cycles at rest too large.
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
/// after as many periods as it takes to settle to a thousandth, at most 20. Starts from the end of
/// `before`. By the implicit Euler method in 300 steps a period: exact to 2 %, from the hydraulic
/// mode's frequency to 1.5 times that to 4 %.
DriveOscillation oscillation_of(const FrictionDrive& drive, double frequency, double amplitude,
                                const DriveOscillation& before);

}  // namespace boresight::plant
