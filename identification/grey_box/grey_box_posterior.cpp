#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using P = GreyBoxParameters;

double leakage_conductance(const VectorXd& v) {
  return v(P::cross_leakage) + v(P::null_leakage) + 0.5 * v(P::case_leakage);
}

// Moves what is one number for a drive that moves one way from the friction's level to the offset.
void fraction_one_way(double one_way, double normal, DriveEstimate& e) {
  if (one_way == 0.0) return;
  // No friction drives: the level stays above nothing.
  const double moved = std::min(std::abs(one_way) * normal, 0.98 * e.coulomb_level);
  const double left = 1.0 - moved / e.coulomb_level;
  e.offset_as_recorded += std::copysign(1.0, one_way) * moved;
  e.coulomb_level *= left;
  e.friction.coulomb_torque *= left;
  e.friction.breakaway_torque *= left;
  e.friction.saturating_torque *= left;
}

}  // namespace

GreyBoxPosterior grey_box_posterior(const GreyBoxObjective& objective, const VectorXd& point,
                                    const MatrixXd& shifts, double stretch) {
  const Index n = point.size();
  const MatrixXd identity = MatrixXd::Identity(n, n);
  GreyBoxPosterior posterior;
  posterior.point = point;
  MatrixXd information = objective.products(point).topLeftCorner(n, n) + identity;
  information = (0.5 * (information + information.transpose())).eval();
  posterior.formal =
      numerics::positive_definite_solve(information, identity, "grey box information");
  posterior.formal = (0.5 * (posterior.formal + posterior.formal.transpose())).eval();
  const MatrixXd root = numerics::semidefinite_factor(posterior.formal, "grey box covariance");

  // The scores' scatter in directions in which the formal covariance is the identity; each
  // parameter's prior counts as one observation more.
  const MatrixXd scores = root.transpose() * objective.scores(point, stretch);
  MatrixXd scatter = scores * scores.transpose() + root.transpose() * root;
  scatter = (0.5 * (scatter + scatter.transpose())).eval();
  const auto eigen = numerics::hermitian_eigen(scatter.cast<std::complex<double>>());
  const MatrixXd vectors = eigen.vectors.real();
  const VectorXd wider = eigen.values.cwiseMax(1.0);
  posterior.inflation = wider.mean();
  const MatrixXd directions = root * vectors * wider.cwiseSqrt().asDiagonal();
  posterior.covariance = directions * directions.transpose();
  posterior.misfit = MatrixXd::Zero(n, n);
  if (shifts.cols() > 0) {
    posterior.misfit = shifts * shifts.transpose() / static_cast<double>(shifts.cols());
  }
  posterior.covariance += posterior.misfit;
  posterior.covariance = (0.5 * (posterior.covariance + posterior.covariance.transpose())).eval();
  return posterior;
}

DriveEstimate drive_estimate(const GreyBoxParameters& parameters, const VectorXd& point) {
  const VectorXd v = parameters.values(point);
  const Index modes = parameters.mode_count();
  DriveEstimate e;
  const double factor = P::recorded_inertia_factor(v);
  e.motor_inertia = v(P::motor_inertia);
  e.inertia = v(P::motor_inertia) + v(P::gear_inertia) + v(P::antenna_inertia);
  e.inertia_as_recorded = factor * e.inertia;
  e.motor_to_load_ratio = e.motor_inertia / (e.inertia - e.motor_inertia);
  e.oil_stiffness = parameters.oil_stiffness(v);
  e.bulk_modulus = v(P::bulk_modulus);
  const double recorded_stiffness =
      e.oil_stiffness * v(P::pressure_gain) / (v(P::torque_factor) * v(P::tachometer_gain));
  e.leakage_rate = recorded_stiffness * leakage_conductance(v);
  e.offset_as_recorded = v(P::offset_torque);
  // Torque and rate as they are, from what the recorder shows of them.
  const double torque = v(P::torque_factor) / v(P::pressure_gain);
  const double rate = 1.0 / v(P::tachometer_gain);
  e.friction = {
      torque * v(P::coulomb_torque), torque * (v(P::coulomb_torque) + v(P::stribeck_torque)),
      rate * v(P::stribeck_rate),    torque * v(P::saturating_torque),
      rate * v(P::saturating_rate),  torque / rate * v(P::viscous_friction)};
  e.coulomb_level = e.friction.coulomb_torque + e.friction.saturating_torque;
  e.tracking_slope = plant::friction_slope(e.friction, parameters.tracking_rate());
  e.valve_lag = v(P::valve_lag);
  e.bristle_stiffness = torque / rate * v(P::bristle_stiffness);
  e.bristle_damping = torque / rate * v(P::bristle_damping);
  e.mode_damping = v(P::mode_damping);
  e.mode_inertia.resize(modes);
  e.mode_frequency.resize(modes);
  double sum = 1.0;
  for (Index i = 0; i < modes; ++i) sum += v(P::fraction(i));
  e.rigid_inertia = e.inertia;
  for (Index i = 0; i < modes; ++i) {
    e.mode_inertia(i) = v(P::antenna_inertia) * v(P::fraction(i)) / sum;
    e.mode_frequency(i) = v(P::frequency(i));
    e.rigid_inertia -= e.mode_inertia(i);
  }
  e.lowest_frequency = modes > 0 ? e.mode_frequency(0) : 0.0;
  return e;
}

