#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include <boresight/numerics/angles.hpp>
#include <boresight/plant/linear/state_space.hpp>
#include <boresight/plant/modal/modal_system.hpp>

/// The antenna servo that other programs were measured on (tests/data/reference/peers.json):
/// motor, valve, wind filter and rate and position loop at the motor side, with `modes` structural
/// modes from 1.75 to 50 Hz that the motor, the wind and the beam each see with a shape of their
/// own. n = 10 + 2 modes states.
namespace boresight::reference {

struct PeerGains {
  double rate_gain = 0.30;
  double rate_integral = 1.8;
  double position_gain = 0.45;
  double position_integral = 0.06;
};

/// What does not depend on the number of modes; SI, motor side.
struct PeerDrive {
  double inertia = 1.45;
  double hydraulic_frequency = two_pi * 0.97;
  double stiffness = inertia * hydraulic_frequency * hydraulic_frequency;
  double leakage = 2.0 * 0.25 * hydraulic_frequency;
  double friction = inertia * 2.0 * 0.05 * hydraulic_frequency;
  double valve_frequency = two_pi * 60.0;
  double valve_damping = 0.7;
  double tachometer_corner = two_pi * 20.0;
  double slow_wind_corner = two_pi * 0.03;
  double fast_wind_corner = two_pi * 0.6;
  /// Makes the wind torque 10 N m rms for white noise of unit intensity.
  double wind_amplitude = 10.0 / std::sqrt(slow_wind_corner * fast_wind_corner /
                                           (2.0 * (slow_wind_corner + fast_wind_corner)));
  double gear_ratio = 1e4;
  double arcseconds = 206264.80624709636;
};

/// Shapes seen at the motor, at the beam and by the wind, one element a mode.
struct PeerModes {
  Eigen::VectorXd frequency;  // rad/s
  Eigen::VectorXd damping_ratio;
  Eigen::VectorXd motor, boresight, wind;
};

inline PeerModes peer_modes(Eigen::Index modes) {
  const PeerDrive drive;
  PeerModes result{Eigen::VectorXd(modes), Eigen::VectorXd(modes), Eigen::VectorXd(modes),
                   Eigen::VectorXd(modes), Eigen::VectorXd(modes)};
  const double mass = 1.0 / std::sqrt(drive.inertia);
  for (Eigen::Index i = 0; i < modes; ++i) {
    const auto k = static_cast<double>(i);
    const double place = modes > 1 ? k / static_cast<double>(modes - 1) : 0.0;
    const double hertz = 1.75 * std::pow(50.0 / 1.75, place);
    const double size =
        mass * std::sqrt(5.0 / static_cast<double>(modes)) * std::sqrt(1.75 / hertz);
    result.frequency[i] = two_pi * hertz;
    result.damping_ratio[i] = 0.005 * (1.0 + place);
    result.motor[i] = 0.35 * size * (1.0 + 0.5 * std::cos(1.7 * k));
    result.boresight[i] = 0.50 * size * (1.0 + 0.5 * std::sin(2.3 * k)) * (i % 2 == 0 ? -1.0 : 1.0);
    result.wind[i] =
        0.40 * size * (1.0 + 0.5 * std::cos(0.9 * k + 1.0)) * (i % 3 == 0 ? -1.0 : 1.0);
  }
  return result;
}

/// Closed loop, inputs n (unit white noise of the wind), t (wind torque, N m), d (added to the
/// valve command); outputs y (pointing error, arcsec), u (valve command with d: d to u is the
/// sensitivity).
inline plant::StateSpace peer_closed_loop(Eigen::Index modes, const PeerGains& gains = {}) {
  const PeerDrive drive;
  const PeerModes shape = peer_modes(modes);
  plant::StateSpace system;
  system.states = {"xv", "vv", "T", "om", "th", "omt", "zr", "zp", "w1", "w2"};
  enum : Eigen::Index { xv, vv, torque, om, th, omt, zr, zp, w1, w2, core };
  for (Eigen::Index i = 0; i < modes; ++i) {
    system.states.push_back("eta" + std::to_string(i + 1));
    system.states.push_back("eta" + std::to_string(i + 1) + "'");
  }
  system.inputs = {"n", "t", "d"};
  system.outputs = {"y", "u"};
  const Eigen::Index n = core + 2 * modes;
  // Each signal as a row over the states; tau and u with their direct inputs besides.
  Eigen::RowVectorXd motor_angle = Eigen::RowVectorXd::Zero(n), motor_rate = motor_angle,
                     boresight_angle = motor_angle, wind = motor_angle;
  motor_angle[th] = motor_rate[om] = boresight_angle[th] = 1.0;
  wind[w2] = drive.wind_amplitude;
  for (Eigen::Index i = 0; i < modes; ++i) {
    motor_angle[core + 2 * i] = motor_rate[core + 2 * i + 1] = shape.motor[i];
    boresight_angle[core + 2 * i] = shape.boresight[i];
  }
  Eigen::RowVectorXd rate_error = -gains.position_gain * motor_angle;
  rate_error[zp] += gains.position_integral;
  rate_error[omt] -= 1.0;
  Eigen::RowVectorXd command = gains.rate_gain * rate_error;
  command[zr] += gains.rate_integral;
  Eigen::RowVectorXd net = -drive.friction * motor_rate;
  net[torque] += 1.0;

  const double wv = drive.valve_frequency;
  system.a = Eigen::MatrixXd::Zero(n, n);
  system.b = Eigen::MatrixXd::Zero(n, 3);
  system.a(xv, vv) = 1.0;
  system.a.row(vv) = wv * wv * command;
  system.a(vv, xv) -= wv * wv;
  system.a(vv, vv) -= 2.0 * drive.valve_damping * wv;
  system.a.row(torque) = -drive.stiffness * motor_rate;
  system.a(torque, xv) += drive.stiffness;
  system.a(torque, torque) -= drive.leakage;
  system.a.row(om) = (net + wind) / drive.inertia;
  system.a(th, om) = 1.0;
  system.a.row(omt) = drive.tachometer_corner * motor_rate;
  system.a(omt, omt) -= drive.tachometer_corner;
  system.a.row(zr) = rate_error;
  system.a.row(zp) = -motor_angle;
  system.a(w1, w1) = -drive.slow_wind_corner;
  system.a(w2, w1) = drive.fast_wind_corner;
  system.a(w2, w2) = -drive.fast_wind_corner;
  system.b(w1, 0) = drive.slow_wind_corner;
  system.b(om, 1) = 1.0 / drive.inertia;
  system.b(vv, 2) = wv * wv;
  for (Eigen::Index i = 0; i < modes; ++i) {
    const Eigen::Index eta = core + 2 * i;
    const double w = shape.frequency[i];
    system.a(eta, eta + 1) = 1.0;
    system.a.row(eta + 1) = shape.motor[i] * net + shape.wind[i] * wind;
    system.a(eta + 1, eta) -= w * w;
    system.a(eta + 1, eta + 1) -= 2.0 * shape.damping_ratio[i] * w;
    system.b(eta + 1, 1) = shape.wind[i];
  }
  system.c = Eigen::MatrixXd::Zero(2, n);
  system.c.row(0) = -drive.arcseconds / drive.gear_ratio * boresight_angle;
  system.c.row(1) = command;
  system.d = Eigen::MatrixXd::Zero(2, 3);
  system.d(1, 2) = 1.0;
  return system;
}

/// The same closed loop as modes around a core of ten states, written down on its own: the modes
/// are driven by the motor's torque and the wind, and bend the motor and the beam.
inline plant::ModalSystem peer_modal_system(Eigen::Index modes, const PeerGains& gains = {}) {
  const PeerDrive drive;
  const PeerModes shape = peer_modes(modes);
  plant::ModalSystem system;
  plant::StateSpace& core = system.core;
  core.states = {"xv", "vv", "T", "om", "th", "omt", "zr", "zp", "w1", "w2"};
  core.inputs = {"n", "t", "d", "motor bend", "motor bend rate", "beam bend"};
  core.outputs = {"y", "u", "motor force", "wind force"};
  enum : Eigen::Index { xv, vv, torque, om, th, omt, zr, zp, w1, w2, states };
  enum : Eigen::Index { n, t, d, motor, motor_rate, boresight, inputs };
  core.a = Eigen::MatrixXd::Zero(states, states);
  core.b = Eigen::MatrixXd::Zero(states, inputs);
  core.c = Eigen::MatrixXd::Zero(4, states);
  core.d = Eigen::MatrixXd::Zero(4, inputs);
  const double krp = gains.rate_gain, kpp = gains.position_gain, kpi = gains.position_integral;
  // u = krp (-kpp (th + motor bend) + kpi zp - omt) + kri zr + d
  core.c.row(1) << 0.0, 0.0, 0.0, 0.0, -krp * kpp, -krp, gains.rate_integral, krp * kpi, 0.0, 0.0;
  core.d(1, motor) = -krp * kpp;
  core.d(1, d) = 1.0;
  core.c(0, th) = core.d(0, boresight) = -drive.arcseconds / drive.gear_ratio;
  core.c(2, torque) = 1.0;
  core.c(2, om) = core.d(2, motor_rate) = -drive.friction;
  core.c(3, w2) = drive.wind_amplitude;
  core.d(3, t) = 1.0;
  const double wv = drive.valve_frequency;
  core.a(xv, vv) = 1.0;
  core.a.row(vv) = wv * wv * core.c.row(1);
  core.b.row(vv) = wv * wv * core.d.row(1);
  core.a(vv, xv) -= wv * wv;
  core.a(vv, vv) -= 2.0 * drive.valve_damping * wv;
  core.a(torque, xv) = drive.stiffness;
  core.a(torque, om) = core.b(torque, motor_rate) = -drive.stiffness;
  core.a(torque, torque) = -drive.leakage;
  core.a.row(om) = (core.c.row(2) + core.c.row(3)) / drive.inertia;
  core.b.row(om) = (core.d.row(2) + core.d.row(3)) / drive.inertia;
  core.a(th, om) = 1.0;
  core.a(omt, om) = core.b(omt, motor_rate) = drive.tachometer_corner;
  core.a(omt, omt) = -drive.tachometer_corner;
  core.a(zr, th) = core.b(zr, motor) = -kpp;
  core.a(zr, zp) = kpi;
  core.a(zr, omt) = -1.0;
  core.a(zp, th) = core.b(zp, motor) = -1.0;
  core.a(w1, w1) = -drive.slow_wind_corner;
  core.b(w1, n) = drive.slow_wind_corner;
  core.a(w2, w1) = drive.fast_wind_corner;
  core.a(w2, w2) = -drive.fast_wind_corner;
  system.modes.frequency = shape.frequency;
  system.modes.damping_ratio = shape.damping_ratio;
  system.modes.force_shape.resize(modes, 2);
  system.modes.force_shape << shape.motor, shape.wind;
  system.modes.displacement_shape.resize(2, modes);
  system.modes.displacement_shape << shape.motor.transpose(), shape.boresight.transpose();
  system.modes.forces = {"motor force", "wind force"};
  system.modes.displacements = {"motor bend", "beam bend"};
  system.modes.rates = {"motor bend rate", ""};
  system.inputs = {"n", "t", "d"};
  system.outputs = {"y", "u"};
  return system;
}

/// One input to one output of a system, all states kept.
inline plant::StateSpace channel(const plant::StateSpace& system, std::string_view input,
                                 std::string_view output) {
  const auto i = plant::input_index(system, input);
  const auto o = plant::output_index(system, output);
  return {system.a,
          system.b.col(i),
          system.c.row(o),
          system.d.block(o, i, 1, 1),
          {system.inputs[static_cast<std::size_t>(i)]},
          {system.outputs[static_cast<std::size_t>(o)]},
          system.states,
          system.sample_time};
}

/// The loop cut at the valve command, without the wind filter: L from d to u, S = 1/(1 + L).
inline plant::StateSpace peer_open_loop(Eigen::Index modes, const PeerGains& gains = {}) {
  const plant::StateSpace closed = channel(peer_closed_loop(modes, gains), "d", "u");
  const Eigen::Index n = closed.a.rows(), first = 8, kept = 10;  // states w1, w2 go
  const Eigen::MatrixXd opened = closed.a - closed.b * closed.c;
  const auto without = [&](Eigen::Index i) { return i < first ? i : i + kept - first; };
  const Eigen::Index order = n - (kept - first);
  plant::StateSpace open = closed;
  open.a = Eigen::MatrixXd::NullaryExpr(
      order, order, [&](Eigen::Index i, Eigen::Index j) { return opened(without(i), without(j)); });
  open.b = Eigen::MatrixXd::NullaryExpr(
      order, 1, [&](Eigen::Index i, Eigen::Index) { return closed.b(without(i), 0); });
  open.c = Eigen::MatrixXd::NullaryExpr(
      1, order, [&](Eigen::Index, Eigen::Index j) { return -closed.c(0, without(j)); });
  open.d.setZero();
  open.states.erase(open.states.begin() + first, open.states.begin() + kept);
  return open;
}

/// 2 pi logspace(-3, 2, 1000), rad/s: where the peers' frequency responses are taken.
inline Eigen::ArrayXd peer_frequencies() {
  return Eigen::ArrayXd::NullaryExpr(1000, [](Eigen::Index i) {
    return two_pi * std::pow(10.0, -3.0 + 5.0 * static_cast<double>(i) / 999.0);
  });
}

/// Sample time of the discrete Riccati equation, s.
inline constexpr double peer_regulator_period = 0.02;

/// The peers' noise record: splitmix64 from 1, uniform, of variance 1.
inline Eigen::VectorXd peer_noise(Eigen::Index samples) {
  std::uint64_t state = 1;
  return Eigen::VectorXd::NullaryExpr(samples, [&state] {
    state += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    z ^= z >> 31;
    return (static_cast<double>(z >> 11) * 0x1p-53 - 0.5) * std::sqrt(12.0);
  });
}

}  // namespace boresight::reference
