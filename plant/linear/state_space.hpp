#pragma once

#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace boresight::plant {

/// dx/dt = A x + B u, y = C x + D u with a name for every input, output and state; or, with a
/// sample time T > 0, x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k] at t = k T.
/// A: n x n, B: n x inputs, C: outputs x n, D: outputs x inputs.
struct StateSpace {
  Eigen::MatrixXd a, b, c, d;
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  std::vector<std::string> states;
  double sample_time = 0.0;  // s; 0 for continuous time
};

/// Refuses shapes that do not fit the names, duplicate names within inputs, outputs or states,
/// elements that are not finite and a sample time below 0. @throws InvalidInput naming the first
/// defect.
void validate(const StateSpace& system);

/// Position of a name; @throws InvalidInput listing the names there are.
Eigen::Index input_index(const StateSpace& system, std::string_view name);
Eigen::Index output_index(const StateSpace& system, std::string_view name);

/// A system without states: y = gain u.
StateSpace static_gain(const Eigen::MatrixXd& gain, std::vector<std::string> inputs,
                       std::vector<std::string> outputs);

/// A real single-input, single-output transfer function numerator/denominator, ascending powers
/// of s, as controllable companion form with states `name`.1, .2, ... Low orders only (filters,
/// compensators): high-order polynomials are ill-conditioned.
/// @throws InvalidInput if it is not proper or the leading denominator coefficient is 0.
StateSpace rational(const std::vector<double>& numerator, const std::vector<double>& denominator,
                    const std::string& input, const std::string& output, const std::string& name);

/// Connects systems by name: an input with the name of an output, of another or the same system, is
/// fed from it. All other inputs must be among `external_inputs` (one external input may feed
/// several systems). The result has exactly `external_inputs` and `external_outputs`, and all
/// states.
/// @throws InvalidInput for an output or state name given twice, an input that nothing feeds, an
/// external name that does not exist or is also an output (loop to outside), or systems of
/// different sample times (a static gain fits any). NumericalFailure for an algebraic loop without
/// solution.
StateSpace connect(const std::vector<StateSpace>& systems,
                   const std::vector<std::string>& external_inputs,
                   const std::vector<std::string>& external_outputs);

/// C (s I - A)^-1 B + D, outputs x inputs, at one angular frequency w (rad/s): s = j w, or
/// z = e^(j w T) in its place where the system is sampled. O(n^3): the independent check of the
/// faster responses, not for inner loops.
Eigen::MatrixXcd frequency_response(const StateSpace& system, double angular_frequency);

}  // namespace boresight::plant
