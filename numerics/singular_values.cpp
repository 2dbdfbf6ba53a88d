#include <algorithm>

#include <Eigen/SVD>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/singular_values.hpp>

namespace boresight::numerics {

SingularValues singular_values(const Eigen::MatrixXd& matrix) {
  const Eigen::Index k = std::min(matrix.rows(), matrix.cols());
  if (k == 0) {
    return {Eigen::MatrixXd(matrix.rows(), 0), Eigen::VectorXd(0),
            Eigen::MatrixXd(matrix.cols(), 0)};
  }
  if (!matrix.allFinite()) {
    throw InvalidInput("singular_values: the matrix has elements that are not finite");
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (svd.info() != Eigen::Success) {
    throw NumericalFailure("singular_values: the Jacobi rotations did not converge");
  }
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace boresight::numerics
