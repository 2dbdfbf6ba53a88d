#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::numerics {
namespace {

using Eigen::Index;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double negligible = std::numeric_limits<double>::min() / epsilon;

struct Rotation {
  double cosine = 1.0;
  double sine = 0.0;
};

// x <- c x + s y, y <- c y - s x, along rows or columns.
template <typename X, typename Y>
void rotate(X x, Y y, const Rotation& rotation) {
  for (Index k = 0; k < x.size(); ++k) {
    const double old = x[k];
    x[k] = rotation.cosine * old + rotation.sine * y[k];
    y[k] = rotation.cosine * y[k] - rotation.sine * old;
  }
}

// The rotation that brings the 2 x 2 block [a b; c d] to standard form, and that form: c = 0, or
// a = d and b c < 0.
Rotation standardise(double& a, double& b, double& c, double& d) {
  if (c == 0.0) return {};
  if (b == 0.0) {
    std::swap(a, d);
    b = -c;
    c = 0.0;
    return {0.0, 1.0};
  }
  if (a == d && std::signbit(b) != std::signbit(c)) return {};

  const double half = 0.5 * (a - d);
  const double larger = std::max(std::abs(b), std::abs(c));
  const double smaller =
      std::min(std::abs(b), std::abs(c)) * (std::signbit(b) == std::signbit(c) ? 1.0 : -1.0);
  const double scale = std::max(std::abs(half), larger);
  const double discriminant = half / scale * half + larger / scale * smaller;
  if (discriminant >= 4.0 * epsilon * scale) {
    // Two distinct real eigenvalues: the first column becomes an eigenvector.
    const double root = half + std::copysign(std::sqrt(scale) * std::sqrt(discriminant), half);
    const double length = std::hypot(c, root);
    a = d + root;
    d -= larger / root * smaller;
    b -= c;
    const Rotation rotation{root / length, c / length};
    c = 0.0;
    return rotation;
  }
  // A pair, or two eigenvalues too close to tell from one: make the diagonal equal.
  const double sum = b + c;
  const double length = std::hypot(sum, a - d);
  Rotation rotation{std::sqrt(0.5 * (1.0 + std::abs(sum) / length)), 0.0};
  rotation.sine = -(half / (length * rotation.cosine)) * std::copysign(1.0, sum);
  const double upper_left = a * rotation.cosine + b * rotation.sine;
  const double upper_right = -a * rotation.sine + b * rotation.cosine;
  const double lower_left = c * rotation.cosine + d * rotation.sine;
  const double lower_right = -c * rotation.sine + d * rotation.cosine;
  b = upper_right * rotation.cosine + lower_right * rotation.sine;
  c = -upper_left * rotation.sine + lower_left * rotation.cosine;
  a = d = 0.5 * ((upper_left * rotation.cosine + lower_left * rotation.sine) +
                 (-upper_right * rotation.sine + lower_right * rotation.cosine));
  if (c == 0.0) return rotation;
  if (b == 0.0) {
    b = -c;
    c = 0.0;
    return {-rotation.sine, rotation.cosine};
  }
  if (std::signbit(b) != std::signbit(c)) return rotation;
  // Equal diagonal, b c > 0: real after all.
  const double root_b = std::sqrt(std::abs(b));
  const double root_c = std::sqrt(std::abs(c));
  const double split = std::copysign(root_b * root_c, c);
  const double norm = std::sqrt(std::abs(b + c));
  a += split;
  d -= split;
  b -= c;
  c = 0.0;
  const Rotation second{root_b / norm, root_c / norm};
  return {rotation.cosine * second.cosine - rotation.sine * second.sine,
          rotation.cosine * second.sine + rotation.sine * second.cosine};
}

// H = I - tau [1 v1 v2]' [1 v1 v2] with H x a multiple of the first unit vector.
struct Reflector {
  double tau = 0.0;
  double v1 = 0.0;
  double v2 = 0.0;
  double image = 0.0;
};

Reflector reflector(double x0, double x1, double x2) {
  const double scale = std::max({std::abs(x0), std::abs(x1), std::abs(x2)});
  if (scale == 0.0 || (x1 == 0.0 && x2 == 0.0)) return {0.0, 0.0, 0.0, x0};
  x0 /= scale;
  x1 /= scale;
  x2 /= scale;
  const double image = -std::copysign(std::sqrt(x0 * x0 + x1 * x1 + x2 * x2), x0);
  const double pivot = 1.0 / (x0 - image);
  return {(image - x0) / image, x1 * pivot, x2 * pivot, image * scale};
}

// Rows k..k+2 of columns `first`.. from the left.
void reflect_rows(Eigen::MatrixXd& t, Index k, Index first, const Reflector& h) {
  const double w0 = h.tau;
  const double w1 = h.tau * h.v1;
  const double w2 = h.tau * h.v2;
  const Index stride = t.rows();
  double* p = t.data() + first * stride + k;
  for (Index j = first; j < t.cols(); ++j, p += stride) {
    const double sum = p[0] + h.v1 * p[1] + h.v2 * p[2];
    p[0] -= w0 * sum;
    p[1] -= w1 * sum;
    p[2] -= w2 * sum;
  }
}

// Columns k..k+2 of the first `rows` rows from the right, four rows at a time: the compiler then
// uses vector instructions.
void reflect_columns(Eigen::MatrixXd& m, Index k, Index rows, const Reflector& h) {
  const double w0 = h.tau;
  const double w1 = h.tau * h.v1;
  const double w2 = h.tau * h.v2;
  double* p0 = m.data() + k * m.rows();
  double* p1 = p0 + m.rows();
  double* p2 = p1 + m.rows();
  Index i = 0;
  for (; i + 4 <= rows; i += 4) {
    Eigen::Map<Eigen::Array4d> c0(p0 + i);
    Eigen::Map<Eigen::Array4d> c1(p1 + i);
    Eigen::Map<Eigen::Array4d> c2(p2 + i);
    const Eigen::Array4d sum = c0 + h.v1 * c1 + h.v2 * c2;
    c0 -= w0 * sum;
    c1 -= w1 * sum;
    c2 -= w2 * sum;
  }
  for (; i < rows; ++i) {
    const double sum = p0[i] + h.v1 * p1[i] + h.v2 * p2[i];
    p0[i] -= w0 * sum;
    p1[i] -= w1 * sum;
    p2[i] -= w2 * sum;
  }
}

// Whether the subdiagonal element (k, k-1) may be set to 0 (Ahues and Tisseur).
bool deflates(const Eigen::MatrixXd& t, Index k) {
  const double subdiagonal = std::abs(t(k, k - 1));
  if (subdiagonal <= negligible) return true;
  double neighbours = std::abs(t(k - 1, k - 1)) + std::abs(t(k, k));
  if (neighbours == 0.0) {
    if (k >= 2) neighbours += std::abs(t(k - 1, k - 2));
    if (k + 1 < t.rows()) neighbours += std::abs(t(k + 1, k));
  }
  if (subdiagonal > epsilon * neighbours) return false;
  const double superdiagonal = std::abs(t(k - 1, k));
  const double upper = std::max(subdiagonal, superdiagonal);
  const double lower = std::min(subdiagonal, superdiagonal);
  const double difference = std::abs(t(k - 1, k - 1) - t(k, k));
  const double larger = std::max(std::abs(t(k, k)), difference);
  const double smaller = std::min(std::abs(t(k, k)), difference);
  const double scale = larger + upper;
  return lower * (upper / scale) <= std::max(negligible, epsilon * (smaller * (larger / scale)));
}

// Sum and product of the two shifts: the eigenvalues of the trailing block, or, where these have
// not brought convergence for long, something else of the same size.
struct Shifts {
  double sum = 0.0;
  double product = 0.0;
};

Shifts shifts(const Eigen::MatrixXd& t, Index low, Index high, int sweep) {
  if (sweep % 20 == 10 || sweep % 20 == 0) {
    const Index at = sweep % 20 == 10 ? high : low + 1;
    double size = std::abs(t(at, at - 1));
    if (high - low >= 2) {
      size += sweep % 20 == 10 ? std::abs(t(high - 1, high - 2)) : std::abs(t(low + 2, low + 1));
    }
    const double centre = 0.75 * size + (sweep % 20 == 10 ? t(high, high) : t(low, low));
    return {2.0 * centre, centre * centre + 0.4375 * size * size};
  }
  const double a = t(high - 1, high - 1);
  const double b = t(high - 1, high);
  const double c = t(high, high - 1);
  const double d = t(high, high);
  const double half = 0.5 * (a - d);
  const double discriminant = half * half + b * c;
  if (discriminant < 0.0) return {a + d, a * d - b * c};
  // Real: the one nearer to the last element, twice.
  const double centre = 0.5 * (a + d);
  const double root = std::sqrt(discriminant);
  const double shift =
      std::abs(centre + root - d) < std::abs(centre - root - d) ? centre + root : centre - root;
  return {2.0 * shift, shift * shift};
}

// First column of (T - s1)(T - s2), up to a factor, for the block that starts at k.
std::array<double, 3> first_column(const Eigen::MatrixXd& t, Index k, const Shifts& s) {
  const double a = t(k, k);
  const double c = t(k + 1, k);
  return {(a * (a - s.sum) + s.product) / c + t(k, k + 1), a + t(k + 1, k + 1) - s.sum,
          t(k + 2, k + 1)};
}

// One double-shift sweep over the unreduced block low..high, of three rows at least.
void sweep_block(Eigen::MatrixXd& t, Eigen::MatrixXd& u, Index low, Index high, const Shifts& s) {
  // Where two consecutive subdiagonal elements are small the bulge may start below `low`.
  Index start = high - 2;
  auto x = first_column(t, start, s);
  for (; start > low; --start, x = first_column(t, start, s)) {
    const double left = std::abs(t(start, start - 1)) * (std::abs(x[1]) + std::abs(x[2]));
    const double right =
        std::abs(x[0]) * (std::abs(t(start - 1, start - 1)) + std::abs(t(start, start)) +
                          std::abs(t(start + 1, start + 1)));
    if (left <= epsilon * right) break;
  }
  for (Index k = start; k < high; ++k) {
    const bool last = k + 1 == high;
    if (k > start) x = {t(k, k - 1), t(k + 1, k - 1), last ? 0.0 : t(k + 2, k - 1)};
    const Reflector h = reflector(x[0], x[1], x[2]);
    if (k > start) {
      t(k, k - 1) = h.image;
      t(k + 1, k - 1) = 0.0;
      if (!last) t(k + 2, k - 1) = 0.0;
    } else if (k > low) {
      t(k, k - 1) *= 1.0 - h.tau;
    }
    if (h.tau == 0.0) continue;
    if (!last) {
      reflect_rows(t, k, k, h);
      reflect_columns(t, k, std::min(k + 4, high + 1), h);
      reflect_columns(u, k, u.rows(), h);
    } else {
      const double w0 = h.tau;
      const double w1 = h.tau * h.v1;
      for (Index j = k; j < t.cols(); ++j) {
        const double sum = t(k, j) + h.v1 * t(k + 1, j);
        t(k, j) -= w0 * sum;
        t(k + 1, j) -= w1 * sum;
      }
      const auto columns = [&](Eigen::MatrixXd& m, Index rows) {
        for (Index i = 0; i < rows; ++i) {
          const double sum = m(i, k) + h.v1 * m(i, k + 1);
          m(i, k) -= w0 * sum;
          m(i, k + 1) -= w1 * sum;
        }
      };
      columns(t, high + 1);
      columns(u, u.rows());
    }
  }
}

// Brings the 2 x 2 block at k to standard form.
void standardise_block(Eigen::MatrixXd& t, Eigen::MatrixXd& u, Index k) {
  const Index n = t.rows();
  double a = t(k, k);
  double b = t(k, k + 1);
  double c = t(k + 1, k);
  double d = t(k + 1, k + 1);
  const Rotation rotation = standardise(a, b, c, d);
  const Index right = n - k - 2;
  rotate(t.row(k).tail(right), t.row(k + 1).tail(right), rotation);
  rotate(t.col(k).head(k), t.col(k + 1).head(k), rotation);
  rotate(u.col(k), u.col(k + 1), rotation);
  t(k, k) = a;
  t(k, k + 1) = b;
  t(k + 1, k) = c;
  t(k + 1, k + 1) = d;
}

void iterate(Eigen::MatrixXd& t, Eigen::MatrixXd& u) {
  // Of many equal eigenvalues far below the norm, rounding keeps the subdiagonal elements above
  // what their neighbours would let pass: after so many sweeps in vain they are measured against
  // the norm, which is as backward stable.
  constexpr int sweeps_in_vain = 30;
  const double rounding = epsilon * t.norm();
  Index high = t.rows() - 1;
  const Index max_sweeps = 30 * std::max<Index>(10, t.rows());
  Index sweeps = 0;
  int since_deflation = 0;
  while (high > 0) {
    Index low = high;
    const double negligible_now = since_deflation > sweeps_in_vain ? rounding : 0.0;
    while (low > 0 && std::abs(t(low, low - 1)) > negligible_now && !deflates(t, low)) --low;
    if (low > 0) t(low, low - 1) = 0.0;
    if (high - low <= 1) {
      if (low < high) standardise_block(t, u, low);
      high = low - 1;
      since_deflation = 0;
      continue;
    }
    if (++sweeps > max_sweeps) {
      throw NumericalFailure(
          fmt::format("real_schur: QR of a {} x {} matrix did not converge within {} sweeps",
                      t.rows(), t.cols(), max_sweeps));
    }
    sweep_block(t, u, low, high, shifts(t, low, high, ++since_deflation));
  }
}

}  // namespace

