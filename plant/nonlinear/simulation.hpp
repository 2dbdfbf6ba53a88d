#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/integration/feedback_system.hpp>
#include <boresight/plant/nonlinear/sampled_controller.hpp>
#include <boresight/plant/nonlinear/sensor.hpp>

namespace boresight::plant {

/// What integrates between the samples.
enum class Integrator {
  exponential_collocation,  // FastIntegrator: modes exactly, channels implicitly
  /// OdeIntegrator on FeedbackOde: the same equations without that split, by Adams' methods with
  /// fixed-point iteration, which read the rate alone, no slope dn/dz; started anew at every
  /// sample. For checks: it computes some twenty times as long, and gives up where the shortest
  /// time constant is below some thousandth of the interval.
  cvodes
};

/// A run of a feedback system, optionally with a digital controller: the inputs, their sampling and
/// the observed signals.
struct SimulationPlan {
  /// s between the samples of inputs and outputs; the controller's sample time and delay are whole
  /// multiples of it.
  double interval = 0.0;
  /// Initial state; empty: zero.
  Eigen::VectorXd state;
  /// Signals from outside, by name: inputs of the system that the controller does not drive, and
  /// the controller's references. One column each.
  std::vector<std::string> signals;
  /// At t = k interval: samples x signals; the run has samples - 1 intervals. Interpolated
  /// linearly, except where `held` marks a signal that keeps its value until the next sample.
  Eigen::MatrixXd values;
  std::vector<bool> held;  // one a signal; empty: none
  SampledController* controller = nullptr;
  /// s from the controller's sampling to its command's arrival.
  double computation_delay = 0.0;
  /// What the controller's measured inputs pass through, in the order of its inputs that the system
  /// observes; empty: read exactly.
  std::vector<Sensor> sensors;
  std::uint64_t seed = 1;  // of the sensors' noise, streams 100 and up
  Integrator integrator = Integrator::exponential_collocation;
  /// As FastIntegratorOptions, of the channels' inputs; for cvodes as OdeOptions, of the states.
  double relative_tolerance = 1e-6;
  Eigen::VectorXd absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-8);
  /// Asked every so often with the intervals done; false ends the run there.
  std::function<bool(Eigen::Index done, Eigen::Index all)> progress;
};

struct SimulationResult {
  std::vector<std::string> names;  // observed outputs, then the controller's commands
  /// At t = k interval, from k = 0: samples x names. Outputs as they are just before a held input
  /// or a command jumps; commands as they act after it.
  Eigen::MatrixXd values;
  bool complete = true;  // false: ended by `progress`, with the samples up to there
  Eigen::VectorXd final_state;
  FastIntegratorStatistics statistics;  // of cvodes the steps alone
};

/// The samples of an output or command by name. @throws InvalidInput for one the run has not.
Eigen::VectorXd column(const SimulationResult& run, std::string_view name);

/// Runs the plan. Inputs of the system that no signal names are 0.
/// @throws InvalidInput for names that are unknown, given twice or driven by the controller, inputs
/// of the controller that are neither observed nor given, sizes
/// that do not fit, a sample time or delay that is no multiple of the interval; as FastIntegrator
/// and OdeIntegrator.
SimulationResult simulate(const FeedbackSystem& system, const SimulationPlan& plan);

}  // namespace boresight::plant