VectorXd log_gradient(const GreyBoxParameters& parameters, const VectorXd& point,
                      double DriveEstimate::*member) {
  constexpr double step = 1e-4;
  VectorXd gradient(point.size());
  for (Index i = 0; i < point.size(); ++i) {
    const VectorXd move = step * VectorXd::Unit(point.size(), i);
    gradient(i) = std::log(drive_estimate(parameters, point + move).*member /
                           (drive_estimate(parameters, point - move).*member)) /
                  (2.0 * step);
  }
  return gradient;
}

std::vector<DriveEstimate> posterior_samples(const GreyBoxParameters& parameters,
                                             const GreyBoxPosterior& posterior, int count,
                                             std::uint64_t seed) {
  const MatrixXd root = numerics::semidefinite_factor(posterior.covariance, "posterior covariance");
  std::vector<DriveEstimate> random_samples;
  random_samples.reserve(static_cast<std::size_t>(count));
  VectorXd normal(root.cols() + (root.cols() % 2));
  for (int i = 0; i < count; ++i) {
    const numerics::NormalNumbers numbers(seed, static_cast<std::uint64_t>(i));
    for (Index k = 0; k < normal.size(); k += 2) {
      const auto pair = numbers.pair(static_cast<std::uint64_t>(k / 2));
      normal(k) = pair.real();
      normal(k + 1) = pair.imag();
    }
    auto e = drive_estimate(parameters, posterior.point + root * normal.head(root.cols()));
    const auto off = numbers.pair(static_cast<std::uint64_t>(root.cols()));
    const auto more = numbers.pair(static_cast<std::uint64_t>(root.cols()) + 1U);
    const double inertia = std::exp(posterior.torque_discrepancy * off.real());
    const double friction = std::exp(posterior.torque_discrepancy * off.imag());
    e.inertia_as_recorded *= inertia;
    e.rigid_inertia *= inertia;
    e.mode_inertia *= inertia;
    e.inertia *= inertia;
    e.motor_to_load_ratio = e.motor_inertia / (e.inertia - e.motor_inertia);
    e.friction.coulomb_torque *= friction;
    e.friction.breakaway_torque *= friction;
    e.friction.saturating_torque *= friction;
    e.friction.viscous_friction *= friction;
    e.coulomb_level *= friction;
    // A frequency scales with the root of a stiffness over an inertia.
    const double frequency = std::exp(0.5 * posterior.torque_discrepancy * more.imag());
    e.mode_frequency *= frequency;
    e.lowest_frequency *= frequency;
    const auto oil = numbers.pair(static_cast<std::uint64_t>(root.cols()) + 2U);
    e.oil_stiffness *= std::exp(posterior.stiffness_discrepancy * oil.real());
    e.leakage_rate *= std::exp(posterior.leakage_discrepancy * more.real());
    const auto valve = numbers.pair(static_cast<std::uint64_t>(root.cols()) + 4U);
    e.valve_lag *= std::exp(posterior.lag_discrepancy * valve.real());
    const auto discrepancies = numbers.pair(static_cast<std::uint64_t>(root.cols()) + 3U);
    e.offset_as_recorded += posterior.offset_discrepancy * oil.imag();
    fraction_one_way(posterior.one_way, discrepancies.real(), e);
    const double saturating = std::exp(posterior.unsaturated * discrepancies.imag());
    e.coulomb_level += (saturating - 1.0) * e.friction.saturating_torque;
    e.friction.saturating_torque *= saturating;
    e.friction.saturating_rate *= saturating;
    e.tracking_slope = plant::friction_slope(e.friction, parameters.tracking_rate());
    random_samples.push_back(std::move(e));
  }
  return random_samples;
}

const std::vector<DriveQuantity>& drive_quantities() {
  static const std::vector<DriveQuantity> quantities{
      {"inertia", "kg m2", &DriveEstimate::inertia},
      {"inertia as recorded", "kg m2", &DriveEstimate::inertia_as_recorded},
      {"motor to load ratio", "", &DriveEstimate::motor_to_load_ratio},
      {"oil stiffness", "N m/rad", &DriveEstimate::oil_stiffness},
      {"bulk modulus", "Pa", &DriveEstimate::bulk_modulus},
      {"leakage rate", "1/s", &DriveEstimate::leakage_rate},
      {"offset torque as recorded", "N m", &DriveEstimate::offset_as_recorded},
      {"Coulomb level", "N m", &DriveEstimate::coulomb_level},
      {"tracking friction slope", "N m s/rad", &DriveEstimate::tracking_slope},
      {"valve lag", "s", &DriveEstimate::valve_lag},
      {"lowest locked-rotor frequency", "Hz", &DriveEstimate::lowest_frequency}};
  return quantities;
}

}  // namespace boresight::identification