RealSchur real_schur(const Eigen::MatrixXd& a) {
  if (a.rows() != a.cols()) {
    throw InvalidInput(
        fmt::format("real_schur: expected a square matrix, found {} x {}", a.rows(), a.cols()));
  }
  if (!a.allFinite()) {
    throw InvalidInput("real_schur: the matrix has elements that are not finite");
  }
  const Index n = a.rows();
  if (n < 2) return {a, Eigen::MatrixXd::Identity(n, n)};
  const double largest = a.cwiseAbs().maxCoeff();
  if (largest == 0.0) return {a, Eigen::MatrixXd::Identity(n, n)};
  // To size 1, exactly, so that no product over- or underflows.
  const double scale = std::exp2(std::floor(std::log2(largest)));
  const Eigen::HessenbergDecomposition<Eigen::MatrixXd> hessenberg(a / scale);
  RealSchur schur{hessenberg.matrixH(), hessenberg.matrixQ()};
  iterate(schur.t, schur.u);
  schur.t *= scale;
  return schur;
}

RealSchur transposed(const RealSchur& schur) {
  return {schur.t.transpose().reverse(), schur.u.rowwise().reverse()};
}

Eigen::VectorXcd schur_eigenvalues(const Eigen::MatrixXd& t) {
  Eigen::VectorXcd values(t.rows());
  for (Index k = 0; k < t.rows(); ++k) {
    values[k] = t(k, k);
    if (k + 1 < t.rows() && t(k + 1, k) != 0.0) {
      const double frequency = std::sqrt(std::abs(t(k, k + 1))) * std::sqrt(std::abs(t(k + 1, k)));
      values[k] = {t(k, k), frequency};
      values[k + 1] = {t(k, k), -frequency};
      ++k;
    }
  }
  return values;
}

