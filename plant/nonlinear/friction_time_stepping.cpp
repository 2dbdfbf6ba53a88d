#include <algorithm>
#include <cmath>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/nonlinear/friction_time_stepping.hpp>

namespace boresight::plant {
namespace {

// Stiffness of bristles where there are none, over that which stops the motor within a step.
constexpr double rigid = 1e3;
// Dry friction over its torque at rest or at low rates.
constexpr double smallest = 1e-6;

}  // namespace

FrictionTimeStepping::FrictionTimeStepping(const FrictionAntenna& antenna, double step)
    : friction_(antenna.friction),
      smallest_friction_(
          smallest * std::max(friction_.curve.breakaway_torque, friction_.curve.coulomb_torque)),
      step_(step),
      offset_torque_(antenna.offset_torque),
      supply_torque_(antenna.supply_torque),
      oil_stiffness_(antenna.linear.drive.oil_stiffness) {
  validate(friction_);
  if (!(smallest_friction_ > 0.0)) {
    throw InvalidInput("friction time stepping: expected dry friction, found none");
  }
  StateSpace system = to_state_space(antenna.linear);
  const Eigen::Index states = system.a.rows(), outputs = system.c.rows();
  boresight_ = system.c.row(output_index(system, "beam"));
  // Besides the valve command: torque on the motor, flow (rad/s) in addition to that of the valve.
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(states, 3);
  inputs.col(0) = system.b.col(input_index(system, "valve_command"));
  inputs(rate_state, 1) = 1.0 / antenna.linear.drive.motor_inertia;
  inputs(torque_state, 2) = oil_stiffness_;
  system.b = inputs;
  system.d = Eigen::MatrixXd::Zero(outputs, 3);
  system.inputs = {"valve_command", "torque_on_motor", "flow"};
  const StateSpace sampled = sample(system, step);
  transition_ = sampled.a;
  by_command_ = sampled.b.col(0);
  by_motor_torque_ = sampled.b.col(1);
  by_flow_ = sampled.b.col(2);
  rate_per_torque_ = by_motor_torque_[rate_state];
  if (friction_.bristle_stiffness == 0.0) {
    friction_.bristle_stiffness = rigid / (step_ * rate_per_torque_);
    friction_.bristle_damping = 0.0;
  }
  state_ = next_ = Eigen::VectorXd::Zero(states);
  state_[torque_state] = offset_torque_;
  const double flow = antenna.linear.drive.leakage_rate / oil_stiffness_ * offset_torque_;
  holding_command_ = flow / open_fraction(flow, offset_torque_);
  state_[valve_state] = holding_command_;
}

void FrictionTimeStepping::advance(double valve_command) {
  const double opening = state_[valve_state];
  const double loss = opening * (open_fraction(opening, state_[torque_state]) - 1.0);
  next_.noalias() = transition_ * state_;
  next_ += valve_command * by_command_ + loss * by_flow_ - offset_torque_ * by_motor_torque_;
  const double free_rate = next_[rate_state];
  const double rate = rate_with_friction(free_rate);
  next_ += (rate - free_rate) / rate_per_torque_ * by_motor_torque_;
  next_[rate_state] = rate;
  state_.swap(next_);
}

// Flow of an opening over that without load.
double FrictionTimeStepping::open_fraction(double opening, double torque) const {
  const double load = std::copysign(torque / supply_torque_, opening * torque);
  return std::sqrt(std::max(0.0, 1.0 - load));
}

// w with w + rate_per_torque F(w) = free_rate, by Newton's method kept within a bracket.
double FrictionTimeStepping::rate_with_friction(double free_rate) {
  const double stiffness = friction_.bristle_stiffness, damping = friction_.bristle_damping;
  const double at_rest = rate_per_torque_ * stiffness * bristle_;
  const double sign = free_rate < at_rest ? -1.0 : 1.0;
  // Counted in the direction of motion.
  const double free = sign * free_rate, bent = sign * bristle_;
  double bristle = bent;
  const auto excess_at = [&](double w) {
    numerics::ValueAndDerivative dry = dry_friction(friction_.curve, w);
    dry.value = std::max(dry.value, smallest_friction_);
    const double fraction = step_ * stiffness / dry.value;
    const double less = 1.0 + fraction * w;
    bristle = (bent + step_ * w) / less;
    const double by_rate =
        (step_ - bristle * fraction * (1.0 - w * dry.derivative / dry.value)) / less;
    const double viscous = friction_.curve.viscous_friction;
    const double torque = stiffness * bristle + damping / step_ * (bristle - bent) + viscous * w;
    return numerics::ValueAndDerivative{
        w + rate_per_torque_ * torque - free,
        1.0 + rate_per_torque_ * ((stiffness + damping / step_) * by_rate + viscous)};
  };
  double low = 0.0;
  double high = std::max(
      0.0, free + rate_per_torque_ * std::max(stiffness, damping / step_) * std::abs(bent));
  double w = std::clamp(sign * state_[rate_state], low, high);
  constexpr int max_iterations = 40;
  constexpr double accuracy = 1e-7;
  for (int i = 0; i < max_iterations; ++i) {
    const numerics::ValueAndDerivative excess = excess_at(w);
    if (std::abs(excess.value) <= accuracy * high) break;
    (excess.value > 0.0 ? high : low) = w;
    w -= excess.value / excess.derivative;
    if (w < low || w > high) w = 0.5 * (low + high);
  }
  bristle_ = sign * bristle;
  return sign * w;
}

}  // namespace boresight::plant
