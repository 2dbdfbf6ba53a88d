#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/integration/feedback_ode.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

constexpr Index progress_every = 1024;
// Of CVODES within an interval: beyond that the system is too stiff for its fixed-point iteration.
constexpr long max_steps = 2000;
// Other streams of the seed are the wind's.
constexpr std::uint64_t first_sensor_stream = 100;

Index position(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : found - names.begin();
}

Index multiple(double time, double interval, const char* what) {
  const double count = time / interval;
  if (!(count >= 0.0) || !std::isfinite(count) ||
      std::abs(count - std::round(count)) > 1e-9 * std::max(1.0, count)) {
    throw InvalidInput(
        fmt::format("simulate: expected a {} that is a multiple of the interval {} s, found {} s",
                    what, interval, time));
  }
  return static_cast<Index>(std::round(count));
}

// The controller between samples: what it read, what it asked for, what has arrived.
class ControllerClock {
 public:
  ControllerClock(const SimulationPlan& plan, const std::vector<std::string>& inputs,
                  const std::vector<std::string>& observed)
      : plan_(plan),
        controller_(*plan.controller),
        period_(multiple(controller_.sample_time(), plan.interval, "controller sample time")),
        delay_(multiple(plan.computation_delay, plan.interval, "computation delay")) {
    if (period_ == 0) throw InvalidInput("simulate: expected a controller sample time above 0");
    std::size_t measured = 0;
    for (const auto& name : controller_.inputs()) {
      const Index from = position(observed, name);
      source_.push_back(from);
      reference_.push_back(from < 0 ? position(plan.signals, name) : -1);
      if (from < 0 && reference_.back() < 0) {
        throw InvalidInput(fmt::format(
            "simulate: expected inputs of the controller that the system observes or a signal "
            "gives, found '{}'",
            name));
      }
      if (from >= 0) ++measured;
    }
    if (!plan.sensors.empty() && plan.sensors.size() != measured) {
      throw InvalidInput(
          fmt::format("simulate: expected {} sensors, one a measured input of the controller, or "
                      "none, found {}",
                      measured, plan.sensors.size()));
    }
    for (const auto& sensor : plan.sensors) validate(sensor);
    for (const auto& name : controller_.outputs()) {
      const Index to = position(inputs, name);
      if (to < 0) {
        throw InvalidInput(fmt::format(
            "simulate: expected commands that are inputs of the system, found '{}'", name));
      }
      target_.push_back(to);
    }
    const auto commands = static_cast<Index>(controller_.outputs().size());
    measured_ = Eigen::VectorXd::Zero(static_cast<Index>(source_.size()));
    // Commands under way: one column a sample not yet arrived, and one being formed.
    waiting_ = Eigen::MatrixXd::Zero(commands, delay_ / period_ + 2);
    acting_ = Eigen::VectorXd::Zero(commands);
    controller_.restart();
  }

  // At the start of interval k, from the outputs there.
  void tick(Index k, const Eigen::VectorXd& outputs) {
    if (k % period_ == 0) sample(k, outputs);
    if (k >= delay_ && (k - delay_) % period_ == 0) {
      acting_ = waiting_.col((k - delay_) / period_ % waiting_.cols());
    }
  }

  void drive(Eigen::VectorXd& input) const {
    for (std::size_t i = 0; i < target_.size(); ++i) {
      input[target_[i]] = acting_[static_cast<Index>(i)];
    }
  }

  const Eigen::VectorXd& acting() const { return acting_; }

 private:
  void sample(Index k, const Eigen::VectorXd& outputs) {
    const Index number = k / period_;
    std::size_t sensor = 0;
    for (std::size_t i = 0; i < source_.size(); ++i) {
      double& value = measured_[static_cast<Index>(i)];
      if (source_[i] < 0) {
        value = plan_.values(k, reference_[i]);
        continue;
      }
      value = outputs[source_[i]];
      if (plan_.sensors.empty()) continue;
      const numerics::NormalNumbers numbers(plan_.seed, first_sensor_stream + sensor);
      value = reading(plan_.sensors[sensor], value,
                      numbers.pair(static_cast<std::uint64_t>(number)).real());
      ++sensor;
    }
    controller_.update(static_cast<double>(k) * plan_.interval, measured_,
                       waiting_.col(number % waiting_.cols()));
  }

  const SimulationPlan& plan_;
  SampledController& controller_;
  Index period_;
  Index delay_;
  std::vector<Index> source_;     // observed output of each controller input, or -1
  std::vector<Index> reference_;  // else its signal, or -1
  std::vector<Index> target_;
  Eigen::VectorXd measured_;
  Eigen::MatrixXd waiting_;
  Eigen::VectorXd acting_;
};

// CVODES with the calls of FastIntegrator. An input jumps or bends at every sample, so that each
// interval starts anew; kinks of the channels are left to the control of its error.
class CvodesIntegrator {
 public:
  CvodesIntegrator(const FeedbackSystem& system, const SimulationPlan& plan)
      : interval_(plan.interval),
        ode_(system),
        integrator_(ode_, 0.0, plan.state.size() != 0 ? plan.state : zero(ode_), options(plan)) {}

  void advance(const Eigen::VectorXd& u_start, const Eigen::VectorXd& u_end) {
    const double start = integrator_.time();
    const double end = interval_ * static_cast<double>(++intervals_);
    ode_.drive(start, u_start, end, u_end);
    integrator_.restart();
    integrator_.advance(end, Approach::stop_exactly);
    outputs_ = ode_.outputs(end, integrator_.state());
  }