ComplexSchur complex_schur(const RealSchur& schur) {
  using Complex = std::complex<double>;
  ComplexSchur result{schur.t.cast<Complex>(), schur.u.cast<Complex>()};
  const Index n = schur.t.rows();
  for (Index k = 0; k + 1 < n; ++k) {
    if (schur.t(k + 1, k) == 0.0) continue;
    // Eigenvector [b; j w] of [a b; c a], w = sqrt(-b c): with r = sqrt(|b|), q = sqrt(|c|)
    // proportional to [r; j q sign(b)].
    const double r = std::sqrt(std::abs(schur.t(k, k + 1)));
    const double q = std::sqrt(std::abs(schur.t(k + 1, k)));
    const double length = std::hypot(r, q);
    const double cosine = r / length;
    const Complex sine{0.0, std::copysign(q / length, schur.t(k, k + 1))};
    // Columns of the rotation: [cosine; sine] and [-conj(sine); cosine].
    const auto columns = [&](Eigen::MatrixXcd& m, Index rows) {
      for (Index i = 0; i < rows; ++i) {
        const Complex left = m(i, k);
        const Complex right = m(i, k + 1);
        m(i, k) = cosine * left + sine * right;
        m(i, k + 1) = cosine * right - std::conj(sine) * left;
      }
    };
    columns(result.t, k + 2);
    columns(result.u, n);
    for (Index j = k; j < n; ++j) {
      const Complex upper = result.t(k, j);
      const Complex lower = result.t(k + 1, j);
      result.t(k, j) = cosine * upper + std::conj(sine) * lower;
      result.t(k + 1, j) = cosine * lower - sine * upper;
    }
    const double frequency = r * q;
    result.t(k, k) = {schur.t(k, k), frequency};
    result.t(k + 1, k + 1) = {schur.t(k, k), -frequency};
    result.t(k + 1, k) = 0.0;
  }
  return result;
}

}  // namespace boresight::numerics
