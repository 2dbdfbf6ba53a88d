#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/controllers/path_sections.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;

enum Input : Index { tachometer, angle_error, rate_feedforward, torque };
constexpr int max_halvings = 10;  // of back calculation

enum Measured : Index { measured_rate, measured_angle, measured_torque };

// Q'(0) of a pressure path, s kT/wd of a washed out gain: from its response well below all corners.
double pressure_slope(const Controller& controller) {
  if (!controller.structure.has(LoopPath::pressure)) return 0.0;
  constexpr double low = 1e-6;
  return compensator_response(controller, low).pressure.imag() / low;
}

// Inputs in the order of Input.
plant::StateSpace in_ports(const plant::StateSpace& sampled, bool torque) {
  std::vector<std::string> ports{"tachometer", "encoder", "rate_disturbance"};
  if (torque) ports.emplace_back("motor_torque");
  return plant::subsystem(sampled, ports, {"valve_demand"});
}

// The same of a state space. A commanded rate is subtracted from the tachometer's.
plant::StateSpace about_motion(const plant::StateSpace& controller) {
  const auto reads = [&](const char* name) {
    return std::ranges::count(controller.inputs, name) > 0;
  };
  const double radius = numerics::spectral_radius(controller.a);
  if (!(radius < 1.0)) {
    throw InvalidInput(fmt::format(
        "antenna controller: expected a state space that is stable by itself, found a pole of "
        "magnitude {:.9g}",
        radius));
  }
  plant::StateSpace system = controller;
  const Eigen::Index states = system.a.rows();
  const Eigen::Index count = reads("motor_torque") ? 4 : 3;
  system.b = Eigen::MatrixXd::Zero(states, count);
  system.d = Eigen::MatrixXd::Zero(1, count);
  const auto take = [&](Input into, const char* name, double sign) {
    const auto found = std::ranges::find(controller.inputs, name);
    if (found == controller.inputs.end()) return;
    const auto column = static_cast<Eigen::Index>(found - controller.inputs.begin());
    system.b.col(into) = sign * controller.b.col(column);
    system.d(0, into) = sign * controller.d(0, column);
  };
  take(tachometer, "tachometer", 1.0);
  take(angle_error, "encoder", 1.0);
  take(rate_feedforward, "tachometer", -1.0);
  if (reads("motor_torque")) take(torque, "motor_torque", 1.0);
  return system;
}

}  // namespace

Feedforward plant_feedforward(const plant::AntennaPlant& antenna, const Controller& controller,
                              double delay) {
  validate(controller);
  if (!(delay >= 0.0) || !std::isfinite(delay)) {
    throw InvalidInput(
        fmt::format("plant_feedforward: expected a delay of 0 or more, found {} s", delay));
  }
  const auto& drive = antenna.drive;
  const double inertia = plant::reflected_inertia(antenna);
  const double opening = 1.0 + drive.leakage_rate * drive.viscous_friction / drive.oil_stiffness;
  Feedforward result;
  result.rate_to_rate_command = 1.0;
  result.acceleration_to_rate_command = -1.0 / drive.tachometer_corner;
  result.rate_to_valve_command = opening;
  result.acceleration_to_valve_command =
      (drive.leakage_rate * inertia + drive.viscous_friction) / drive.oil_stiffness +
      opening * (2.0 * drive.valve_damping / drive.valve_corner + delay);
  result.acceleration_to_valve_command += pressure_slope(controller) * drive.viscous_friction;
  result.rate_to_motor_torque = drive.viscous_friction;
  result.acceleration_to_motor_torque = inertia;
  return result;
}

Feedforward with_friction(const Feedforward& feedforward, const plant::AntennaPlant& antenna,
                          const plant::FrictionCurve& curve, double fraction) {
  if (!(fraction >= 0.0) || !std::isfinite(fraction)) {
    throw InvalidInput(fmt::format(
        "with_friction: expected a fraction of the friction torque of 0 or more, found {}",
        fraction));
  }
  const auto& drive = antenna.drive;
  Feedforward result = feedforward;
  result.friction = curve;
  result.friction.coulomb_torque *= fraction;
  result.friction.breakaway_torque *= fraction;
  result.friction.saturating_torque *= fraction;
  result.friction.viscous_friction *= fraction;
  result.friction_to_valve_command = drive.leakage_rate / drive.oil_stiffness;
  result.friction_change_to_valve_command = 1.0 / drive.oil_stiffness;
  return result;
}

