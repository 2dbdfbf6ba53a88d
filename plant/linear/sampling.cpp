#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::plant {
namespace {

// The most states that dead times may add: more is a wrong unit, not a plant.
constexpr double max_held_states = 10000.0;

Eigen::Index held_states(const DeadTimeInSamples& late) {
  return late.samples + (late.rest > 0.0 ? 1 : 0);
}

void check(const StateSpace& system, double sample_time, SamplingMethod method,
           const SamplingOptions& options) {
  validate(system);
  if (!(sample_time > 0.0) || !std::isfinite(sample_time)) {
    throw InvalidInput(
        fmt::format("sample: expected a sample time above 0, found {} s", sample_time));
  }
  if (system.sample_time != 0.0) {
    throw InvalidInput(
        fmt::format("sample: expected a continuous system, found one with a sample time of {} s",
                    system.sample_time));
  }
  if (options.prewarp_frequency != 0.0) {
    const double nyquist = std::numbers::pi / sample_time;
    if (method != SamplingMethod::tustin) {
      throw InvalidInput("sample: prewarp_frequency applies to Tustin's method only");
    }
    if (!(options.prewarp_frequency > 0.0) || !(options.prewarp_frequency < nyquist)) {
      throw InvalidInput(
          fmt::format("sample: expected a prewarp_frequency between 0 and pi/T = {:.6g} rad/s, "
                      "found {} rad/s",
                      nyquist, options.prewarp_frequency));
    }
  }
  if (options.dead_times.empty()) return;
  if (method != SamplingMethod::zero_order_hold) {
    throw InvalidInput("sample: dead_times go with the zero-order hold only");
  }
  if (options.dead_times.size() != system.inputs.size()) {
    throw InvalidInput(
        fmt::format("sample: expected dead_times for each of the {} inputs or none, found {}",
                    system.inputs.size(), options.dead_times.size()));
  }
  double held = 0.0;
  for (std::size_t j = 0; j < options.dead_times.size(); ++j) {
    const double dead_time = options.dead_times[j];
    held += dead_time / sample_time;
    if (!(dead_time >= 0.0) || !(held <= max_held_states)) {
      throw InvalidInput(
          fmt::format("sample: expected a dead time of 0 or more, {} samples at most in all, found "
                      "{} s at the input '{}' (T = {} s)",
                      max_held_states, dead_time, system.inputs[j], sample_time));
    }
  }
}

StateSpace zero_order_hold(const StateSpace& system, double sample_time,
                           const std::vector<double>& dead_times) {
  StateSpace result = system;
  const numerics::HeldTransition whole = numerics::held_transition(system.a, system.b, sample_time);
  result.a = whole.state;
  result.b = whole.step;
  result.sample_time = sample_time;
  if (dead_times.empty()) return result;

  std::vector<DeadTimeInSamples> late;
  Eigen::Index states = system.a.rows();
  for (const double dead_time : dead_times) {
    late.push_back(dead_time_in_samples(dead_time, sample_time));
    states += held_states(late.back());
  }
  const Eigen::Index n = system.a.rows(), m = system.b.cols(), p = system.c.rows();
  result.a = Eigen::MatrixXd::Zero(states, states);
  result.a.topLeftCorner(n, n) = whole.state;
  result.b = Eigen::MatrixXd::Zero(states, m);
  result.c = Eigen::MatrixXd::Zero(p, states);
  result.c.leftCols(n) = system.c;
  result.d = Eigen::MatrixXd::Zero(p, m);
  Eigen::Index first = n;
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto& [samples, rest] = late[static_cast<std::size_t>(j)];
    const Eigen::Index held = held_states(late[static_cast<std::size_t>(j)]);
    // Where the input of i samples ago is read: a column of [A B].
    const auto column_of = [&](auto& from_states, auto& from_inputs, Eigen::Index i) {
      return i == 0 ? from_inputs.col(j) : from_states.col(first + i - 1);
    };
    if (rest == 0.0) {
      column_of(result.a, result.b, samples).head(n) = whole.step.col(j);
      column_of(result.c, result.d, samples) += system.d.col(j);
    } else {
      // The older input acts until `rest`, the newer one from there to the next sample; at the
      // sample itself the older one is there.
      const numerics::HeldTransition before =
          numerics::held_transition(system.a, system.b.col(j), rest);
      const numerics::HeldTransition after =
          numerics::held_transition(system.a, system.b.col(j), sample_time - rest);
      column_of(result.a, result.b, samples).head(n) = after.step;
      column_of(result.a, result.b, samples + 1).head(n) = after.state * before.step;
      column_of(result.c, result.d, samples + 1) += system.d.col(j);
    }
    for (Eigen::Index i = 0; i < held; ++i) {
      column_of(result.a, result.b, i)[first + i] = 1.0;
      result.states.push_back(
          fmt::format("{}_held_{}", system.inputs[static_cast<std::size_t>(j)], i + 1));
    }
    first += held;
  }
  validate(result);  // a state may have had such a name already
  return result;
}

