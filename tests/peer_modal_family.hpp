#pragma once

#include "peer_family.hpp"
#include <boresight/plant/modal_system.hpp>

/// The antenna of peer_family.hpp as modes around a core of ten states.
namespace boresight::reference {

/// Inputs n, t, d and outputs y, u as those of peer_closed_loop(). With `open_at_valve` the valve's
/// command is d alone, not u + d, and the output loop_gain = -u is what comes back: L(s) from d to
/// loop_gain.
inline plant::ModalSystem peer_modal_system(Eigen::Index modes, const PeerGains& gains = {},
                                            bool open_at_valve = false) {
  const PeerDrive drive;
  const PeerModes shape = peer_modes(modes);
  plant::ModalSystem system;
  plant::StateSpace& core = system.core;
  core.states = {"xv", "vv", "T", "om", "th", "omt", "zr", "zp", "w1", "w2"};
  core.inputs = {"n", "t", "d", "motor angle", "motor rate", "beam angle"};
  core.outputs = {"y", "u", "loop_gain", "net torque", "wind torque"};
  constexpr Eigen::Index xv = 0, vv = 1, torque = 2, om = 3, th = 4, omt = 5, zr = 6, zp = 7,
                         w1 = 8, w2 = 9, states = 10;
  constexpr Eigen::Index n = 0, t = 1, d = 2, angle = 3, rate = 4, beam = 5, inputs = 6;
  // Each signal as a row over states, then inputs.
  const auto zero = [] { return Eigen::RowVectorXd(Eigen::RowVectorXd::Zero(states + inputs)); };
  Eigen::RowVectorXd motor_angle = zero(), motor_rate = zero(), beam_angle = zero(), wind = zero(),
                     rate_error = zero(), net = zero();
  motor_angle[th] = motor_angle[states + angle] = 1.0;
  motor_rate[om] = motor_rate[states + rate] = 1.0;
  beam_angle[th] = beam_angle[states + beam] = 1.0;
  wind[w2] = drive.wind_amplitude;
  wind[states + t] = 1.0;
  rate_error = -gains.position_gain * motor_angle;
  rate_error[zp] += gains.position_integral;
  rate_error[omt] -= 1.0;
  Eigen::RowVectorXd command = gains.rate_gain * rate_error;
  command[zr] += gains.rate_integral;
  Eigen::RowVectorXd valve = command;
  if (open_at_valve) valve.setZero();
  valve[states + d] += 1.0;
  net = -drive.friction * motor_rate;
  net[torque] += 1.0;

  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(states, states + inputs);
  const double wv = drive.valve_frequency;
  rows(xv, vv) = 1.0;
  rows.row(vv) = wv * wv * valve;
  rows(vv, xv) -= wv * wv;
  rows(vv, vv) -= 2.0 * drive.valve_damping * wv;
  rows.row(torque) = -drive.stiffness * motor_rate;
  rows(torque, xv) += drive.stiffness;
  rows(torque, torque) -= drive.leakage;
  rows.row(om) = (net + wind) / drive.inertia;
  rows.row(th) = motor_rate;
  rows(th, states + rate) = 0.0;
  rows.row(omt) = drive.tachometer_corner * motor_rate;
  rows(omt, omt) -= drive.tachometer_corner;
  rows.row(zr) = rate_error;
  rows.row(zp) = -motor_angle;
  rows(w1, w1) = -drive.slow_wind_corner;
  rows(w2, w1) = drive.fast_wind_corner;
  rows(w2, w2) = -drive.fast_wind_corner;
  rows(w1, states + n) = drive.slow_wind_corner;
  core.a = rows.leftCols(states);
  core.b = rows.rightCols(inputs);

  Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(5, states + inputs);
  outputs.row(0) = -drive.arcseconds / drive.gear_ratio * beam_angle;
  outputs.row(1) = command;
  outputs(1, states + d) += 1.0;
  outputs.row(2) = -command;
  outputs.row(3) = net;
  outputs.row(4) = wind;
  core.c = outputs.leftCols(states);
  core.d = outputs.rightCols(inputs);

  system.modes.frequency = shape.frequency;
  system.modes.damping_ratio = shape.damping_ratio;
  system.modes.force_shape.resize(modes, 2);
  system.modes.force_shape << shape.motor, shape.wind;
  system.modes.displacement_shape.resize(2, modes);
  system.modes.displacement_shape << shape.motor.transpose(), shape.beam.transpose();
  system.modes.forces = {"net torque", "wind torque"};
  system.modes.displacements = {"motor angle", "beam angle"};
  system.modes.rates = {"motor rate", ""};
  system.inputs = {"n", "t", "d"};
  system.outputs = {"y", "u", "loop_gain"};
  return system;
}

}  // namespace boresight::reference