AntennaController::AntennaController(const Controller& controller, double sample_time,
                                     const AntennaControllerOptions& options)
    : sample_time_(sample_time),
      options_(options),
      reads_torque_(controller.structure.feeds_torque_back()),
      expects_torque_(controller.structure.state_space() != nullptr),
      outputs_{"valve_command"} {
  const auto& forward = options.feedforward;
  if (!(options.command_limit > 0.0) ||
      !std::isfinite(forward.rate_to_rate_command + forward.acceleration_to_rate_command +
                     forward.rate_to_valve_command + forward.acceleration_to_valve_command +
                     forward.rate_to_motor_torque + forward.acceleration_to_motor_torque +
                     forward.friction_to_valve_command +
                     forward.friction_change_to_valve_command) ||
      !(forward.supply_torque > 0.0)) {
    throw InvalidInput(
        fmt::format("antenna controller: expected a command limit and a supply torque above 0 and "
                    "finite feedforward, found a limit of {} rad/s and {} N m",
                    options.command_limit, forward.supply_torque));
  }
  inputs_ = {"tachometer", "encoder"};
  if (reads_torque_) inputs_.emplace_back("motor_torque");
  for (const char* reference : {"reference", "reference_rate", "reference_acceleration"}) {
    inputs_.emplace_back(reference);
  }
  const plant::StateSpace sampled = sampled_controller(controller, sample_time);
  const plant::StateSpace seen = expects_torque_ ? about_motion(*controller.structure.state_space())
                                                 : in_ports(sampled, reads_torque_);
  set(seen);
  if (!expects_torque_ && options.anti_windup) prevent_windup(controller);
  if (controller.structure.has_conditional_integral()) set_conditional(controller);
}

void AntennaController::set(const plant::StateSpace& seen) {
  a_ = seen.a;
  b_ = seen.b;
  c_ = seen.c;
  d_ = seen.d;
  initial_ = state_ = next_ = back_calculation_ = Eigen::VectorXd::Zero(a_.rows());
}

void AntennaController::set_conditional(const Controller& controller) {
  const Controller rest = without_conditional_integral(controller);
  set(in_ports(sampled_controller(rest, sample_time_), reads_torque_));
  integral_.emplace(*conditional_integral(controller), sample_time_);
  const double gain = path_gain(rest, LoopPath::rate) * path_gain(rest, LoopPath::position);
  // Stable at the limit while the integral holds too.
  const auto radius = [&] {
    return numerics::spectral_radius(a_ + integral_back_calculation_ * b_.col(angle_error) * c_);
  };
  integral_back_calculation_ = back_calculation_fraction_ / gain;
  for (int i = 0; i < max_halvings && back_calculation_fraction_ > 0.0 && radius() >= 1.0; ++i) {
    back_calculation_fraction_ *= 0.5;
    integral_back_calculation_ = back_calculation_fraction_ / gain;
  }
  if (!rest.structure.has(LoopPath::compliance)) return;
  compliance_ = plant::sample(compliance_compensator(prewarped(rest, sample_time_)), sample_time_,
                              plant::SamplingMethod::tustin);
  flexure_state_ = initial_flexure_state_ = Eigen::VectorXd::Zero(compliance_->a.rows());
}

void AntennaController::prevent_windup(const Controller& controller) {
  const auto radius = [&](const Eigen::VectorXd& back) {
    return numerics::spectral_radius(a_ - back * c_);
  };
  // A pole within rounding of 1: a double one is known to the root of the working precision.
  constexpr double integrates = 1.0 - 1e-7;
  if (radius(back_calculation_) < integrates) return;
  const Eigen::VectorXd whole = -b_.col(angle_error) / (path_gain(controller, LoopPath::rate) *
                                                        path_gain(controller, LoopPath::position));
  double fraction = 1.0;
  for (int i = 0; i < max_halvings; ++i, fraction *= 0.5) {
    if (radius(fraction * whole) < 1.0) {
      back_calculation_ = fraction * whole;
      back_calculation_fraction_ = fraction;
      return;
    }
  }
}

// Of the motion, friction torque not included.
double AntennaController::expected_torque(double rate, double acceleration) const {
  if (!expects_torque_) return 0.0;
  const auto& forward = options_.feedforward;
  return forward.rate_to_motor_torque * rate + forward.acceleration_to_motor_torque * acceleration;
}

double AntennaController::valve_feedforward(double rate, double acceleration, double friction,
                                            double friction_rate) const {
  const auto& forward = options_.feedforward;
  const double flow = forward.rate_to_valve_command * rate +
                      forward.acceleration_to_valve_command * acceleration +
                      forward.friction_to_valve_command * friction +
                      forward.friction_change_to_valve_command * friction_rate;
  const double torque = forward.rate_to_motor_torque * rate +
                        forward.acceleration_to_motor_torque * acceleration + friction;
  const double load = std::copysign(torque, torque * flow) / forward.supply_torque;
  return flow / std::sqrt(1.0 - std::min(load, max_feedforward_load));
}

