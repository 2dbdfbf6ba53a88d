#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::numerics {
namespace {

Eigen::EigenSolver<Eigen::MatrixXd> solve(const char* function, const Eigen::MatrixXd& matrix,
                                          bool vectors) {
  if (matrix.rows() != matrix.cols()) {
    throw InvalidInput(fmt::format("{}: expected a square matrix, found {} x {}", function,
                                   matrix.rows(), matrix.cols()));
  }
  if (!matrix.allFinite()) {
    throw InvalidInput(fmt::format("{}: the matrix has elements that are not finite", function));
  }
  Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, vectors);
  if (solver.info() != Eigen::Success) {
    throw NumericalFailure(fmt::format("{}: the QR iteration did not converge", function));
  }
  return solver;
}

std::vector<Eigen::Index> order_of(const Eigen::VectorXcd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    const double magnitude_a = std::abs(values[a]);
    const double magnitude_b = std::abs(values[b]);
    if (magnitude_a != magnitude_b) return magnitude_a < magnitude_b;
    return values[a].imag() < values[b].imag();
  });
  return order;
}

}  // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return {};
  const Eigen::VectorXcd values = solve("eigenvalues", matrix, false).eigenvalues();
  const auto order = order_of(values);
  Eigen::VectorXcd sorted(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    sorted[i] = values[order[static_cast<std::size_t>(i)]];
  }
  return sorted;
}

EigenDecomposition eigen_decomposition(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return {};
  const auto solver = solve("eigen_decomposition", matrix, true);
  const Eigen::VectorXcd& values = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const auto order = order_of(values);
  const Eigen::Index n = values.size();
  EigenDecomposition result{Eigen::VectorXcd(n), Eigen::MatrixXcd(n, n), {}, 1.0};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index from = order[static_cast<std::size_t>(i)];
    result.values[i] = values[from];
    result.right.col(i) = vectors.col(from);
  }
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(result.right);
  result.reciprocal_condition = lu.rcond();
  if (!(result.reciprocal_condition > 1e-15)) {
    throw NumericalFailure(
        "eigen_decomposition: the eigenvectors are dependent to working precision (a defective "
        "matrix)");
  }
  result.left = lu.inverse().adjoint();
  return result;
}

double spectral_abscissa(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) {
    throw InvalidInput("spectral_abscissa: expected a matrix with states, found an empty one");
  }
  return eigenvalues(matrix).real().maxCoeff();
}

double spectral_radius(const Eigen::MatrixXd& matrix) {
  return matrix.rows() == 0 ? 0.0 : eigenvalues(matrix).cwiseAbs().maxCoeff();
}

}  // namespace boresight::numerics
