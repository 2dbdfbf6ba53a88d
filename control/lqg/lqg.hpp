#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A continuous plant, its disturbances (shaping filters included: states that nothing controls,
/// but that are estimated) and what is known of it, to be controlled at the samples. The signals
/// are named as in SampledLoop, whose conventions hold: commands are held and arrive
/// `computation_delay` after their sample.
struct LqgProblem {
  plant::StateSpace plant;
  std::vector<std::string> commands;  // inputs of the plant that the controller drives
  std::vector<std::string> measured;  // outputs of the plant that it takes
  double sample_time = 0.0;           // s
  double computation_delay = 0.0;     // s
  /// White noise into inputs of the plant, intensity as SampledLoopNoise; at a command: noise that
  /// adds to it, which makes the design rely less on the model there (loop transfer recovery).
  std::map<std::string, double> disturbance_intensity;
  /// Of each measured output: variance of its samples' noise, positive.
  std::map<std::string, double> measurement_variance;
  /// Cost per mean square over all time of outputs of the plant, at least one.
  std::map<std::string, double> output_weight;
  /// Cost per mean square of each command, positive.
  std::map<std::string, double> command_weight;
};

/// The best state feedback u = -K x for what is known of the whole state, held commands included.
/// States: those of the sampled plant, as in sampled_closed_loop.
struct LqRegulator {
  Eigen::MatrixXd gain;        // K, commands x states
  Eigen::MatrixXd cost_to_go;  // X: x'X x is what the state x costs until it has gone, per sample
  Eigen::MatrixXd input_cost;  // R + B'X B, commands x commands
  Eigen::VectorXcd poles;      // of A - B K, and of what nothing controls
  double relative_residual = 0.0;  // of its Riccati equation
};

/// The stationary Kalman filter of the same states.
struct StateEstimator {
  Eigen::MatrixXd gain;                   // M: estimate = prediction + M (y - C prediction)
  Eigen::MatrixXd prediction_covariance;  // before the sample is taken in
  Eigen::MatrixXd estimate_covariance;    // after
  Eigen::VectorXcd poles;                 // of A (I - M C)
  double relative_residual = 0.0;
};

/// The sampled problem: x[k+1] = A x[k] + B u[k] + w[k], y[k] = C x[k] + v[k], and the cost per
/// sample x'Q x + 2 x'S u + u'R u + what the disturbances do within the period whatever the
/// command, all exact integrals of the continuous cost over the period divided by it.
struct SampledLqgProblem {
  plant::StateSpace plant;                 // inputs: commands; outputs: measured
  Eigen::MatrixXd process_covariance;      // of w
  Eigen::MatrixXd measurement_covariance;  // of v, diagonal
  Eigen::MatrixXd q, s, r;
  double unavoidable_cost = 0.0;
};

/// @throws InvalidInput for names that the plant does not have, no command, no measured output, no
/// output weight, variances or command weights that are missing or not positive, other weights and
/// intensities below 0, a disturbance that reaches a weighted or measured output without a lag, a
/// command that reaches a measured output without any delay, and as plant::sample.
SampledLqgProblem sampled_problem(const LqgProblem& problem);

/// @throws as solve_discrete_riccati.
LqRegulator lq_regulator(const SampledLqgProblem& problem);
StateEstimator state_estimator(const SampledLqgProblem& problem);

/// The linear controller of least cost in the mean (H. Kwakernaak, R. Sivan, Linear Optimal Control
/// Systems, 1972, ch. 6; the sampled cost as T. Chen, B. A. Francis, Optimal Sampled-Data Control
/// Systems, 1995, ch. 12).
struct LqgDesign {
  /// Inputs: measured; outputs: commands; states `state`_estimated: goes into SampledLoop. The
  /// sample of the same instant is used: u = -K (estimate with it).
  plant::StateSpace controller;
  /// By the separation principle the poles of the closed loop are those of both.
  LqRegulator regulator;
  StateEstimator estimator;
  /// The least cost of any controller with these samples, and with the whole state known at each
  /// sample without error.
  double cost = 0.0;
  double full_information_cost = 0.0;
};

/// @throws as sampled_problem and solve_discrete_riccati, which names what cannot be controlled or
/// seen.
LqgDesign lqg(const LqgProblem& problem);

/// The same from parts already solved, of one problem or of two that differ in noise (estimator)
/// and cost (regulator) only.
plant::StateSpace lqg_controller(const SampledLqgProblem& problem, const LqRegulator& regulator,
                                 const StateEstimator& estimator);

}  // namespace boresight::control