StateSpace first_order_hold(const StateSpace& system, double sample_time) {
  const numerics::HeldTransition held = numerics::held_transition(system.a, system.b, sample_time);
  StateSpace result = system;
  result.a = held.state;
  result.b = held.step - held.ramp + held.state * held.ramp;
  result.d = system.d + system.c * held.ramp;
  result.sample_time = sample_time;
  return result;
}

StateSpace tustin(const StateSpace& system, double sample_time, double prewarp_frequency) {
  // s = (2/time) (z - 1)/(z + 1)
  const double time =
      prewarp_frequency > 0.0
          ? 2.0 * std::tan(0.5 * prewarp_frequency * sample_time) / prewarp_frequency
          : sample_time;
  StateSpace result = system;
  result.sample_time = sample_time;
  const Eigen::Index n = system.a.rows();
  if (n == 0) return result;
  const Eigen::VectorXd scale = numerics::balancing_scale(system.a);
  const Eigen::MatrixXd half =
      0.5 * time * (scale.cwiseInverse().asDiagonal() * system.a * scale.asDiagonal());
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd inverse;
  try {
    inverse = numerics::linear_solve(identity - half, identity, "sample");
  } catch (const NumericalFailure&) {
    throw NumericalFailure(
        fmt::format("sample: the system has a pole at {:.6g} 1/s, which Tustin's method maps to "
                    "infinity; take another sample time or a hold",
                    2.0 / time));
  }
  inverse = (scale.asDiagonal() * inverse * scale.cwiseInverse().asDiagonal()).eval();
  const Eigen::MatrixXd to_output = system.c * inverse;
  result.a = 2.0 * inverse - identity;
  result.b = time * (inverse * system.b);
  result.c = to_output;
  result.d = system.d + 0.5 * time * (to_output * system.b);
  return result;
}

}  // namespace

DeadTimeInSamples dead_time_in_samples(double dead_time, double sample_time) {
  const double samples = dead_time / sample_time;
  const double nearest = std::round(samples);
  if (std::abs(samples - nearest) <= 1e-9) return {static_cast<Eigen::Index>(nearest), 0.0};
  const double whole = std::floor(samples);
  return {static_cast<Eigen::Index>(whole), (samples - whole) * sample_time};
}

StateSpace sample(const StateSpace& system, double sample_time, SamplingMethod method,
                  const SamplingOptions& options) {
  check(system, sample_time, method, options);
  switch (method) {
    case SamplingMethod::zero_order_hold:
      return zero_order_hold(system, sample_time, options.dead_times);
    case SamplingMethod::first_order_hold:
      return first_order_hold(system, sample_time);
    case SamplingMethod::tustin:
      break;
  }
  return tustin(system, sample_time, options.prewarp_frequency);
}

}  // namespace boresight::plant
