#pragma once

#include <Eigen/Core>

namespace boresight::control {

enum class TimeDomain { continuous, sampled };

/// Lyapunov equations in Schur coordinates, with symmetric right-hand sides:
///   continuous  T X + X T' = C       (R. H. Bartels, G. W. Stewart, Comm. ACM 15, 1972)
///   sampled     T X T' - X = C       (G. Kitagawa, Int. J. Control 25, 1977)
/// T is the quasi-triangular factor of numerics::real_schur. The solution proceeds in real
/// arithmetic by columns from the last and computes only the upper half of X: about n^3 operations.
/// A 2 x 2 block on the column side is treated as one complex column. This only scales the two
/// columns and costs no accuracy. The equation must be regular (no two eigenvalues with sum 0, or
/// product 1). The caller must check the eigenvalues first.
class SchurLyapunov {
 public:
  /// @throws InvalidInput unless `t` is square.
  SchurLyapunov(Eigen::MatrixXd t, TimeDomain domain);

  /// Replaces C by the symmetric solution X.
  void solve(Eigen::MatrixXd& c);
  /// The same with T' instead of T: T' X + X T = C, T' X T - X = C.
  void solve_transposed(Eigen::MatrixXd& c);

 private:
  void solve_upper(const Eigen::MatrixXd& t, Eigen::MatrixXd& c);
  void right_hand_side(const Eigen::MatrixXd& t, const Eigen::MatrixXd& c, Eigen::Index j,
                       Eigen::Index width);
  void substitute_real(const Eigen::MatrixXd& t, Eigen::Index rows, double shift);
  void substitute_complex(const Eigen::MatrixXd& t, Eigen::Index rows, double shift_real,
                          double shift_imaginary);

  TimeDomain domain_;
  Eigen::MatrixXd t_;
  Eigen::MatrixXd flipped_;  // T' with reversed rows and columns, computed on request
  Eigen::MatrixXd column_;   // n x 2: the one or two columns being solved for
  Eigen::MatrixXd known_;    // n x 2: what the later columns contribute
};

/// The 2-norm of a symmetric matrix by power iteration, to a few per cent and never above it.
double symmetric_norm(const Eigen::MatrixXd& matrix);

}  // namespace boresight::control
