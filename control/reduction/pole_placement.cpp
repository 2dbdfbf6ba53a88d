#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/equations/mode_distance.hpp>
#include <boresight/control/reduction/controllability.hpp>
#include <boresight/control/reduction/pole_placement.hpp>
#include <boresight/control/reduction/robust_placement.hpp>
#include <boresight/control/reduction/single_input_placement.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/real_schur.hpp>
#include <boresight/numerics/singular_values.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

// The poles with conjugates next to each other, Im > 0 first, and exactly conjugate.
std::vector<Complex> paired(const std::vector<Complex>& poles) {
  std::vector<Complex> rest = poles;
  std::vector<Complex> result;
  while (!rest.empty()) {
    const Complex pole = rest.front();
    rest.erase(rest.begin());
    if (!std::isfinite(pole.real()) || !std::isfinite(pole.imag())) {
      throw InvalidInput("place_poles: expected finite poles, found one that is not");
    }
    if (pole.imag() == 0.0) {
      result.push_back(pole);
      continue;
    }
    const auto partner = std::find_if(rest.begin(), rest.end(), [&](Complex other) {
      return std::abs(other - std::conj(pole)) <= 1e-12 * std::abs(pole);
    });
    if (partner == rest.end()) {
      throw InvalidInput(fmt::format(
          "place_poles: expected poles in conjugate pairs, found {:.6g} {} {:.6g} j alone",
          pole.real(), pole.imag() < 0.0 ? '-' : '+', std::abs(pole.imag())));
    }
    rest.erase(partner);
    result.emplace_back(pole.real(), std::abs(pole.imag()));
    result.push_back(std::conj(result.back()));
  }
  return result;
}

// Columns of B of length 1, then their independent combinations: B unit = u diag(values) v'.
struct Inputs {
  Eigen::VectorXd unit;
  numerics::SingularValues svd;
  Index count = 0;
};

Inputs independent_inputs(const MatrixXd& b) {
  Inputs inputs;
  inputs.unit = Eigen::VectorXd::Zero(b.cols());
  for (Index j = 0; j < b.cols(); ++j) {
    const double length = b.col(j).stableNorm();
    if (length > 0.0) inputs.unit[j] = 1.0 / length;
  }
  inputs.svd = numerics::singular_values(b * inputs.unit.asDiagonal());
  const auto& values = inputs.svd.values;
  const double rounding = static_cast<double>(b.rows()) * std::numeric_limits<double>::epsilon();
  while (inputs.count < values.size() && values[inputs.count] > rounding * values[0]) {
    ++inputs.count;
  }
  return inputs;
}

void refuse_repeated(const std::vector<Complex>& poles, Index inputs) {
  for (const Complex pole : poles) {
    const auto times = std::count_if(poles.begin(), poles.end(), [&](Complex other) {
      return std::abs(other - pole) <= 1e-12 * std::abs(pole);
    });
    if (times > inputs) {
      throw InvalidInput(
          fmt::format("place_poles: expected no pole more often than there are independent inputs, "
                      "{}, found {} {} times; spread them a little",
                      inputs, describe_eigenvalue(pole), times));
    }
  }
}

// A - U F with the poles on its diagonal: every state has an input of its own.
MatrixXd diagonal_form(const std::vector<Complex>& poles) {
  const auto n = static_cast<Index>(poles.size());
  MatrixXd form = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    const Complex pole = poles[static_cast<std::size_t>(i)];
    form(i, i) = pole.real();
    if (pole.imag() > 0.0) form(i, i + 1) = pole.imag();
    if (pole.imag() < 0.0) form(i, i - 1) = pole.imag();
  }
  return form;
}

// |X| |X^-1| / n of the unit eigenvectors of an upper triangular matrix.
double eigenvector_condition(const MatrixXcd& t) {
  const Index n = t.rows();
  MatrixXcd x = MatrixXcd::Identity(n, n);
  for (Index j = 0; j < n; ++j) {
    x.col(j).head(j) = -t.col(j).head(j);
    for (Index i = j - 1; i >= 0; --i) {
      const Complex gap = t(i, i) - t(j, j);
      if (gap == 0.0 && x(i, j) != 0.0) return std::numeric_limits<double>::infinity();
      if (x(i, j) == 0.0) continue;
      x(i, j) /= gap;
      x.col(j).head(i) -= x(i, j) * t.col(i).head(i);
    }
    x.col(j) /= x.col(j).stableNorm();
  }
  MatrixXcd inverse = MatrixXcd::Identity(n, n);
  x.triangularView<Eigen::Upper>().solveInPlace(inverse);
  const double condition = x.stableNorm() * inverse.stableNorm() / static_cast<double>(n);
  return std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity();
}

