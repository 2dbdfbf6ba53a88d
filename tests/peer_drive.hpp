#pragma once

#include <cmath>
#include <memory>

#include <Eigen/Core>

#include "peer_family.hpp"
#include <boresight/plant/integration/feedback_system.hpp>

/// The rate loop of the peers' antenna with the square root of its valve and with friction
/// (tests/data/reference/peers.json, nl_none, nl_tanh, nl_lugre): a triangular rate command, 60 s
/// from rest.
namespace boresight::reference {

enum class DriveFriction { none, tanh, lugre };

/// Values and derivatives of the drive's nonlinear elements.
class DriveChannels final : public plant::NonlinearChannels {
 public:
  explicit DriveChannels(DriveFriction friction) : friction_(friction) {}

  /// Valve position, load torque, [speed, [bristle deflection]].
  Eigen::Index inputs() const override {
    return friction_ == DriveFriction::none ? 2 : friction_ == DriveFriction::tanh ? 3 : 4;
  }
  /// What the flow is above the valve position, [friction torque or bristle rate].
  Eigen::Index outputs() const override { return friction_ == DriveFriction::none ? 1 : 2; }

  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const override {
    dn_dz.setZero();
    // q = x sqrt((d + sqrt(d^2 + 1e-6))/2), d = 1 - tanh(x/0.02) T/150
    const double side = std::tanh(z[0] / 0.02);
    const double d = 1.0 - side * z[1] / 150.0;
    const double root = std::sqrt(d * d + 1e-6);
    const double opening = std::sqrt(0.5 * (d + root));
    const double by_d = z[0] * opening / (2.0 * root);
    n[0] = z[0] * opening - z[0];
    dn_dz(0, 0) = opening - by_d * (1.0 - side * side) / 0.02 * z[1] / 150.0 - 1.0;
    dn_dz(0, 1) = -by_d * side / 150.0;
    if (friction_ == DriveFriction::none) return;

    const double v = z[2];
    const double bump = 6.0 * std::exp(-(v / 0.05) * (v / 0.05));
    const double level = 8.0 + bump, level_slope = -2.0 * v / (0.05 * 0.05) * bump;
    if (friction_ == DriveFriction::tanh) {
      const double turn = std::tanh(v / 0.005);
      n[1] = level * turn;
      dn_dz(1, 2) = level_slope * turn + level * (1.0 - turn * turn) / 0.005;
      return;
    }
    // v - 5000 |v| deflection/g(v)
    const double fraction = 5000.0 * z[3] / level;
    n[1] = v - std::abs(v) * fraction;
    dn_dz(1, 2) =
        1.0 - std::copysign(1.0, v) * fraction + std::abs(v) * fraction / level * level_slope;
    dn_dz(1, 3) = -5000.0 * std::abs(v) / level;
  }

 private:
  DriveFriction friction_;
};

/// Input: rate command (rad/s); observed: v, th, T.
inline plant::FeedbackSystem peer_drive(DriveFriction friction, Eigen::Index modes = 5) {
  const PeerDrive drive;
  const PeerModes shape = peer_modes(modes);
  const PeerGains gains;
  const bool lugre = friction == DriveFriction::lugre;
  enum : Eigen::Index { xv, vv, torque, om, th, omt, zr, zf };
  const Eigen::Index core = lugre ? 8 : 7;
  const Eigen::Index n = core + 2 * modes;
  plant::StateSpace system;
  system.states = {"xv", "vv", "T", "om", "th", "omt", "zr"};
  if (lugre) system.states.emplace_back("zf");
  for (Eigen::Index i = 0; i < modes; ++i) {
    system.states.push_back("eta" + std::to_string(i + 1));
    system.states.push_back("eta" + std::to_string(i + 1) + "'");
  }
  const auto channels = std::make_shared<const DriveChannels>(friction);
  const Eigen::Index q = channels->outputs(), p = channels->inputs();
  enum : Eigen::Index { command, flow, rubbing };
  system.inputs = {"w_c", "flow"};
  if (q > 1) system.inputs.emplace_back("friction");

  Eigen::RowVectorXd speed = Eigen::RowVectorXd::Zero(n);
  speed[om] = 1.0;
  for (Eigen::Index i = 0; i < modes; ++i) speed[core + 2 * i + 1] = shape.motor[i];
  // [A B] of the torque that moves the inertia and the modes
  Eigen::RowVectorXd net = Eigen::RowVectorXd::Zero(n + 1 + q);
  net.head(n) = -drive.friction * speed;
  net[torque] += 1.0;
  if (friction == DriveFriction::tanh) net[n + rubbing] = -1.0;
  if (lugre) {
    net[zf] = -5000.0;
    net[n + rubbing] = -40.0;
  }
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(n, n + 1 + q);
  rate(xv, vv) = 1.0;
  const double w2 = drive.valve_frequency * drive.valve_frequency;
  rate(vv, xv) = -w2;
  rate(vv, vv) = -2.0 * drive.valve_damping * drive.valve_frequency;
  rate(vv, omt) = -w2 * gains.rate_gain;
  rate(vv, zr) = w2 * gains.rate_integral;
  rate(vv, n + command) = w2 * gains.rate_gain;
  rate(torque, xv) = drive.stiffness;
  rate(torque, n + flow) = drive.stiffness;
  rate.row(torque).head(n) -= drive.stiffness * speed;
  rate(torque, torque) -= drive.leakage;
  rate.row(om) = net / drive.inertia;
  rate(th, om) = 1.0;
  rate.row(omt).head(n) = drive.tachometer_corner * speed;
  rate(omt, omt) -= drive.tachometer_corner;
  rate(zr, omt) = -1.0;
  rate(zr, n + command) = 1.0;
  if (lugre) rate(zf, n + rubbing) = 1.0;
  for (Eigen::Index i = 0; i < modes; ++i) {
    const Eigen::Index place = core + 2 * i;
    rate(place, place + 1) = 1.0;
    rate.row(place + 1) = shape.motor[i] * net;
    rate(place + 1, place) -= shape.frequency[i] * shape.frequency[i];
    rate(place + 1, place + 1) -= 2.0 * shape.damping_ratio[i] * shape.frequency[i];
  }
  system.a = rate.leftCols(n);
  system.b = rate.rightCols(1 + q);
  system.outputs = {"valve", "load"};
  if (p > 2) system.outputs.emplace_back("speed");
  if (p > 3) system.outputs.emplace_back("deflection");
  for (const char* name : {"v", "th", "T"}) system.outputs.emplace_back(name);
  system.c = Eigen::MatrixXd::Zero(p + 3, n);
  system.c(0, xv) = system.c(1, torque) = 1.0;
  if (p > 2) system.c.row(2) = speed;
  if (p > 3) system.c(3, zf) = 1.0;
  system.c.row(p) = speed;
  system.c(p + 1, th) = 1.0;
  system.c(p + 2, torque) = 1.0;
  system.d = Eigen::MatrixXd::Zero(p + 3, 1 + q);
  return {system, q, p, channels};
}

/// The rate command at t: a triangle of amplitude 0.5 and period 20 s with corners at 5 s, 15 s ...
inline double peer_rate_command(double t) {
  const double a = t / 20.0 - 0.25;
  return 0.5 * (4.0 * std::abs(a - std::floor(a) - 0.5) - 1.0);
}

}  // namespace boresight::reference
