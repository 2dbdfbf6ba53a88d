#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/control/analysis/step_characteristics.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/modal_form.hpp>

// The same antenna written down in other units, another time, at the other side of its gears, with
// a mode cut in two, or in other states is the same antenna: every result stays.
namespace boresight::control {
namespace {

using reference::channel;
using reference::PeerDrive;

/// What is asked of a servo: the loop at a cut, a disturbance to the pointing error, the step of
/// its command.
struct Servo {
  plant::StateSpace loop, disturbance, command;
};

/// A result that scales with the `time_power`-th power of the unit of time and the `gain_power`-th
/// of that of the disturbance's response.
struct Result {
  std::string name;
  double value = 0.0;
  double time_power = 0.0;
  double gain_power = 0.0;
};

std::vector<Result> results_of(const Servo& servo) {
  std::vector<Result> results;
  const Margins margin = margins(servo.loop);
  for (const auto& crossover : margin.gain_crossovers) {
    results.push_back({"gain crossover", crossover.frequency, -1.0});
    results.push_back({"phase margin", crossover.phase_margin_deg});
    results.push_back({"delay margin", crossover.delay_margin, 1.0});
  }
  for (const auto& crossover : margin.phase_crossovers) {
    results.push_back({"phase crossover", crossover.frequency, -1.0});
    results.push_back({"gain margin", crossover.gain_margin});
  }
  results.push_back({"distance to -1", margin.distance_to_minus_one()});
  results.push_back({"disk margin", margin.disk.alpha});
  results.push_back(
      {"peak gain", peak_gain(servo.disturbance, {.relative_tolerance = 1e-12}).lower, 0.0, 1.0});
  results.push_back({"rms", h2_norm(servo.disturbance).value, -0.5, 1.0});
  const StepCharacteristics step = step_characteristics(servo.command);
  results.push_back({"final value", step.final_value});
  results.push_back({"rise time", step.rise_time, 1.0});
  results.push_back({"settling time", step.settling_time, 1.0});
  results.push_back({"overshoot", step.overshoot});
  results.push_back({"peak", step.peak});
  results.push_back({"peak time", step.peak_time, 1.0});
  return results;
}

/// `time`, `gain`: the factors by which times and the disturbance's response come out larger.
void expect_same(const Servo& found, const Servo& expected, double time, double gain) {
  const auto after = results_of(found), before = results_of(expected);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    const double factor =
        std::pow(time, before[i].time_power) * std::pow(gain, before[i].gain_power);
    EXPECT_LT(reference::relative_error(after[i].value, factor * before[i].value), 1e-9)
        << before[i].name << ": " << after[i].value << " and " << factor * before[i].value;
  }
  plant::DenseResponse response(found.disturbance), other(expected.disturbance);
  for (const double w : {0.01, 0.4, 2.0, 6.0, 11.2, 70.0}) {
    EXPECT_LT(reference::relative_error(response.channel(w / time), gain * other.channel(w)), 1e-9)
        << "response at " << w;
  }
}

/// The complementary sensitivity T = L/(1 + L) of a loop without feedthrough.
plant::StateSpace complement(plant::StateSpace loop) {
  loop.a -= loop.b * loop.c;
  return loop;
}

Servo peer_servo() {
  const plant::StateSpace loop = reference::peer_open_loop(5);
  return {loop, channel(reference::peer_closed_loop(5), "t", "y"), complement(loop)};
}

/// The system in states T x.
plant::StateSpace in_states(plant::StateSpace system, const Eigen::MatrixXd& to,
                            const Eigen::MatrixXd& from) {
  system.a = (to * system.a * from).eval();
  system.b = (to * system.b).eval();
  system.c = (system.c * from).eval();
  return system;
}

TEST(Invariance, UnderAChangeOfUnits) {
  reference::RandomNumbers random(601);
  const Servo servo = peer_servo();
  const auto in_units = [&](plant::StateSpace system) {
    const Eigen::VectorXd unit = Eigen::VectorXd::NullaryExpr(
        system.a.rows(), [&] { return random.log_uniform(1e-4, 1e4); });
    return in_states(std::move(system), unit.asDiagonal(), unit.cwiseInverse().asDiagonal());
  };
  for (int trial = 0; trial < 5; ++trial) {
    Servo other{in_units(servo.loop), in_units(servo.disturbance), in_units(servo.command)};
    const double millidegrees = 1.0 / 3.6, newton_metres = random.log_uniform(1e-3, 1e3);
    other.disturbance.c *= millidegrees;
    other.disturbance.b *= newton_metres;
    expect_same(other, servo, 1.0, millidegrees * newton_metres);
  }
}

TEST(Invariance, UnderAChangeOfTheUnitOfTime) {
  const Servo servo = peer_servo();
  for (const double time : {1e-3, 1.0 / 60.0, 7.0, 1e4}) {
    Servo other = servo;
    for (auto* system : {&other.loop, &other.disturbance, &other.command}) {
      system->a /= time;
      system->b /= time;
    }
    expect_same(other, servo, time, 1.0);
  }
}

/// A motor, its gears, an elastic shaft and a load with a rate loop, written down at the motor or
/// at the load. The disturbance is a torque on the load (N m), the pointing error its angle (rad),
/// both at the load.
Servo geared_servo(bool at_motor) {
  const double ratio = 12731.3, motor_inertia = 0.35, load_inertia = 2.3e8, stiffness = 2.9e9,
               damping = 4.1e6, friction = 2.4e7, lag = 0.02, gain = 9.0, integral = 2.0,
               position = 0.6;
  // Everything but the motor is given at the load, the gains at the motor.
  const double square = ratio * ratio;
  const double jm = at_motor ? motor_inertia : motor_inertia * square;
  const double jl = at_motor ? plant::reflected_inertia(load_inertia, ratio) : load_inertia;
  const double k = at_motor ? stiffness / square : stiffness;
  const double c = at_motor ? damping / square : damping;
  const double b = at_motor ? friction / square : friction;
  const double kr = at_motor ? gain : gain * square;
  const double torque_at_load = at_motor ? 1.0 / ratio : 1.0;
  const double angle_at_load = at_motor ? 1.0 / ratio : 1.0;
  // States: motor angle and rate, load angle and rate, drive torque, integral of the rate error.
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(6, 6), input = Eigen::MatrixXd::Zero(6, 2),
                  output = Eigen::MatrixXd::Zero(2, 6);
  a(0, 1) = a(2, 3) = 1.0;
  a.row(1) << -k / jm, -(c + b) / jm, k / jm, c / jm, 1.0 / jm, 0.0;
  a.row(3) << k / jl, c / jl, -k / jl, -c / jl, 0.0, 0.0;
  a(4, 4) = -1.0 / lag;
  // rate error = -position angle - rate; torque command = kr (rate error + integral of it).
  a.row(5) << -position, -1.0, 0.0, 0.0, 0.0, 0.0;
  Eigen::RowVectorXd command = kr * a.row(5);
  command[5] += kr * integral;
  a.row(4) += command / lag;
  input(3, 0) = torque_at_load / jl;
  input(4, 1) = 1.0 / lag;
  output(0, 2) = angle_at_load;
  output.row(1) = command;
  const auto states = std::vector<std::string>{"q", "w", "ql", "wl", "torque", "integral"};
  plant::StateSpace closed{
      a, input, output, Eigen::Matrix2d::Zero(), {"wind", "d"}, {"angle", "u"}, states};
  closed.d(1, 1) = 1.0;
  plant::StateSpace loop = channel(closed, "d", "u");
  loop.a -= loop.b * loop.c;
  loop.c *= -1.0;
  loop.d.setZero();
  return {loop, channel(closed, "wind", "angle"), complement(loop)};
}

TEST(Invariance, OfTheSideOfTheGears) {
  const Servo at_motor = geared_servo(true), at_load = geared_servo(false);
  ASSERT_LT(h2_norm(at_load.disturbance).value, std::numeric_limits<double>::infinity());
  expect_same(at_motor, at_load, 1.0, 1.0);
}

/// A mode in two halves of the same frequency and damping, each with the shapes over sqrt(2).
plant::ModalSystem with_split_mode(plant::ModalSystem system, Eigen::Index mode) {
  plant::VibrationModes& modes = system.modes;
  const Eigen::Index count = modes.frequency.size();
  modes.force_shape.row(mode) *= std::sqrt(0.5);
  modes.displacement_shape.col(mode) *= std::sqrt(0.5);
  modes.frequency.conservativeResize(count + 1);
  modes.damping_ratio.conservativeResize(count + 1);
  modes.force_shape.conservativeResize(count + 1, Eigen::NoChange);
  modes.displacement_shape.conservativeResize(Eigen::NoChange, count + 1);
  modes.frequency[count] = modes.frequency[mode];
  modes.damping_ratio[count] = modes.damping_ratio[mode];
  modes.force_shape.row(count) = modes.force_shape.row(mode);
  modes.displacement_shape.col(count) = modes.displacement_shape.col(mode);
  return system;
}

TEST(Invariance, UnderTheSplittingOfAMode) {
  const plant::ModalSystem whole = reference::peer_modal_system(5);
  const Servo servo = peer_servo();
  for (const Eigen::Index mode : {0, 2, 4}) {
    const plant::ModalSystem split = with_split_mode(whole, mode);
    const plant::StateSpace dense = plant::to_state_space(split);
    // What comes back at u, with the loop opened by taking it off again.
    plant::StateSpace loop = channel(dense, "d", "u");
    loop.a -= loop.b * loop.c;
    loop.c *= -1.0;
    loop.d.setZero();
    const Servo other{loop, channel(dense, "t", "y"), complement(loop)};
    expect_same(other, servo, 1.0, 1.0);
    for (const char* input : {"n", "t"}) {
      const plant::ModalResponse before(whole, input, "y"), after(split, input, "y");
      for (const double w : {0.01, 0.4, 6.0, 11.2, 70.0}) {
        EXPECT_LT(reference::relative_error(after.at(w), before.at(w)), 1e-12) << w;
      }
    }
    EXPECT_LT(
        reference::relative_error(peak_gain(split, "t", "y", {.relative_tolerance = 1e-12}).lower,
                                  peak_gain(whole, "t", "y", {.relative_tolerance = 1e-12}).lower),
        1e-11);
    EXPECT_LT(reference::relative_error(spectral_rms(plant::ModalResponse(split, "n", "y")).rms,
                                        spectral_rms(plant::ModalResponse(whole, "n", "y")).rms),
              1e-9);
  }
}

/// Orthogonal: a product of reflections.
Eigen::MatrixXd random_rotation(reference::RandomNumbers& random, Eigen::Index n) {
  Eigen::MatrixXd rotation = Eigen::MatrixXd::Identity(n, n);
  for (int k = 0; k < 4; ++k) {
    const Eigen::VectorXd v = random.matrix(n, 1);
    rotation -= 2.0 / v.squaredNorm() * (rotation * v) * v.transpose();
  }
  return rotation;
}

// Writing the matrices down in other states rounds them, relative to the old ones by as much as T
// is conditioned: no method can do better than that times the condition of what it solves. Turning
// them alone costs nothing.
TEST(Invariance, UnderAChangeOfStatesToItsCondition) {
  reference::RandomNumbers random(602);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const plant::StateSpace closed = plant::balanced(reference::peer_closed_loop(5));
  const plant::StateSpace noise = channel(closed, "n", "y"), wind = channel(closed, "t", "y");
  const auto lyapunov = solve_lyapunov(noise.a, noise.b * noise.b.transpose());
  // Poles move by the rounding of A times the condition of the modes, the response by that over the
  // distance to the nearest of them.
  const plant::ModalForm modes = plant::modal_form(wind);
  plant::DenseResponse before(wind);
  const auto condition_at = [&](double w) {
    const double distance = (modes.poles.array() - std::complex(0.0, w)).abs().minCoeff();
    return wind.a.norm() * modes.condition / distance;
  };
  const PeakGain peak = peak_gain(wind, {.relative_tolerance = 1e-12});
  const auto allowed = [](double condition, double of_problem) {
    return condition == 1.0 ? 1e-9 : 100.0 * eps * condition * of_problem;
  };
  for (const double condition : {1.0, 1e2, 1e4}) {
    const Eigen::Index n = closed.a.rows();
    const Eigen::MatrixXd left = random_rotation(random, n), right = random_rotation(random, n);
    const Eigen::VectorXd stretch =
        Eigen::VectorXd::LinSpaced(n, 0.0, std::log(condition)).array().exp();
    const Eigen::MatrixXd to = left * stretch.asDiagonal() * right;
    const Eigen::MatrixXd from =
        right.transpose() * stretch.cwiseInverse().asDiagonal() * left.transpose();
    EXPECT_LT(
        reference::relative_error(h2_norm(in_states(noise, to, from)).value, h2_norm(noise).value),
        allowed(condition, lyapunov.condition))
        << condition;
    const auto turned = in_states(wind, to, from);
    EXPECT_LT(reference::relative_error(peak_gain(turned, {.relative_tolerance = 1e-12}).lower,
                                        peak.lower),
              allowed(condition, condition_at(peak.frequency)))
        << condition;
    plant::DenseResponse after(turned);
    for (const double w : {0.05, 2.0, 6.0, 11.2, 70.0}) {
      EXPECT_LT(std::abs(after.channel(w) - before.channel(w)) / peak.lower,
                allowed(condition, condition_at(w)))
          << condition << " at " << w;
    }
  }
}

}  // namespace
}  // namespace boresight::control
