#pragma once

#include <complex>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// A state space seen as the sum of its modes,
///   H(s) = D + sum over real poles o i/(s - p)
///            + sum over pairs [o i/(s - p) + conj(o i)/(s - conj p)],
/// o a column of `output`, i the row of `input` that belongs to the pole p. For a sampled system z
/// stands for s.
struct ModalForm {
  Eigen::VectorXcd poles;   // k: the real ones, and of each pair the one with Im > 0
  Eigen::MatrixXcd input;   // k x inputs
  Eigen::MatrixXcd output;  // outputs x k
  Eigen::MatrixXd feedthrough;
  /// What brings each pole nearer to that of the system given: the poles above belong, as rounding
  /// left them, with these inputs and outputs. By the two-sided Rayleigh quotient in long double.
  Eigen::VectorXcd pole_correction;
  /// What rounding leaves uncertain of each corrected pole, in magnitude (an estimate).
  Eigen::VectorXd pole_error;
  /// The same of its input and output, relative to the largest elements.
  Eigen::VectorXd vector_error;
  /// Condition of the eigenvectors of the balanced system, 1-norm: rounding errors of a response
  /// by modes are some 1e-16 times this, relative to the largest of its terms.
  double condition = 1.0;
  double sample_time = 0.0;  // s; 0 for continuous time
};

/// Above this condition a dense route is more exact than the modes.
inline constexpr double highest_modal_condition = 1e8;

/// Balances the system and diagonalises it: O(n^3).
/// @throws InvalidInput as validate(system); NumericalFailure if the eigenvectors are dependent to
/// working precision (several equal poles in a chain): take a dense route then.
ModalForm modal_form(const StateSpace& system);

/// The response by modes at one s (or z): outputs x inputs.
Eigen::MatrixXcd modal_response(const ModalForm& form, std::complex<double> s);

}  // namespace boresight::plant
