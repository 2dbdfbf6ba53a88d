#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/control/analysis/singular_value_bound.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>

namespace boresight::control {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The largest value of p0 + p1 x + p2 x^2 for |x| <= h, and where.
std::pair<double, double> parabola_maximum(double p0, double p1, double p2, double h) {
  double at = p1 > 0.0 ? h : -h;
  if (p2 < 0.0 && std::abs(p1) < -2.0 * p2 * h) at = -0.5 * p1 / p2;
  return {p0 + at * (p1 + at * p2), at};
}

}  // namespace

GainBound gain_bound(const numerics::TaylorModel& element, double half_width) {
  GainBound bound;
  bound.at_centre = std::abs(element.value);
  bound.upper = numerics::magnitude_upper_bound(element, half_width);
  const double p1 = 2.0 * (std::conj(element.value) * element.slope).real();
  const double p2 =
      std::norm(element.slope) + 2.0 * (std::conj(element.value) * element.curvature).real();
  bound.best_offset = parabola_maximum(0.0, p1, p2, half_width).second;
  return bound;
}

GainBound gain_bound(const std::vector<numerics::TaylorModel>& elements, Eigen::Index rows,
                     double half_width) {
  const double h = half_width;
  const auto columns = static_cast<Eigen::Index>(elements.size()) / std::max<Eigen::Index>(rows, 1);
  Eigen::MatrixXcd c0(rows, columns), c1(rows, columns), c2(rows, columns);
  double rest = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      const auto& element = elements[static_cast<std::size_t>(i * columns + j)];
      c0(i, j) = element.value;
      c1(i, j) = element.slope;
      c2(i, j) = element.curvature;
      rest = std::hypot(rest, element.rest);
    }
  }
  if (!(rest < infinity)) return {0.0, infinity, 0.0};
  if (columns > rows) {  // the same singular values in the smaller product
    c0.adjointInPlace();
    c1.adjointInPlace();
    c2.adjointInPlace();
  }
  const Eigen::MatrixXcd m0 = c0.adjoint() * c0;
  const Eigen::MatrixXcd half1 = c0.adjoint() * c1, half2 = c0.adjoint() * c2;
  const Eigen::MatrixXcd m1 = half1 + half1.adjoint();
  const Eigen::MatrixXcd m2 = half2 + half2.adjoint() + c1.adjoint() * c1;
  const Eigen::MatrixXcd half3 = c1.adjoint() * c2;
  const double cubic = (half3 + half3.adjoint()).norm(), quartic = (c2.adjoint() * c2).norm();

  const auto eigen = numerics::hermitian_eigen(m0);
  const Eigen::Index n = eigen.values.size();
  GainBound bound;
  bound.at_centre = n > 0 ? std::sqrt(std::max(eigen.values[n - 1], 0.0)) : 0.0;
  if (n == 0) return bound;
  const Eigen::MatrixXcd a1 = eigen.vectors.adjoint() * m1 * eigen.vectors;
  const Eigen::MatrixXcd a2 = eigen.vectors.adjoint() * m2 * eigen.vectors;
  const double top = eigen.values[n - 1];

  // Those that the interval might bring above the largest go together with it.
  Eigen::Index cluster = 1;
  while (cluster < n && top - eigen.values[n - 1 - cluster] <= 4.0 * h * m1.norm()) ++cluster;
  const Eigen::Index others = n - cluster;
  double coupling = 0.0;  // adds coupling x^2
  bool separate = true;
  if (others > 0) {
    const double below =
        eigen.values[others - 1] +
        h * (a1.topLeftCorner(others, others).norm() + h * a2.topLeftCorner(others, others).norm());
    const double above = top - h * (a1.bottomRightCorner(cluster, cluster).norm() +
                                    h * a2.bottomRightCorner(cluster, cluster).norm());
    const double size =
        a1.topRightCorner(others, cluster).norm() + h * a2.topRightCorner(others, cluster).norm();
    separate = cluster == 1 && above > below;
    if (separate) coupling = size * size / (above - below);
  }
  double square = 0.0;
  if (cluster == 1 && separate) {
    const auto [value, at] =
        parabola_maximum(top, a1(n - 1, n - 1).real(), a2(n - 1, n - 1).real() + coupling, h);
    square = value;
    bound.best_offset = at;
  } else {
    const Eigen::VectorXd slopes = numerics::hermitian_eigen(m1).values;
    const Eigen::VectorXd curvatures = numerics::hermitian_eigen(m2).values;
    square = top + h * std::max(std::abs(slopes[0]), std::abs(slopes[n - 1])) +
             h * h * std::max(curvatures[n - 1], 0.0);
    if (cluster == n) {
      const Eigen::VectorXd own = numerics::hermitian_eigen(a1).values;
      square = top + h * std::max(own[n - 1], -own[0]) + h * h * std::max(curvatures[n - 1], 0.0);
    }
  }
  square += h * h * h * (cubic + h * quartic);
  bound.upper = std::sqrt(std::max(square, 0.0)) + rest;
  return bound;
}

}  // namespace boresight::control
