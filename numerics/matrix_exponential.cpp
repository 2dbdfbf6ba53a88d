#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>

namespace boresight::numerics {
namespace {

double one_norm(const Eigen::MatrixXd& matrix) {
  return matrix.size() == 0 ? 0.0 : matrix.cwiseAbs().colwise().sum().maxCoeff();
}

// One diagonal Pade approximant [degree/degree] of exp: good to working precision up to a 1-norm of
// `reach`; `tail` is the leading coefficient of its backward error.
struct Approximant {
  int degree;
  double reach;
  double tail;
};
constexpr std::array<Approximant, 5> approximants{
    {{3, 1.495585217958292e-2, 1.0 / 100800.0},
     {5, 2.539398330063230e-1, 1.0 / 10059033600.0},
     {7, 9.504178996162932e-1, 1.0 / 4.487938430976e15},
     {9, 2.097847961257068, 1.0 / 5.91438478187741184e21},
     {13, 4.25, 1.0 / 1.132507756060211e35}}};

// Squarings that keep rounding in forming the approximant of A harmless, from |A|^(2 degree + 1)
// (Al-Mohy, Higham, eq. 5.5).
int extra_squarings(const Eigen::MatrixXd& a, const Approximant& approximant) {
  const Eigen::MatrixXd magnitude = a.cwiseAbs();
  Eigen::RowVectorXd sums = Eigen::RowVectorXd::Ones(a.rows());
  double logarithm = 0.0;  // of what was divided out, against overflow
  for (int i = 0; i < 2 * approximant.degree + 1; ++i) {
    sums = (sums * magnitude).eval();
    const double largest = sums.maxCoeff();
    if (largest == 0.0) return 0;
    sums /= largest;
    logarithm += std::log2(largest);
  }
  const double excess = std::log2(approximant.tail) + logarithm - std::log2(one_norm(a)) + 53.0;
  return std::max(0, static_cast<int>(std::ceil(excess / (2.0 * approximant.degree))));
}

// The approximant of exp(A) from the even powers A^2, A^4, ... (as many as its degree needs).
Eigen::MatrixXd pade(const Eigen::MatrixXd& a, const std::array<Eigen::MatrixXd, 4>& even,
                     int order) {
  const Eigen::Index n = a.rows();
  // Coefficients of the numerator, 1 for the highest power.
  std::array<double, 14> b{};
  b[static_cast<std::size_t>(order)] = 1.0;
  for (int i = order; i > 0; --i) {
    b[static_cast<std::size_t>(i - 1)] =
        b[static_cast<std::size_t>(i)] * i * (2.0 * order - i + 1.0) / (order - i + 1.0);
  }
  Eigen::MatrixXd odd_part = b[1] * Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd even_part = b[0] * Eigen::MatrixXd::Identity(n, n);
  const std::size_t low = order == 13 ? 3 : static_cast<std::size_t>((order - 1) / 2);
  for (std::size_t i = 0; i < low; ++i) {
    odd_part += b[2 * i + 3] * even[i];
    even_part += b[2 * i + 2] * even[i];
  }
  if (order == 13) {
    odd_part += even[2] * (b[13] * even[2] + b[11] * even[1] + b[9] * even[0]);
    even_part += even[2] * (b[12] * even[2] + b[10] * even[1] + b[8] * even[0]);
  }
  odd_part = (a * odd_part).eval();
  const Eigen::PartialPivLU<Eigen::MatrixXd> denominator(even_part - odd_part);
  return denominator.solve(even_part + odd_part);
}

Eigen::MatrixXd scaled_and_squared(const Eigen::MatrixXd& a) {
  // Powers tell better than the norm how far exp(A) is from its series: a large element off the
  // diagonal of a cascade needs no squarings.
  std::array<Eigen::MatrixXd, 4> even;
  even[0] = a * a;
  even[1] = even[0] * even[0];
  even[2] = even[1] * even[0];
  even[3] = even[1] * even[1];
  const auto root = [](const Eigen::MatrixXd& power, double order) {
    return std::pow(one_norm(power), 1.0 / order);
  };
  const double six = root(even[2], 6.0), eight = root(even[3], 8.0);
  const double by_six = std::max(root(even[1], 4.0), six), by_eight = std::max(six, eight);
  for (const auto& approximant : approximants) {
    if (approximant.degree == 13) break;
    const double size = approximant.degree < 7 ? by_six : by_eight;
    if (size <= approximant.reach && extra_squarings(a, approximant) == 0) {
      return pade(a, even, approximant.degree);
    }
  }
  const Approximant& last = approximants.back();
  const double size = std::min(by_six, std::max(eight, root(even[1] * even[2], 10.0)));
  int squarings = 0;
  if (size > last.reach) squarings = static_cast<int>(std::ceil(std::log2(size / last.reach)));
  squarings += extra_squarings(std::ldexp(1.0, -squarings) * a, last);
  for (std::size_t i = 0; i < even.size(); ++i) {
    even[i] *= std::ldexp(1.0, -squarings * 2 * static_cast<int>(i + 1));
  }
  Eigen::MatrixXd result = pade(std::ldexp(1.0, -squarings) * a, even, last.degree);
  for (int i = 0; i < squarings; ++i) result = (result * result).eval();
  return result;
}

Eigen::MatrixXd finite_exponential(const Eigen::MatrixXd& a) {
  // Beyond this norm the powers of A overflow before exp(A) does anything useful.
  constexpr double largest_norm = 1e30;
  Eigen::MatrixXd result;
  if (one_norm(a) <= largest_norm) result = scaled_and_squared(a);
  if (result.size() == 0 || !result.allFinite()) {
    throw NumericalFailure(fmt::format(
        "matrix_exponential: the exponential of a matrix of norm {:.3g} overflows; take "
        "a shorter time",
        one_norm(a)));
  }
  return result;
}

}  // namespace

Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd& a) {
  const Eigen::VectorXd scale = balancing_scale(a);  // refuses what is not square or not finite
  if (a.size() == 0) return a;
  const Eigen::MatrixXd even = scale.cwiseInverse().asDiagonal() * a * scale.asDiagonal();
  return scale.asDiagonal() * finite_exponential(even) * scale.cwiseInverse().asDiagonal();
}

