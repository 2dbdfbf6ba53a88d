#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/equations/lyapunov_factor.hpp>
#include <boresight/control/equations/stability_margin.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/ordered_schur.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>
#include <boresight/plant/linear/orthogonal_reduction.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr const char* feedthrough_reason =
    "direct feedthrough: white noise passes with infinite variance; let the input act through a "
    "filter, or sample the system";

TimeDomain domain_of(const plant::StateSpace& system) {
  return system.sample_time > 0.0 ? TimeDomain::sampled : TimeDomain::continuous;
}

// A system in the coordinates of the complex Schur form of A, from states in even units.
struct TriangularSystem {
  numerics::ComplexSchur schur;
  MatrixXcd b, c;
  TimeDomain domain = TimeDomain::continuous;
  StabilityMargin margin;
};

TriangularSystem triangular(const plant::StateSpace& system) {
  const Eigen::VectorXd unit = plant::even_units(system).state_unit;
  const Eigen::VectorXd inverse = unit.cwiseInverse();
  const MatrixXd a = inverse.asDiagonal() * system.a * unit.asDiagonal();
  const MatrixXd b = inverse.asDiagonal() * system.b;
  const MatrixXd c = system.c * unit.asDiagonal();
  TriangularSystem result;
  result.domain = domain_of(system);
  const numerics::RealSchur real = numerics::real_schur(a);
  result.margin = stability_margin(real.t, a.norm(), result.domain);
  result.schur = numerics::complex_schur(real);
  result.b = result.schur.u.adjoint() * b;
  result.c = c * result.schur.u;
  return result;
}

double state_norm(const MatrixXcd& t, const MatrixXcd& b, const MatrixXcd& c, TimeDomain domain) {
  return (c * triangular_lyapunov_factor(t, b, domain).triangularView<Eigen::Upper>()).stableNorm();
}

// Stable and antistable part, each with its own norm; the antistable one runs backwards in time.
double two_sided_norm(const TriangularSystem& system, const MatrixXd& d) {
  const auto& t = system.schur.t;
  const bool continuous = system.domain == TimeDomain::continuous;
  const Index n = t.rows();
  // The output coordinates must follow the rotations: order with U = I first.
  numerics::ComplexSchur ordered{t, MatrixXcd::Identity(n, n)};
  const Index stable = numerics::order_schur(ordered, [&](Complex eigenvalue) {
    return continuous ? eigenvalue.real() < 0.0 : std::abs(eigenvalue) < 1.0;
  });
  const Index other = n - stable;
  const MatrixXcd coupling = numerics::decoupling(ordered.t, stable);
  MatrixXcd b = ordered.u.adjoint() * system.b;
  MatrixXcd c = system.c * ordered.u;
  b.topRows(stable) -= coupling * b.bottomRows(other);
  c.rightCols(other) += c.leftCols(stable) * coupling;
  const MatrixXcd stable_t = ordered.t.topLeftCorner(stable, stable);
  MatrixXcd other_t = ordered.t.bottomRightCorner(other, other);
  MatrixXcd other_b = b.bottomRows(other);
  const double forward = state_norm(stable_t, b.topRows(stable), c.leftCols(stable), system.domain);
  if (continuous) {
    other_t = -other_t;
    return std::hypot(forward, state_norm(other_t, other_b, c.rightCols(other), system.domain));
  }
  if (other == 0) return std::hypot(forward, d.stableNorm());
  // C (z - A)^-1 B = -(C A^-1 B + z C A^-2 B + ...) outside: the first term joins D.
  other_t.triangularView<Eigen::Upper>().solveInPlace(other_b);
  const MatrixXcd direct = d - c.rightCols(other) * other_b;
  MatrixXcd inverse = MatrixXcd::Identity(other, other);
  other_t.triangularView<Eigen::Upper>().solveInPlace(inverse);
  other_b = inverse.triangularView<Eigen::Upper>() * other_b;
  return std::hypot(forward, direct.stableNorm(),
                    state_norm(inverse, other_b, c.rightCols(other), system.domain));
}

