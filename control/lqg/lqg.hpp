#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// An LQG problem: a continuous plant with its disturbances and measured outputs, and a controller
/// at the samples. The plant includes shaping filters, whose states are uncontrollable but
/// estimated. Names and conventions are those of SampledLoop: commands are held and arrive
/// `computation_delay` after their sample.
struct LqgProblem {
  plant::StateSpace plant;
  std::vector<std::string> commands;  // inputs of the plant that the controller drives
  std::vector<std::string> measured;  // outputs of the plant that the controller reads
  double sample_time = 0.0;           // s
  double computation_delay = 0.0;     // s
  /// White noise into inputs of the plant, intensity as SampledLoopNoise. At a command it is added
  /// to the command; the design then relies less on the model there (loop transfer recovery).
  std::map<std::string, double> disturbance_intensity;
  /// For each measured output: variance of the noise of its samples, positive.
  std::map<std::string, double> measurement_variance;
  /// Cost per mean square over all time, for outputs of the plant; at least one.
  std::map<std::string, double> output_weight;
  /// Cost per mean square of each command, positive.
  std::map<std::string, double> command_weight;
};

/// The optimal state feedback u = -K x for a fully known state, held commands included. States:
/// those of the sampled plant, as in sampled_closed_loop.
struct LqRegulator {
  Eigen::MatrixXd gain;            // K, commands x states
  Eigen::MatrixXd cost_to_go;      // X: x'X x is the total cost from the state x on, per sample
  Eigen::MatrixXd input_cost;      // R + B'X B, commands x commands
  Eigen::VectorXcd poles;          // of A - B K, including the uncontrollable ones
  double relative_residual = 0.0;  // of its Riccati equation
};

/// The stationary Kalman filter of the same states.
struct StateEstimator {
  Eigen::MatrixXd gain;                   // M: estimate = prediction + M (y - C prediction)
  Eigen::MatrixXd prediction_covariance;  // before the update by the sample
  Eigen::MatrixXd estimate_covariance;    // after the update
  Eigen::VectorXcd poles;                 // of A (I - M C)
  double relative_residual = 0.0;
};

/// The sampled problem: x[k+1] = A x[k] + B u[k] + w[k], y[k] = C x[k] + v[k]. The cost per sample
/// is x'Q x + 2 x'S u + u'R u plus the effect of the disturbances within the period, which no
/// command changes. All terms are exact integrals of the continuous cost over the period, divided
/// by the period.
struct SampledLqgProblem {
  plant::StateSpace plant;                 // inputs: commands; outputs: measured
  Eigen::MatrixXd process_covariance;      // of w
  Eigen::MatrixXd measurement_covariance;  // of v, diagonal
  Eigen::MatrixXd q, s, r;
  double unavoidable_cost = 0.0;
};

/// @throws InvalidInput for names that the plant does not have; no command, measured output or
/// output weight; variances or command weights that are missing or not positive; other weights and
/// intensities below 0; a disturbance that reaches a weighted or measured output without a lag; a
/// command that reaches a measured output without any delay; and as plant::sample.
SampledLqgProblem sampled_problem(const LqgProblem& problem);

/// @throws as solve_discrete_riccati.
LqRegulator lq_regulator(const SampledLqgProblem& problem);
StateEstimator state_estimator(const SampledLqgProblem& problem);

/// The linear controller of least expected cost (H. Kwakernaak, R. Sivan, Linear Optimal Control
/// Systems, 1972, ch. 6; the sampled cost as T. Chen, B. A. Francis, Optimal Sampled-Data Control
/// Systems, 1995, ch. 12).
struct LqgDesign {
  /// Inputs: measured; outputs: commands; states `state`_estimated. Suitable for SampledLoop. It
  /// uses the sample of the same instant: u = -K (estimate updated by that sample).
  plant::StateSpace controller;
  /// By the separation principle the closed-loop poles are those of regulator and estimator.
  LqRegulator regulator;
  StateEstimator estimator;
  /// The least cost of any controller with these samples, and the least cost with the whole state
  /// known at each sample without error.
  double cost = 0.0;
  double full_information_cost = 0.0;
};

/// @throws as sampled_problem and solve_discrete_riccati, which names the uncontrollable or
/// unobservable modes.
LqgDesign lqg(const LqgProblem& problem);

/// The same from solved parts. They may come from one problem or from two problems that differ only
/// in noise (estimator) and cost (regulator).
plant::StateSpace lqg_controller(const SampledLqgProblem& problem, const LqRegulator& regulator,
                                 const StateEstimator& estimator);

}  // namespace boresight::control
