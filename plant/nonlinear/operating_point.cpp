#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/nonlinear/antenna_channels.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using States = AntennaStates;

struct Channels {
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;
};

Channels channels_at(const FeedbackSystem& system, const FeedbackMatrices& matrices,
                     const Eigen::VectorXd& state, const Eigen::VectorXd& input) {
  Channels channels{Eigen::VectorXd::Zero(system.channel_outputs),
                    Eigen::MatrixXd::Zero(system.channel_outputs, system.channel_inputs)};
  if (system.channel_outputs == 0) return channels;
  const Eigen::VectorXd z = matrices.channel_output * state + matrices.input_to_channels * input;
  system.channels->evaluate(z, channels.value, channels.slope);
  for (Index i = 0; i < system.channel_outputs; ++i) {
    if (!std::isfinite(channels.value[i]) || !channels.slope.row(i).allFinite()) {
      throw NumericalFailure(
          fmt::format("operating point: channel {} is not finite at this state", i + 1));
    }
  }
  return channels;
}

void require_size(const char* what, Index expected, const Eigen::VectorXd& found) {
  if (found.size() != expected || !found.allFinite()) {
    throw InvalidInput(fmt::format("operating point: expected {} finite {}, found {}{}", expected,
                                   what, found.size(),
                                   found.allFinite() ? "" : " of which some are not finite"));
  }
}

// Steady motion as the zero of a function of the states and the valve command.
class SteadyMotion {
 public:
  SteadyMotion(const NonlinearAntenna& antenna, const Trim& motion)
      : system_(to_feedback_system(antenna)),
        matrices_(feedback_matrices(system_)),
        rotation_(motion.motor_rate * rigid_rotation(antenna)),
        motor_angle_(motion.motor_angle),
        // At rest the bristles' equation holds for any bend.
        bristle_free_(motion.motor_rate == 0.0) {
    const Index wind = matrices_.input.cols() - 1;
    point_.input = Eigen::VectorXd::Zero(wind + 1);
    if (motion.wind.size() != 0) {
      require_size("wind torques", wind, motion.wind);
      point_.input.tail(wind) = motion.wind;
    }
    point_.state = state_at_rest(antenna) + motor_angle_ * rigid_rotation(antenna);
    point_.state[States::motor_rate] = point_.state[States::tachometer] = motion.motor_rate;
    for (Index i = 0; i < rotation_.size(); ++i) {
      // A rate follows its angle.
      if (rotation_[i] != 0.0) point_.state[i + 1] = rotation_[i];
    }
    if (antenna.friction.bristle_stiffness > 0.0 && !bristle_free_) {
      point_.state[States::bristle] =
          std::copysign(dry_friction(antenna.friction.curve, motion.motor_rate).value,
                        motion.motor_rate) /
          antenna.friction.bristle_stiffness;
    }
    // Newton's method has no slope to follow from within the valve's overlap: start beyond it, on
    // the side that motion or, at rest, the load asks for.
    const auto& oil = antenna.oil;
    const double load =
        offset_torque(antenna.offset, motor_angle_).value +
        (motion.motor_rate == 0.0 ? 0.0
                                  : friction_torque(antenna.friction.curve, motion.motor_rate)) -
        point_.input.tail(wind).sum();
    const double leak =
        (oil.cross_leakage + 0.5 * (2.0 * oil.null_leakage + oil.case_leakage)) * load;
    const double flow = motion.motor_rate + leak;
    double spool = flow - antenna.valve.null_offset;
    if (flow != 0.0) spool += std::copysign(antenna.valve.overlap, flow);
    point_.state[States::spool] = point_.input[0] = spool;
  }

  OperatingPoint solve() {
    constexpr int max_iterations = 200;
    Eigen::VectorXd residual = balance();
    double size = relative_size(residual);
    while (size > 1e-13 && point_.iterations < max_iterations) {
      const Eigen::VectorXd step =
          numerics::linear_solve(jacobian(), -residual, "the balance of the steady motion");
      const OperatingPoint before = point_;
      // Kinks of the orifice and stops may make a full step worse.
      double fraction = 1.0;
      double next = size;
      for (; fraction > 1e-4; fraction *= 0.5) {
        point_.state = before.state + fraction * step.head(rotation_.size());
        point_.input[0] = before.input[0] + fraction * step[rotation_.size()];
        residual = balance();
        next = relative_size(residual);
        if (next < size) break;
      }
      ++point_.iterations;
      if (!(next < size)) {
        point_ = before;
        break;
      }
      size = next;
    }
    point_.residual = size;
    if (!(size < 1e-9)) {
      throw NumericalFailure(fmt::format(
          "trim: no steady motion at {:.6g} rad/s of motor: relative residual {:.2g} after {} "
          "iterations; the supply cannot give this speed under this load",
          rotation_[States::motor_angle], size, point_.iterations));
    }
    return point_;
  }

