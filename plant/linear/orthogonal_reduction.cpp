#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include <boresight/numerics/balance.hpp>
#include <boresight/plant/linear/orthogonal_reduction.hpp>

namespace boresight::plant {

RowCompression compress_rows(const Eigen::MatrixXd& matrix, double tolerance) {
  RowCompression result{Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()), 0,
                        std::numeric_limits<double>::infinity(), 0.0};
  if (matrix.size() == 0) return result;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  result.q = qr.householderQ();
  for (Eigen::Index i = 0; i < std::min(matrix.rows(), matrix.cols()); ++i) {
    const double pivot = std::abs(qr.matrixQR()(i, i));
    if (!(pivot > tolerance)) {
      result.largest_neglected = pivot;
      break;
    }
    result.smallest_kept = pivot;
    ++result.rank;
  }
  return result;
}

EvenUnits even_units(const StateSpace& system) {
  validate(system);
  const Eigen::Index n = system.a.rows(), m = system.b.cols(), p = system.c.rows();
  EvenUnits even{system, Eigen::VectorXd::Ones(n), Eigen::VectorXd::Ones(m),
                 Eigen::VectorXd::Ones(p), 1.0};
  if (n > 0) {
    // All inputs and all outputs as one more state, whose scale is then taken back.
    Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(n + 1, n + 1);
    joint.topLeftCorner(n, n) = system.a;
    if (m > 0) joint.topRightCorner(n, 1) = system.b.rowwise().norm();
    if (p > 0) joint.bottomLeftCorner(1, n) = system.c.colwise().norm();
    const Eigen::VectorXd scale = numerics::balancing_scale(joint);
    even.state_unit = scale.head(n) / scale[n];
  }
  StateSpace& scaled = even.system;
  const Eigen::VectorXd inverse = even.state_unit.cwiseInverse();
  scaled.a = inverse.asDiagonal() * system.a * even.state_unit.asDiagonal();
  scaled.b = inverse.asDiagonal() * system.b;
  scaled.c = system.c * even.state_unit.asDiagonal();
  if (scaled.a.norm() > 0.0) even.size = scaled.a.norm();
  const auto unit_of = [&](double norm) {
    return norm > 0.0 ? std::exp2(std::round(std::log2(even.size / norm))) : 1.0;
  };
  for (Eigen::Index j = 0; j < m; ++j) {
    const double unit = unit_of(std::hypot(scaled.b.col(j).norm(), scaled.d.col(j).norm()));
    even.input_unit[j] = unit;
    scaled.b.col(j) *= unit;
    scaled.d.col(j) *= unit;
  }
  for (Eigen::Index i = 0; i < p; ++i) {
    const double unit = unit_of(std::hypot(scaled.c.row(i).norm(), scaled.d.row(i).norm()));
    even.output_unit[i] = unit;
    scaled.c.row(i) *= unit;
    scaled.d.row(i) *= unit;
  }
  return even;
}

}  // namespace boresight::plant