HeldTransition held_transition(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double t) {
  const Eigen::Index n = a.rows(), m = b.cols();
  if (a.cols() != n || b.rows() != n || !a.allFinite() || !b.allFinite()) {
    throw InvalidInput(
        fmt::format("held_transition: expected a finite square A and a finite B of as many rows, "
                    "found {} x {} and {} x {}",
                    n, a.cols(), b.rows(), m));
  }
  if (!(t >= 0.0) || !std::isfinite(t)) {
    throw InvalidInput(fmt::format("held_transition: expected a time of 0 or more, found {} s", t));
  }
  const Eigen::VectorXd scale = balancing_scale(a);
  const Eigen::MatrixXd even = t * (scale.cwiseInverse().asDiagonal() * a * scale.asDiagonal());
  Eigen::MatrixXd input = t * (scale.cwiseInverse().asDiagonal() * b);
  // The result is linear in each column of B: a column larger than A must not add squarings.
  const double size = std::max(one_norm(even), 1.0);
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const double column = input.col(j).lpNorm<1>();
    if (column > 0.0) unit[j] = std::exp2(std::round(std::log2(column / size)));
    input.col(j) /= unit[j];
  }
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(n + 2 * m, n + 2 * m);
  blocks.topLeftCorner(n, n) = even;
  blocks.block(0, n, n, m) = input;
  blocks.block(n, n + m, m, m).setIdentity();
  if (blocks.size() == 0) return {a, b, b};
  const Eigen::MatrixXd exponential = finite_exponential(blocks);
  return {scale.asDiagonal() * exponential.topLeftCorner(n, n) * scale.cwiseInverse().asDiagonal(),
          scale.asDiagonal() * exponential.block(0, n, n, m) * unit.asDiagonal(),
          scale.asDiagonal() * exponential.block(0, n + m, n, m) * unit.asDiagonal()};
}

}  // namespace boresight::numerics