 private:
  // Rate of change beyond the rotation, then the motor angle beyond the one asked for.
  Eigen::VectorXd balance() {
    const auto channels = channels_at(system_, matrices_, point_.state, point_.input);
    const Index n = rotation_.size();
    Eigen::VectorXd residual(n + 1);
    residual.head(n) = matrices_.a * point_.state + matrices_.input * point_.input +
                       matrices_.channel_input * channels.value - rotation_;
    scale_ = matrices_.a.cwiseAbs() * point_.state.cwiseAbs() +
             matrices_.input.cwiseAbs() * point_.input.cwiseAbs() +
             matrices_.channel_input.cwiseAbs() * channels.value.cwiseAbs() + rotation_.cwiseAbs();
    // Two rates that cancel within the channel: rounding is relative to them.
    scale_[States::bristle] += std::abs(point_.state[States::motor_rate]);
    residual[n] = point_.state[States::motor_angle] - motor_angle_;
    if (bristle_free_) residual[States::bristle] = point_.state[States::bristle];
    return residual;
  }

  double relative_size(const Eigen::VectorXd& residual) const {
    if (!residual.allFinite()) return std::numeric_limits<double>::infinity();
    const Index n = rotation_.size();
    double size = std::abs(residual[n]) / std::max(1.0, std::abs(motor_angle_));
    for (Index i = 0; i < n; ++i) {
      const double scale = std::max(scale_[i], 1e-6);
      size = std::max(size, std::abs(residual[i]) / scale);
    }
    return size;
  }

  Eigen::MatrixXd jacobian() const {
    const auto channels = channels_at(system_, matrices_, point_.state, point_.input);
    const Index n = rotation_.size();
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(n + 1, n + 1);
    j.topLeftCorner(n, n) =
        matrices_.a + matrices_.channel_input * channels.slope * matrices_.channel_output;
    j.col(n).head(n) = matrices_.input.col(0);
    j(n, States::motor_angle) = 1.0;
    if (bristle_free_) {
      j.row(States::bristle).setZero();
      j(States::bristle, States::bristle) = 1.0;
    }
    return j;
  }

  FeedbackSystem system_;
  FeedbackMatrices matrices_;
  Eigen::VectorXd rotation_;
  Eigen::VectorXd scale_;
  double motor_angle_;
  bool bristle_free_;
  OperatingPoint point_;
};

}  // namespace

StateSpace linearise(const FeedbackSystem& system, const Eigen::VectorXd& state,
                     const Eigen::VectorXd& input) {
  const auto matrices = feedback_matrices(system);
  require_size("states", matrices.a.rows(), state);
  require_size("inputs", matrices.input.cols(), input);
  const auto channels = channels_at(system, matrices, state, input);
  const Eigen::MatrixXd by_state = channels.slope * matrices.channel_output;
  const Eigen::MatrixXd by_input = channels.slope * matrices.input_to_channels;
  const auto& linear = system.linear;
  return {matrices.a + matrices.channel_input * by_state,
          matrices.input + matrices.channel_input * by_input,
          matrices.output + matrices.channels_to_output * by_state,
          matrices.input_to_output + matrices.channels_to_output * by_input,
          {linear.inputs.begin(), linear.inputs.end() - system.channel_outputs},
          {linear.outputs.begin() + system.channel_inputs, linear.outputs.end()},
          linear.states};
}

Eigen::VectorXd observed(const FeedbackSystem& system, const Eigen::VectorXd& state,
                         const Eigen::VectorXd& input) {
  const auto matrices = feedback_matrices(system);
  require_size("states", matrices.a.rows(), state);
  require_size("inputs", matrices.input.cols(), input);
  const auto channels = channels_at(system, matrices, state, input);
  return matrices.output * state + matrices.input_to_output * input +
         matrices.channels_to_output * channels.value;
}

OperatingPoint trim(const NonlinearAntenna& antenna, const Trim& motion) {
  if (!std::isfinite(motion.motor_rate) || !std::isfinite(motion.motor_angle)) {
    throw InvalidInput(fmt::format("trim: expected a finite motor rate and angle, found {} and {}",
                                   motion.motor_rate, motion.motor_angle));
  }
  validate(antenna.oil);
  // Air only makes the oil softer, a factor on a flow that is nought in steady motion. Without it
  // the balance is smooth down to where a side runs empty, and Newton's method finds its way.
  NonlinearAntenna airless = antenna;
  airless.oil.air_fraction = 0.0;
  return SteadyMotion(airless, motion).solve();
}

Eigen::VectorXd state_held_by_friction(const NonlinearAntenna& antenna) {
  const double offset = offset_torque(antenna.offset, 0.0).value;
  if (std::abs(offset) >= antenna.friction.curve.breakaway_torque) {
    return trim(antenna, {}).state;
  }
  Eigen::VectorXd state = state_at_rest(antenna);
  state[AntennaStates::bristle] = -offset / antenna.friction.bristle_stiffness;
  return state;
}

}  // namespace boresight::plant
