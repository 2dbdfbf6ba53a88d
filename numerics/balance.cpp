#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::numerics {

Eigen::VectorXd balancing_scale(const Eigen::MatrixXd& a) {
  if (a.rows() != a.cols()) {
    throw InvalidInput(fmt::format("balancing_scale: expected a square matrix, found {} x {}",
                                   a.rows(), a.cols()));
  }
  if (!a.allFinite()) {
    throw InvalidInput("balancing_scale: the matrix has elements that are not finite");
  }
  const Eigen::Index n = a.rows();
  Eigen::MatrixXd scaled = a;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
  // Each pass at least keeps the norm; a handful settle any matrix met.
  constexpr int max_passes = 100;
  bool changed = true;
  for (int pass = 0; changed && pass < max_passes; ++pass) {
    changed = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double diagonal = scaled(i, i);
      scaled(i, i) = 0.0;
      const double column = scaled.col(i).stableNorm();
      const double row = scaled.row(i).stableNorm();
      scaled(i, i) = diagonal;
      if (column == 0.0 || row == 0.0) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (factor == 1.0 ||
          std::hypot(column * factor, row / factor) > 0.95 * std::hypot(column, row)) {
        continue;
      }
      scaled.col(i) *= factor;
      scaled.row(i) /= factor;
      scale[i] *= factor;
      changed = true;
    }
  }
  return scale;
}

}  // namespace boresight::numerics