double AntennaController::friction_torque(double rate) const {
  return std::abs(rate) < friction_rest_rate
             ? 0.0
             : plant::friction_torque(options_.feedforward.friction, rate);
}

void AntennaController::restart() {
  state_ = initial_;
  flexure_state_ = initial_flexure_state_;
  if (integral_) integral_->start_from(initial_integral_);
  friction_ = built_friction_ = initial_friction_;
}

void AntennaController::update(double /*time*/, const Eigen::Ref<const Eigen::VectorXd>& measured,
                               Eigen::Ref<Eigen::VectorXd> commands) {
  const Index first = reads_torque_ ? 3 : 2;
  const double rate = measured[first + 1];
  const double acceleration = measured[first + 2];
  const auto& forward = options_.feedforward;
  const double error = measured[measured_angle] - measured[first];
  const double added =
      forward.rate_to_rate_command * rate + forward.acceleration_to_rate_command * acceleration;
  const double friction = friction_torque(rate + acceleration * sample_time_);
  const double excess = reads_torque_ ? measured[measured_torque] -
                                            expected_torque(rate, acceleration) - built_friction_
                                      : 0.0;
  const double flexure =
      compliance_ ? compliance_->c.row(0).dot(flexure_state_) + compliance_->d(0, 0) * excess : 0.0;
  const auto with_integral = [&](double angle) {
    return integral_ ? flexure + integral_->with_integral(angle - flexure) : angle;
  };
  const double angle = with_integral(error);
  double wanted =
      valve_feedforward(rate, acceleration, friction, (friction - friction_) / sample_time_) +
      d_[tachometer] * measured[measured_rate] + d_[angle_error] * angle +
      d_[rate_feedforward] * added;
  wanted += c_.dot(state_);
  next_.noalias() = a_ * state_;
  next_ += b_.col(tachometer) * measured[measured_rate] + b_.col(angle_error) * angle +
           b_.col(rate_feedforward) * added;
  if (reads_torque_) {
    wanted += d_[torque] * excess;
    next_ += b_.col(torque) * excess;
  }
  commands[0] = std::clamp(wanted, -options_.command_limit, options_.command_limit);
  const double cut = wanted - commands[0];
  next_ -= back_calculation_ * cut;
  if (integral_) {
    // As from the angle that the limited command could have followed.
    const double followed = error + integral_back_calculation_ * cut;
    next_ += b_.col(angle_error) * (with_integral(followed) - angle);
    integral_->advance(followed - flexure);
    if (compliance_) {
      flexure_state_ = (compliance_->a * flexure_state_ + compliance_->b.col(0) * excess).eval();
    }
  }
  state_.swap(next_);
  built_friction_ = friction_;
  friction_ = friction;
}

double AntennaController::start_from(const SteadyMotion& motion) {
  const Index states = a_.rows();
  const auto& forward = options_.feedforward;
  // x = A x + B m and u = C x + D m + feedforward, for x and the angle's error.
  Eigen::VectorXd given = Eigen::VectorXd::Zero(b_.cols());
  given[tachometer] = motion.tachometer;
  given[rate_feedforward] = forward.rate_to_rate_command * motion.tachometer;
  initial_friction_ = friction_torque(motion.tachometer);
  if (reads_torque_) {
    given[torque] =
        motion.motor_torque - expected_torque(motion.tachometer, 0.0) - initial_friction_;
  }
  Eigen::MatrixXd equations(states + 1, states + 1);
  equations.topLeftCorner(states, states) = Eigen::MatrixXd::Identity(states, states) - a_;
  equations.topRightCorner(states, 1) = -b_.col(angle_error);
  equations.bottomLeftCorner(1, states) = c_;
  equations(states, states) = d_[angle_error];
  Eigen::VectorXd right(states + 1);
  right.head(states) = b_ * given;
  right[states] = motion.valve_command - d_.dot(given) -
                  valve_feedforward(motion.tachometer, 0.0, initial_friction_, 0.0);
  const Eigen::VectorXd steady =
      numerics::linear_solve(equations, right, "antenna controller: steady motion");
  initial_ = steady.head(states);
  double lead = steady[states];
  if (integral_) {
    // The integral gives what the rest takes of the angle; it holds at no corrected angle.
    const double held = lead;
    lead = 0.0;
    if (compliance_) {
      const Index order = compliance_->a.rows();
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(order, order) - compliance_->a;
      initial_flexure_state_ = numerics::linear_solve(left, compliance_->b * given[torque],
                                                      "antenna controller: steady flexure");
      lead =
          compliance_->c.row(0).dot(initial_flexure_state_) + compliance_->d(0, 0) * given[torque];
    }
    initial_integral_ = held - lead;
  }
  restart();
  return lead;
}

}  // namespace boresight::control
