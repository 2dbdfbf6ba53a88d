#pragma once

#include <Eigen/Core>

#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::design {

/// Order reduction of a controller by what its states contribute to its closed loop: balanced
/// truncation with the controller's part of the closed loop's Gramians (P. M. R. Wortelboer,
/// Frequency-weighted balanced reduction of closed-loop mechanical servo-systems, thesis, Delft
/// 1994), by the square-root method. It bounds no error: stability and constraints of the reduced
/// loop must be examined.
class ControllerReduction {
 public:
  /// @throws InvalidInput for Gramians of another size than the controller's states.
  ControllerReduction(const plant::StateSpace& controller, const ControllerGramians& gramians);

  /// The closed loop's Hankel singular values, in descending order.
  const Eigen::VectorXd& singular_values() const { return singular_values_; }
  /// Number of states that contribute more than rounding.
  Eigen::Index largest_order() const { return left_.cols(); }
  /// States reduced_1, reduced_2, ... @throws InvalidInput for an order below 0 or above
  /// largest_order().
  plant::StateSpace of_order(Eigen::Index order) const;

 private:
  plant::StateSpace controller_;
  Eigen::VectorXd singular_values_;
  Eigen::MatrixXd left_, right_;  // bases: left' right is the identity
};

}  // namespace boresight::design
