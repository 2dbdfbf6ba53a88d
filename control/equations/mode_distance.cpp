#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/equations/mode_distance.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Only the direction of a solution is wanted: it is scaled down before chains of small pivots can
// make it overflow.
constexpr double large = 1e120;

void keep_small(VectorXcd& x, Index i) {
  if (std::abs(x[i].real()) + std::abs(x[i].imag()) > large) x /= large;
}

// R x = x and R^H x = x in place, R upper triangular, up to a factor.
void substitute(const MatrixXcd& r, VectorXcd& x) {
  for (Index i = x.size() - 1; i >= 0; --i) {
    x[i] /= r(i, i);
    keep_small(x, i);
    x.head(i) -= x[i] * r.col(i).head(i);
  }
}

void substitute_adjoint(const MatrixXcd& r, VectorXcd& x) {
  for (Index i = 0; i < x.size(); ++i) {
    x[i] = (x[i] - r.col(i).head(i).dot(x.head(i))) / std::conj(r(i, i));
    keep_small(x, i);
  }
}

}  // namespace

ModeDistance::ModeDistance(const numerics::RealSchur& schur, const Eigen::MatrixXd& b, double norm,
                           TimeDomain domain)
    : schur_(numerics::complex_schur(schur)),
      b_(schur_.u.adjoint() * b),
      norm_(norm > 0.0 ? norm : 1.0),
      domain_(domain) {
  for (Index j = 0; j < b_.cols(); ++j) {
    const double length = b_.col(j).stableNorm();
    if (length > 0.0) b_.col(j) *= norm_ / length;
  }
}

bool ModeDistance::stable(Complex eigenvalue) const {
  const double rounding = 10.0 * static_cast<double>(b_.rows()) * epsilon;
  if (domain_ == TimeDomain::continuous) return eigenvalue.real() < -rounding * norm_;
  return std::abs(eigenvalue) < 1.0 - rounding;
}

// Rotates B away with a reflection of one column of T - s and all of B for each row, from the last:
// what is left of T - s is upper triangular still and has the singular values of [T - s, B].
void ModeDistance::triangularise(Complex s) {
  const Index n = b_.rows();
  const Index inputs = b_.cols();
  triangle_ = schur_.t;
  triangle_.diagonal().array() -= s;
  rest_ = b_;
  VectorXcd sum(n);
  for (Index i = n - 1; i >= 0; --i) {
    const double tail = rest_.row(i).squaredNorm();
    if (tail == 0.0) continue;
    // Row [x, y] (I - tau v^H v) = [image, 0] with v = [1, y/(x - image)].
    const Complex x = triangle_(i, i);
    const double length = std::sqrt(std::norm(x) + tail);
    const Complex image = x == 0.0 ? Complex{-length} : -x / std::abs(x) * length;
    const Complex pivot = x - image;
    const double tau = 2.0 / (1.0 + tail / std::norm(pivot));
    const Eigen::RowVectorXcd v = rest_.row(i) / pivot;
    const Index rows = i + 1;
    sum.head(rows) = triangle_.col(i).head(rows);
    for (Index j = 0; j < inputs; ++j) sum.head(rows) += std::conj(v[j]) * rest_.col(j).head(rows);
    sum.head(rows) *= tau;
    triangle_.col(i).head(rows) -= sum.head(rows);
    for (Index j = 0; j < inputs; ++j) rest_.col(j).head(rows) -= v[j] * sum.head(rows);
  }
}

ModeDistance::Mode ModeDistance::test(Complex s) {
  triangularise(s);
  const Index n = b_.rows();
  // Inverse iteration on R R^H; a pivot below rounding is as good as one of that size.
  const double smallest_pivot = epsilon * norm_;
  for (Index i = 0; i < n; ++i) {
    if (std::abs(triangle_(i, i)) < smallest_pivot) triangle_(i, i) = smallest_pivot;
  }
  VectorXcd w = VectorXcd::Constant(n, 1.0 / std::sqrt(static_cast<double>(n)));
  VectorXcd image(n);
  double distance = std::numeric_limits<double>::infinity();
  constexpr int max_steps = 8;
  for (int step = 0; step < max_steps; ++step) {
    substitute(triangle_, w);
    w /= w.stableNorm();
    substitute_adjoint(triangle_, w);
    w /= w.stableNorm();
    image.noalias() = triangle_.adjoint().triangularView<Eigen::Lower>() * w;
    const double length = image.stableNorm();
    const bool settled = length > 0.99 * distance;
    distance = std::min(distance, length);
    if (settled) break;
  }
  return {s, distance / norm_};
}

ModeDistance::Mode ModeDistance::test_with_neighbours(Complex s, double tolerance) {
  Mode mode = test(s);
  if (mode.distance <= tolerance) return mode;
  Index members = 1;
  for (const double radius : {1e-8, 1e-6, 1e-4, 1e-3}) {
    Complex sum = 0.0;
    Index count = 0;
    for (const Complex other : schur_.t.diagonal()) {
      if (std::abs(other - s) > radius * norm_) continue;
      sum += other;
      ++count;
    }
    if (count == members) continue;
    members = count;
    Mode mean = test(sum / static_cast<double>(count));
    if (mean.distance <= tolerance) return mean;
  }
  return mode;
}

std::vector<ModeDistance::Mode> ModeDistance::unreached_unstable(double tolerance) {
  std::vector<Mode> found;
  for (const Complex eigenvalue : schur_.t.diagonal()) {
    // A cluster of eigenvalues around the boundary has members on its far side.
    if (eigenvalue.imag() < 0.0 || stable(eigenvalue)) continue;
    const Mode mode = test_with_neighbours(eigenvalue, tolerance);
    if (mode.distance <= tolerance && !stable(mode.eigenvalue)) found.push_back(mode);
  }
  return found;
}

std::vector<ModeDistance::Mode> confirm_unreached(std::vector<ModeDistance::Mode> modes,
                                                  const Eigen::MatrixXd& a,
                                                  const Eigen::MatrixXd& b, TimeDomain domain,
                                                  double tolerance) {
  if (modes.empty()) return modes;
  ModeDistance as_given(numerics::real_schur(a), b, a.norm(), domain);
  std::erase_if(modes, [&](const ModeDistance::Mode& mode) {
    return as_given.test(mode.eigenvalue).distance > tolerance;
  });
  return modes;
}

std::string describe_eigenvalue(Complex eigenvalue) {
  if (eigenvalue.imag() == 0.0) return fmt::format("{:.6g}", eigenvalue.real());
  return fmt::format("{:.6g} +- {:.6g} j", eigenvalue.real(), std::abs(eigenvalue.imag()));
}

}  // namespace boresight::control