// How far from the stability boundary the nearest eigenvalue is, on either side.
double distance_to_axis(const TriangularSystem& system) {
  const auto eigenvalues = system.schur.t.diagonal();
  if (system.domain == TimeDomain::continuous) return eigenvalues.real().cwiseAbs().minCoeff();
  return (eigenvalues.cwiseAbs().array() - 1.0).abs().minCoeff();
}

}  // namespace

H2Norm h2_norm(const plant::StateSpace& system) {
  plant::validate(system);
  if (system.a.size() > 0) {
    const TriangularSystem t = triangular(system);
    if (!t.margin.stable()) {
      return {infinity, "not stable: " + describe_instability(t.margin, t.domain), t.margin.value};
    }
    if (t.domain == TimeDomain::sampled || system.d.isZero(0.0)) {
      return {std::hypot(state_norm(t.schur.t, t.b, t.c, t.domain), system.d.stableNorm()),
              {},
              t.margin.value};
    }
    return {infinity, feedthrough_reason, t.margin.value};
  }
  if (domain_of(system) == TimeDomain::sampled || system.d.isZero(0.0)) {
    return {system.d.stableNorm(), {}, infinity};
  }
  return {infinity, feedthrough_reason, infinity};
}

H2Norm l2_norm(const plant::StateSpace& system) {
  plant::validate(system);
  const bool continuous = domain_of(system) == TimeDomain::continuous;
  if (continuous && !system.d.isZero(0.0)) {
    return {infinity, feedthrough_reason, h2_norm(system).stability_margin};
  }
  if (system.a.size() == 0) return h2_norm(system);
  const TriangularSystem t = triangular(system);
  const double distance = distance_to_axis(t);
  if (!(distance > t.margin.rounding)) {
    return {infinity,
            fmt::format("an eigenvalue of A lies on the {}, to {:.1g}",
                        continuous ? "imaginary axis" : "unit circle", t.margin.rounding),
            t.margin.value};
  }
  return {two_sided_norm(t, system.d), {}, t.margin.value};
}

OutputCovariance output_covariance(const plant::StateSpace& system, const MatrixXd& intensity) {
  plant::validate(system);
  const Index inputs = system.b.cols();
  if (intensity.rows() != inputs || intensity.cols() != inputs) {
    throw InvalidInput(
        fmt::format("output_covariance: expected W as {} x {}, one row an input, found {} x {}",
                    inputs, inputs, intensity.rows(), intensity.cols()));
  }
  const MatrixXd root = numerics::semidefinite_factor(intensity, "output_covariance: W");
  const bool continuous = domain_of(system) == TimeDomain::continuous;
  const Index outputs = system.c.rows();
  OutputCovariance result{MatrixXd::Zero(outputs, outputs), {}};
  if (system.a.size() > 0) {
    const TriangularSystem t = triangular(system);
    if (!t.margin.stable()) {
      result.covariance.setConstant(infinity);
      result.reason = "not stable: " + describe_instability(t.margin, t.domain);
      return result;
    }
    const MatrixXcd factor =
        triangular_lyapunov_factor(t.schur.t, t.b * root, t.domain).triangularView<Eigen::Upper>();
    const MatrixXcd seen = t.c * factor;
    result.covariance = (seen * seen.adjoint()).real();
  }
  const MatrixXd direct = system.d * intensity * system.d.transpose();
  if (!continuous) {
    result.covariance += direct;
  } else if (!system.d.isZero(0.0)) {
    for (Index i = 0; i < outputs; ++i) {
      for (Index j = 0; j < outputs; ++j) {
        const double rounding = 1e-14 * std::sqrt(direct(i, i)) * std::sqrt(direct(j, j));
        if (!(std::abs(direct(i, j)) > rounding)) continue;
        result.covariance(i, j) = std::copysign(infinity, direct(i, j));
        result.reason = feedthrough_reason;
      }
    }
  }
  result.covariance = 0.5 * (result.covariance + result.covariance.transpose()).eval();
  return result;
}

}  // namespace boresight::control