  const Eigen::VectorXd& state() const { return integrator_.state(); }
  const Eigen::VectorXd& outputs() const { return outputs_; }
  FastIntegratorStatistics statistics() const {
    FastIntegratorStatistics statistics;
    statistics.steps = integrator_.statistics().steps;
    return statistics;
  }

 private:
  static Eigen::VectorXd zero(const FeedbackOde& ode) {
    return Eigen::VectorXd::Zero(ode.states());
  }
  static OdeOptions options(const SimulationPlan& plan) {
    OdeOptions options;
    options.method = OdeMethod::adams;
    options.iteration = OdeIteration::fixed_point;
    options.max_steps = max_steps;
    options.relative_tolerance = plan.relative_tolerance;
    options.absolute_tolerance = plan.absolute_tolerance;
    return options;
  }

  double interval_;
  FeedbackOde ode_;
  OdeIntegrator integrator_;
  Eigen::VectorXd outputs_;
  Index intervals_ = 0;
};

void check_signals(const SimulationPlan& plan, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& observed) {
  if (plan.values.cols() != static_cast<Index>(plan.signals.size()) || plan.values.rows() < 2) {
    throw InvalidInput(
        fmt::format("simulate: expected at least 2 samples of {} signals, found {} x {}",
                    plan.signals.size(), plan.values.rows(), plan.values.cols()));
  }
  if (!plan.held.empty() && plan.held.size() != plan.signals.size()) {
    throw InvalidInput(fmt::format("simulate: expected {} marks of held signals or none, found {}",
                                   plan.signals.size(), plan.held.size()));
  }
  for (std::size_t i = 0; i < plan.signals.size(); ++i) {
    const auto& name = plan.signals[i];
    const bool driven =
        plan.controller != nullptr && position(plan.controller->outputs(), name) >= 0;
    const bool known = position(inputs, name) >= 0 ||
                       (plan.controller != nullptr && position(observed, name) < 0 &&
                        position(plan.controller->inputs(), name) >= 0);
    if (driven || !known || position(plan.signals, name) != static_cast<Index>(i)) {
      throw InvalidInput(fmt::format(
          "simulate: expected each signal once, an input of the system that the controller does "
          "not drive or a reference of the controller, found '{}'",
          name));
    }
  }
}

template <class Stepper>
SimulationResult run(const FeedbackSystem& system, const SimulationPlan& plan,
                     Stepper& integrator) {
  const auto& linear = system.linear;
  const std::vector<std::string> inputs(linear.inputs.begin(),
                                        linear.inputs.end() - system.channel_outputs);
  const std::vector<std::string> output_names(linear.outputs.begin() + system.channel_inputs,
                                              linear.outputs.end());
  check_signals(plan, inputs, output_names);
  std::optional<ControllerClock> clock;
  if (plan.controller != nullptr) clock.emplace(plan, inputs, output_names);

  const Index intervals = plan.values.rows() - 1;
  const auto outputs = static_cast<Index>(output_names.size());
  SimulationResult result;
  result.names = output_names;
  if (clock) {
    const auto& commands = plan.controller->outputs();
    result.names.insert(result.names.end(), commands.begin(), commands.end());
  }
  result.values.resize(intervals + 1, static_cast<Index>(result.names.size()));
  std::vector<Index> target;
  for (const auto& name : plan.signals) target.push_back(position(inputs, name));
  Eigen::VectorXd start = Eigen::VectorXd::Zero(static_cast<Index>(inputs.size()));
  Eigen::VectorXd end = start;
  const auto fill = [&](Index row, Eigen::VectorXd& input, bool at_end) {
    for (std::size_t i = 0; i < target.size(); ++i) {
      if (target[i] < 0) continue;
      const bool held = !plan.held.empty() && plan.held[i];
      input[target[i]] = plan.values(at_end && held ? row - 1 : row, static_cast<Index>(i));
    }
  };
  fill(0, start, false);
  Eigen::VectorXd now = observed(system, integrator.state(), start);
  Index k = 0;
  for (;; ++k) {
    result.values.row(k).head(outputs) = now.transpose();
    if (clock) {
      clock->tick(k, now);
      result.values.row(k).tail(clock->acting().size()) = clock->acting().transpose();
    }
    if (k == intervals) break;
    if (plan.progress && k % progress_every == 0 && !plan.progress(k, intervals)) {
      result.complete = false;
      break;
    }
    fill(k, start, false);
    fill(k + 1, end, true);
    if (clock) {
      clock->drive(start);
      clock->drive(end);
    }
    integrator.advance(start, end);
    now = integrator.outputs();
  }
  result.values.conservativeResize(k + 1, Eigen::NoChange);
  result.final_state = integrator.state();
  result.statistics = integrator.statistics();
  return result;
}

}  // namespace

Eigen::VectorXd column(const SimulationResult& run, std::string_view name) {
  const auto found = std::ranges::find(run.names, name);
  if (found == run.names.end()) {
    throw InvalidInput(
        fmt::format("column: expected an output or command of the run out of {}, "
                    "found '{}'",
                    fmt::join(run.names, ", "), name));
  }
  return run.values.col(found - run.names.begin());
}

SimulationResult simulate(const FeedbackSystem& system, const SimulationPlan& plan) {
  if (plan.integrator == Integrator::cvodes) {
    CvodesIntegrator integrator(system, plan);
    return run(system, plan, integrator);
  }
  FastIntegrator integrator(system, {.interval = plan.interval,
                                     .relative_tolerance = plan.relative_tolerance,
                                     .absolute_tolerance = plan.absolute_tolerance});
  if (plan.state.size() != 0) integrator.start_from(plan.state);
  return run(system, plan, integrator);
}

}  // namespace boresight::plant
