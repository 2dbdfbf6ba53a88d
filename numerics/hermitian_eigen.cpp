#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>

namespace boresight::numerics {

HermitianEigen hermitian_eigen(const Eigen::MatrixXcd& matrix) {
  if (matrix.rows() != matrix.cols()) {
    throw InvalidInput(fmt::format("hermitian_eigen: expected a square matrix, found {} x {}",
                                   matrix.rows(), matrix.cols()));
  }
  if (!matrix.allFinite()) {
    throw InvalidInput("hermitian_eigen: the matrix has elements that are not finite");
  }
  if (matrix.size() == 0) return {Eigen::VectorXd(0), Eigen::MatrixXcd(0, 0)};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(matrix);
  if (solver.info() != Eigen::Success) {
    throw NumericalFailure("hermitian_eigen: the QR iteration did not converge");
  }
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace boresight::numerics
