#include <boresight/control/equations/lyapunov_factor.hpp>
#include <boresight/control/reduction/gramians.hpp>
#include <boresight/numerics/singular_values.hpp>
#include <boresight/plant/linear/orthogonal_reduction.hpp>

namespace boresight::control {
namespace {

using Eigen::MatrixXd;

MatrixXd factor(const char* function, const plant::StateSpace& system, bool observability) {
  plant::validate(system);
  if (system.states.empty()) return MatrixXd(0, 0);
  const TimeDomain domain = system.sample_time > 0.0 ? TimeDomain::sampled : TimeDomain::continuous;
  const Eigen::VectorXd unit = plant::even_units(system).state_unit;
  if (!observability) {
    return real_lyapunov_factor(lyapunov_factor(function, system.a, system.b, unit, domain));
  }
  const MatrixXd a = system.a.transpose();
  const MatrixXd c = system.c.transpose();
  return real_lyapunov_factor(lyapunov_factor(function, a, c, unit.cwiseInverse(), domain));
}

MatrixXd square(const MatrixXd& factor) {
  const MatrixXd gramian = factor * factor.transpose();
  return 0.5 * (gramian + gramian.transpose());
}

}  // namespace

GramianFactors gramian_factors(const plant::StateSpace& system) {
  return {factor("gramian_factors", system, false), factor("gramian_factors", system, true)};
}

MatrixXd controllability_gramian(const plant::StateSpace& system) {
  return square(factor("controllability_gramian", system, false));
}

MatrixXd observability_gramian(const plant::StateSpace& system) {
  return square(factor("observability_gramian", system, true));
}

Eigen::VectorXd hankel_singular_values(const plant::StateSpace& system) {
  const MatrixXd controllability = factor("hankel_singular_values", system, false);
  const MatrixXd observability = factor("hankel_singular_values", system, true);
  return numerics::singular_values(observability.transpose() * controllability).values;
}

}  // namespace boresight::control