// Smallest singular value of closed - p over |closed|, the largest over the poles.
double backward_error(const MatrixXd& closed, const std::vector<Complex>& poles) {
  ModeDistance distance(numerics::real_schur(closed), MatrixXd(closed.rows(), 0), closed.norm(),
                        TimeDomain::continuous);
  double worst = 0.0;
  for (const Complex pole : poles) worst = std::max(worst, distance.test(pole).distance);
  return worst;
}

// Works in states x/scale.
PolePlacement place(const plant::StateSpace& system, const std::vector<Complex>& poles,
                    const Eigen::VectorXd& scale, const PolePlacementOptions& options) {
  const Index n = system.a.rows();
  const MatrixXd a = scale.cwiseInverse().asDiagonal() * system.a * scale.asDiagonal();
  const Inputs inputs = independent_inputs(scale.cwiseInverse().asDiagonal() * system.b);
  const MatrixXd u = inputs.svd.u.leftCols(inputs.count);
  MatrixXd feedback;
  if (inputs.count == 1) {
    feedback = place_with_one_input(a, u, poles);
  } else if (inputs.count == n) {
    feedback = u.transpose() * a - diagonal_form(poles) * u.transpose();
  } else {
    refuse_repeated(poles, inputs.count);
    feedback = place_with_several_inputs(a, u, poles, options.most_sweeps);
  }
  PolePlacement result;
  result.gain = inputs.unit.asDiagonal() * inputs.svd.v.leftCols(inputs.count) *
                inputs.svd.values.head(inputs.count).cwiseInverse().asDiagonal() * feedback *
                scale.cwiseInverse().asDiagonal();
  const MatrixXd closed = a - u * feedback;
  if (!result.gain.allFinite() || !closed.allFinite()) {
    result.backward_error = std::numeric_limits<double>::infinity();
    return result;
  }
  result.eigenvalues = numerics::eigenvalues(closed);
  result.eigenvector_condition =
      eigenvector_condition(numerics::complex_schur(numerics::real_schur(closed)).t);
  result.backward_error = backward_error(closed, poles);
  return result;
}

}  // namespace

PolePlacement place_poles(const plant::StateSpace& system, const std::vector<Complex>& poles,
                          const PolePlacementOptions& options) {
  plant::validate(system);
  const Index n = system.a.rows();
  if (static_cast<Index>(poles.size()) != n) {
    throw InvalidInput(
        fmt::format("place_poles: expected {} poles, one a state, found {}", n, poles.size()));
  }
  const std::vector<Complex> pairs = paired(poles);
  if (n == 0) {
    PolePlacement nothing;
    nothing.gain = MatrixXd::Zero(system.b.cols(), 0);
    return nothing;
  }
  const Access access = controllability(system);
  if (!access.complete()) {
    throw NumericalFailure(
        fmt::format("place_poles: {}; remove those states or add an input", access.description));
  }
  const Eigen::VectorXd scale = numerics::balancing_scale(system.a);
  PolePlacement result = place(system, pairs, scale, options);
  // Scales that far apart may come from a coupling that is a rounding error: only what stands in
  // the states as given, too, is trusted.
  constexpr double usual_spread = 0x1p40;
  if (scale.maxCoeff() > usual_spread * scale.minCoeff()) {
    const auto error_in = [&](const PolePlacement& placed, const Eigen::VectorXd& unit) {
      const MatrixXd closed = unit.cwiseInverse().asDiagonal() *
                              (system.a - system.b * placed.gain) * unit.asDiagonal();
      return closed.allFinite() ? backward_error(closed, pairs)
                                : std::numeric_limits<double>::infinity();
    };
    const Eigen::VectorXd given = Eigen::VectorXd::Ones(n);
    PolePlacement other = place(system, pairs, given, options);
    result.backward_error = std::max(result.backward_error, error_in(result, given));
    other.backward_error = std::max(other.backward_error, error_in(other, scale));
    if (other.backward_error < result.backward_error) result = std::move(other);
  }
  if (!(result.backward_error <= 1e-8)) {
    throw NumericalFailure(fmt::format(
        "place_poles: the poles are reached to {:.1e} of |A - B K| only; the problem is "
        "too badly conditioned, ask for poles nearer to those there are",
        result.backward_error));
  }
  return result;
}

}  // namespace boresight::control
