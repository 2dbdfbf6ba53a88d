#pragma once

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

/// The steps that staircase algorithms are made of.
namespace boresight::plant {

/// An orthogonal Q with Q' M = [R; 0], R of full row rank `rank`.
struct RowCompression {
  Eigen::MatrixXd q;  // rows x rows
  Eigen::Index rank = 0;
  double smallest_kept = 0.0;      // last pivot that counts; infinity if none does
  double largest_neglected = 0.0;  // first pivot that does not; 0 if all do
};

/// Householder QR with column pivoting; pivots up to `tolerance` (absolute) count as 0.
RowCompression compress_rows(const Eigen::MatrixXd& matrix, double tolerance);

/// A system in which rank decisions do not depend on units: the states scaled so that rows and
/// columns of [A B; C 0] are balanced, then each column of [B; D] and row of [C D] brought to the
/// size of A. Powers of two, so nothing is rounded: B = diag(state_unit)^-1 B_given
/// diag(input_unit), C = diag(output_unit) C_given diag(state_unit).
struct EvenUnits {
  StateSpace system;
  Eigen::VectorXd state_unit;
  Eigen::VectorXd input_unit;
  Eigen::VectorXd output_unit;
  double size = 1.0;  // norm of A, 1 if that is 0
};

EvenUnits even_units(const StateSpace& system);

}  // namespace boresight::plant
