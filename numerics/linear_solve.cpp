#include <Eigen/LU>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::numerics {

Eigen::MatrixXd linear_solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right_hand_side,
                             const char* what) {
  if (matrix.rows() != matrix.cols() || matrix.rows() != right_hand_side.rows()) {
    throw InvalidInput(
        fmt::format("{}: expected a square matrix and as many rows on the right, "
                    "found {} x {} and {} rows",
                    what, matrix.rows(), matrix.cols(), right_hand_side.rows()));
  }
  if (matrix.size() == 0 || right_hand_side.size() == 0) return right_hand_side;
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
  if (!(lu.rcond() > 1e-15)) {
    throw NumericalFailure(
        fmt::format("{}: the matrix is singular to working precision (reciprocal condition {:.1e})",
                    what, lu.rcond()));
  }
  return lu.solve(right_hand_side);
}

Eigen::MatrixXcd complex_solve(const Eigen::MatrixXcd& matrix,
                               const Eigen::MatrixXcd& right_hand_side) {
  if (matrix.rows() != matrix.cols() || matrix.rows() != right_hand_side.rows()) {
    throw InvalidInput(
        fmt::format("complex_solve: expected a square matrix and as many rows on the right, "
                    "found {} x {} and {} rows",
                    matrix.rows(), matrix.cols(), right_hand_side.rows()));
  }
  if (matrix.size() == 0 || right_hand_side.size() == 0) return right_hand_side;
  return matrix.partialPivLu().solve(right_hand_side);
}

Eigen::MatrixXcd transfer_matrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                 const Eigen::MatrixXd& c, const Eigen::MatrixXd& d,
                                 std::complex<double> s) {
  Eigen::MatrixXcd shifted = -a.cast<std::complex<double>>();
  shifted.diagonal().array() += s;
  const Eigen::MatrixXcd states = complex_solve(shifted, b.cast<std::complex<double>>());
  return c.cast<std::complex<double>>() * states + d.cast<std::complex<double>>();
}

}  // namespace boresight::numerics
