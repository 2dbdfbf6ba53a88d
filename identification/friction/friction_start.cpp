#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boresight/identification/friction/friction_rows.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {
namespace {

// Least squares with some columns kept from turning negative, by trying every set of them.
struct LinearFit {
  Eigen::VectorXd x;
  double cost = std::numeric_limits<double>::infinity();
};
LinearFit nonnegative_fit(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right,
                          double square, int nonnegative) {
  LinearFit best;
  const auto n = static_cast<int>(right.size());
  for (int set = 0; set < (1 << nonnegative); ++set) {
    std::vector<Eigen::Index> free;
    for (int i = 0; i < n; ++i) {
      if (i >= nonnegative || (set >> i & 1) != 0) free.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd part(m, m);
    Eigen::VectorXd part_right(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      part_right(i) = right(free[static_cast<std::size_t>(i)]);
      for (Eigen::Index j = 0; j < m; ++j) {
        part(i, j) = normal(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
      }
      part(i, i) *= 1.0 + 1e-9;
      if (part(i, i) <= 0.0) part(i, i) = 1.0;
    }
    const Eigen::VectorXd x =
        numerics::positive_definite_solve(part, part_right, "friction's linear fit");
    LinearFit fit{Eigen::VectorXd::Zero(n), square - x.dot(part_right)};
    bool feasible = true;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index at = free[static_cast<std::size_t>(i)];
      fit.x(at) = x(i);
      feasible = feasible && (at >= nonnegative || x(i) >= 0.0);
    }
    if (feasible && fit.cost < best.cost) best = fit;
  }
  return best;
}

constexpr int grid = 14;

}  // namespace

Eigen::VectorXd friction_start(const FrictionRows& rows, const numerics::Uncertain& inertia_prior,
                               const Eigen::VectorXd& deviation) {
  const Eigen::Index size = rows.size();
  const double low = std::max(rows.slowest, 1e-3 * rows.highest_rate);
  const double ratio = rows.highest_rate / low;
  std::array<double, grid> scale{};
  Eigen::MatrixXd bumps(size, grid), rises(size, grid), fixed(size, 4);
  for (int i = 0; i < grid; ++i) {
    scale[static_cast<std::size_t>(i)] = low * std::pow(ratio, i / (grid - 1.0));
  }
  for (Eigen::Index row = 0; row < size; ++row) {
    const auto& motion = rows.motion[static_cast<std::size_t>(row)];
    const Eigen::ArrayXd speed = motion.rate.array().abs();
    const Eigen::ArrayXd weight = motion.rate_weight.array() * motion.rate.array().sign() /
                                  (motion.duration * deviation(row));
    fixed.row(row) << weight.sum(), (weight * speed).sum(), 1.0 / deviation(row),
        motion.rate_change / (motion.duration * deviation(row));
    for (int i = 0; i < grid; ++i) {
      const Eigen::ArrayXd x = speed / scale[static_cast<std::size_t>(i)];
      bumps(row, i) = (weight * (-x.square()).exp()).sum();
      rises(row, i) = (weight * (1.0 - (-x).exp())).sum();
    }
  }
  const Eigen::VectorXd measured =
      ((rows.torque + rows.structure).array() / deviation.array()).matrix();
  const double prior_weight =
      1.0 / (inertia_prior.standard_uncertainty * inertia_prior.standard_uncertainty);
  Eigen::MatrixXd columns(size, 6);
  columns.col(0) = fixed.col(0);
  columns.col(3) = fixed.col(1);
  columns.rightCols(2) = fixed.rightCols(2);
  LinearFit best;
  int best_bump = 0, best_rise = 0;
  for (int i = 0; i < grid; ++i) {
    columns.col(1) = bumps.col(i);
    for (int j = 0; j < grid; ++j) {
      columns.col(2) = rises.col(j);
      Eigen::MatrixXd normal = columns.transpose() * columns;
      Eigen::VectorXd right = columns.transpose() * measured;
      normal(5, 5) += prior_weight;
      right(5) += prior_weight * inertia_prior.value;
      const LinearFit fit = nonnegative_fit(normal, right, measured.squaredNorm(), 4);
      if (fit.cost < best.cost) {
        best = fit;
        best_bump = i;
        best_rise = j;
      }
    }
  }
  // A part that is absent starts at a thousandth of the largest torque: its logarithm is finite.
  const double floor = 1e-3 * rows.torque.cwiseAbs().maxCoeff();
  Eigen::VectorXd start(10);
  start << std::log(std::max(best.x(0), floor)), std::log(std::max(best.x(1), floor)),
      std::log(scale[static_cast<std::size_t>(best_bump)]), std::log(std::max(best.x(2), floor)),
      std::log(scale[static_cast<std::size_t>(best_rise)]),
      std::log(std::max(best.x(3), floor / rows.highest_rate)), best.x(4), 0.0, best.x(5), 0.0;
  return start;
}

}  // namespace boresight::identification
