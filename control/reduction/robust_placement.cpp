#include <cmath>
#include <utility>

#include <Eigen/LU>
#include <Eigen/QR>

#include <boresight/control/reduction/robust_placement.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

// Orthonormal basis of what is orthogonal to the columns of `matrix`.
MatrixXcd complement(const MatrixXcd& matrix) {
  const Index n = matrix.rows();
  const Eigen::HouseholderQR<MatrixXcd> qr(matrix);
  const MatrixXcd q = qr.householderQ();
  return q.rightCols(n - matrix.cols());
}

// The spaces in which the eigenvectors must lie: (A - p) x in the range of U.
std::vector<MatrixXcd> eigenvector_spaces(const MatrixXd& a, const MatrixXd& u,
                                          const std::vector<Complex>& poles) {
  const MatrixXcd outside = complement(u.cast<Complex>());
  std::vector<MatrixXcd> spaces;
  for (const Complex pole : poles) {
    MatrixXcd shifted = a.cast<Complex>();
    shifted.diagonal().array() -= pole;
    MatrixXcd space = complement(shifted.adjoint() * outside);
    // A real pole has a real eigenvector.
    if (pole.imag() == 0.0) {
      const MatrixXd real = space.real();
      space = real.cast<Complex>();
    }
    spaces.push_back(std::move(space));
  }
  return spaces;
}

// Unit eigenvectors to begin with: projections of directions that are spread evenly.
MatrixXcd first_guess(const std::vector<MatrixXcd>& spaces, const std::vector<Complex>& poles,
                      double phase) {
  const Index n = static_cast<Index>(poles.size());
  MatrixXcd x(n, n);
  constexpr double golden_angle = 2.399963229728653;  // never the same direction twice
  for (Index j = 0; j < n; ++j) {
    const auto& space = spaces[static_cast<std::size_t>(j)];
    const Complex pole = poles[static_cast<std::size_t>(j)];
    if (pole.imag() < 0.0) {
      x.col(j) = x.col(j - 1).conjugate();
      continue;
    }
    VectorXcd direction(n);
    for (Index i = 0; i < n; ++i) {
      phase += golden_angle;
      direction[i] = pole.imag() == 0.0 ? Complex{std::cos(phase)} : std::polar(1.0, phase);
    }
    VectorXcd vector = space * (space.adjoint() * direction);
    x.col(j) = vector / vector.norm();
  }
  return x;
}

// Puts `columns` in the place of those of X from j on and follows with the inverse of X.
void replace_columns(MatrixXcd& x, MatrixXcd& inverse, Index j, const MatrixXcd& columns) {
  const Index width = columns.cols();
  const MatrixXcd change = inverse * (columns - x.middleCols(j, width));
  MatrixXcd small = change.middleRows(j, width);
  small.diagonal().array() += 1.0;
  const MatrixXcd rows = small.partialPivLu().solve(inverse.middleRows(j, width));
  inverse.noalias() -= change * rows;
  x.middleCols(j, width) = columns;
}

// The unit vector of `space` for which, with its conjugate, the determinant of X is largest, given
// row j of X^-1, whose real and imaginary part span the plane orthogonal to all other columns.
VectorXcd best_of_pair(const MatrixXcd& space, const VectorXcd& orthogonal) {
  const Index n = space.rows();
  MatrixXd plane(n, 2);
  plane.col(0) = orthogonal.real();
  plane.col(0) /= plane.col(0).norm();
  plane.col(1) = orthogonal.imag();
  plane.col(1) -= plane.col(0) * plane.col(0).dot(plane.col(1));
  plane.col(1) /= plane.col(1).norm();
  // With x = space v the determinant goes with v^H K v.
  const MatrixXcd seen = plane.transpose() * space;
  const MatrixXcd product = seen.row(1).adjoint() * seen.row(0);
  const MatrixXcd k = (product - product.adjoint()) / Complex{0.0, 2.0};
  const numerics::HermitianEigen eigen = numerics::hermitian_eigen(k);
  const Index last = eigen.values.size() - 1;
  const Index largest = std::abs(eigen.values[0]) > std::abs(eigen.values[last]) ? 0 : last;
  const VectorXcd x = space * eigen.vectors.col(largest);
  return x / x.norm();
}

// One pass over all eigenvectors.
void sweep(MatrixXcd& x, MatrixXcd& inverse, const std::vector<MatrixXcd>& spaces,
           const std::vector<Complex>& poles) {
  for (Index j = 0; j < x.cols(); ++j) {
    const auto& space = spaces[static_cast<std::size_t>(j)];
    const VectorXcd orthogonal = inverse.row(j).adjoint();
    if (poles[static_cast<std::size_t>(j)].imag() == 0.0) {
      const VectorXcd vector = space * (space.adjoint() * orthogonal.real().cast<Complex>());
      replace_columns(x, inverse, j, vector / vector.norm());
      continue;
    }
    MatrixXcd pair(x.rows(), 2);
    pair.col(0) = best_of_pair(space, orthogonal);
    pair.col(1) = pair.col(0).conjugate();
    replace_columns(x, inverse, j, pair);
    ++j;
  }
}

}  // namespace

MatrixXd place_with_several_inputs(const MatrixXd& a, const MatrixXd& u,
                                   const std::vector<Complex>& poles, int most_sweeps) {
  const Index n = a.rows();
  const auto spaces = eigenvector_spaces(a, u, poles);
  MatrixXcd x = first_guess(spaces, poles, 0.0);
  MatrixXcd inverse = x.partialPivLu().inverse();
  constexpr int most_guesses = 10;
  for (int guess = 1; guess < most_guesses && !(inverse.norm() < 1e12); ++guess) {
    x = first_guess(spaces, poles, static_cast<double>(guess));
    inverse = x.partialPivLu().inverse();
  }
  MatrixXcd best = x;
  MatrixXcd best_inverse = inverse;
  double least = inverse.norm();
  for (int pass = 0; pass < most_sweeps; ++pass) {
    sweep(x, inverse, spaces, poles);
    // Rank-one and rank-two updates gather rounding errors.
    inverse = x.partialPivLu().inverse();
    const double size = inverse.norm();
    if (!std::isfinite(size)) break;
    const bool settled = std::abs(size - least) < 1e-3 * least;
    if (size < least) {
      least = size;
      best = x;
      best_inverse = inverse;
    }
    if (settled) break;
  }
  const VectorXcd values = Eigen::Map<const VectorXcd>(poles.data(), n);
  const MatrixXd closed = (best * values.asDiagonal() * best_inverse).real();
  return u.transpose() * (a - closed);
}

}  // namespace boresight::control
