#include <cmath>

#include <fmt/format.h>

#include <boresight/control/analysis/transmission_zeros.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/orthogonal_reduction.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

struct Pencil {
  MatrixXd a, b, c, d;
};

// Splits off states until D has full row rank; the finite zeros stay.
void make_rows_independent(Pencil& pencil, double tolerance) {
  auto& [a, b, c, d] = pencil;
  while (d.rows() > 0) {
    const auto of_d = plant::compress_rows(d, tolerance);
    const Index rank = of_d.rank, rest = d.rows() - rank;
    if (rest == 0) return;
    d = (of_d.q.transpose() * d).eval().topRows(rank).eval();
    c = (of_d.q.transpose() * c).eval();
    // These outputs have no feedthrough: for them to be 0, so must the states be that they see.
    const auto seen = plant::compress_rows(c.bottomRows(rest).transpose(), tolerance);
    c = c.topRows(rank).eval();
    if (seen.rank == 0) return;
    const Index n = a.rows(), kept = n - seen.rank, m = b.cols();
    a = (seen.q.transpose() * a * seen.q).eval();
    b = (seen.q.transpose() * b).eval();
    c = (c * seen.q).eval();
    MatrixXd outputs(rank + seen.rank, kept), feedthrough(rank + seen.rank, m);
    outputs << c.rightCols(kept), a.topRightCorner(seen.rank, kept);
    feedthrough << d, b.topRows(seen.rank);
    a = a.bottomRightCorner(kept, kept).eval();
    b = b.bottomRows(kept).eval();
    c = outputs;
    d = feedthrough;
  }
}

Pencil transposed(const Pencil& pencil) {
  return {pencil.a.transpose(), pencil.c.transpose(), pencil.b.transpose(), pencil.d.transpose()};
}

}  // namespace

Eigen::VectorXcd transmission_zeros(const plant::StateSpace& system,
                                    const TransmissionZerosOptions& options) {
  if (!(options.tolerance >= 0.0) || !(options.tolerance < 1.0)) {
    throw InvalidInput(fmt::format(
        "transmission_zeros: expected a tolerance between 0 and 1, found {}", options.tolerance));
  }
  const plant::StateSpace even = plant::even_units(system).system;
  Pencil pencil{even.a, even.b, even.c, even.d};
  const double size = std::sqrt(even.a.squaredNorm() + even.b.squaredNorm() + even.c.squaredNorm() +
                                even.d.squaredNorm());
  make_rows_independent(pencil, options.tolerance * size);
  pencil = transposed(pencil);
  make_rows_independent(pencil, options.tolerance * size);
  const auto& [a, b, c, d] = pencil;
  const Index n = a.rows(), rank = d.rows();
  if (n == 0) return {};
  if (rank == 0) return numerics::eigenvalues(a);
  // [C D] W = [R 0]: what is left of [A - s I, B] W in the last n columns.
  MatrixXd outputs(rank, n + rank);
  outputs << c, d;
  const MatrixXd w = plant::compress_rows(outputs.transpose(), 0.0).q.rightCols(n);
  const MatrixXd left = a * w.topRows(n) + b * w.bottomRows(rank);
  const MatrixXd zeros = numerics::linear_solve(w.topRows(n), left, "transmission_zeros");
  const Eigen::VectorXd scale = numerics::balancing_scale(zeros);
  return numerics::eigenvalues(scale.cwiseInverse().asDiagonal() * zeros * scale.asDiagonal());
}

}  // namespace boresight::control
