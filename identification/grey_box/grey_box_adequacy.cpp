#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/identification/grey_box/grey_box_adequacy.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using P = GreyBoxParameters;

constexpr double slow_fraction = 0.05;  // of the largest rate: slower says nothing of a level
constexpr double fewest_seconds = 2.0;
constexpr double saturated = 2.5;  // saturating rates: 92 % of the level

bool enters_inertia_or_stiffness(Index parameter) {
  return parameter != P::valve_gain && parameter != P::supply_torque;
}

}  // namespace

GreyBoxConflict grey_box_conflict(const GreyBoxParameters& parameters, const VectorXd& point,
                                  const std::vector<StatedNumberCheck>& checks) {
  GreyBoxConflict conflict;
  conflict.contradicted = departing_numbers(checks, StatedNumberCheck::contradicted_beyond);
  double entering = 0.0;
  int of_entering = 0;
  for (Index i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters.list()[static_cast<std::size_t>(i)];
    if (!p.from_drawings || !(p.spread > 0.0)) continue;
    const double square = point(i) * point(i);
    conflict.sum += square;
    ++conflict.count;
    if (std::abs(point(i)) > std::abs(conflict.departure)) {
      conflict.departure = point(i);
      conflict.largest = p.name;
    }
    if (!enters_inertia_or_stiffness(i)) continue;
    entering += square;
    ++of_entering;
  }
  constexpr double confidence = 0.999;
  if (conflict.count > 0)
    conflict.limit = numerics::chi_squared_quantile(confidence, conflict.count);
  if (of_entering > 0 && entering > numerics::chi_squared_quantile(confidence, of_entering)) {
    conflict.widening = entering / of_entering;
  }
  for (const auto& one : conflict.contradicted) {
    conflict.widening = std::max(conflict.widening, one.departure * one.departure);
  }
  return conflict;
}

void widen(GreyBoxPosterior& posterior, const GreyBoxParameters& parameters,
           const GreyBoxConflict& conflict) {
  if (!(conflict.widening > 1.0)) return;
  VectorXd factor = VectorXd::Constant(parameters.size(), std::sqrt(conflict.widening));
  for (Index i = 0; i < parameters.size(); ++i) {
    if (parameters.list()[static_cast<std::size_t>(i)].from_drawings) continue;
    const double remaining = std::sqrt(posterior.covariance(i, i));
    factor(i) =
        std::clamp(1.0 / std::max(remaining, std::numeric_limits<double>::min()), 1.0, factor(i));
  }
  posterior.covariance = factor.asDiagonal() * posterior.covariance * factor.asDiagonal();
}

bool GreyBoxMotion::both_ways() const {
  return upward >= fewest_seconds && downward >= fewest_seconds;
}

GreyBoxMotion motion_of(const std::vector<GreyBoxRecord>& records) {
  GreyBoxMotion motion;
  double largest = 0.0;
  for (const auto& record : records) {
    largest = std::max(largest, record.rate.cwiseAbs().maxCoeff());
  }
  for (const auto& record : records) {
    for (Index k = 0; k < record.samples(); ++k) {
      if (!record.rate_counts[static_cast<std::size_t>(k)]) continue;
      const double rate = record.rate(k);
      motion.highest_rate = std::max(motion.highest_rate, std::abs(rate));
      if (rate > slow_fraction * largest) motion.upward += record.sample_time;
      if (rate < -slow_fraction * largest) motion.downward += record.sample_time;
    }
  }
  return motion;
}

void add_unidentifiable_directions(GreyBoxPosterior& posterior, const GreyBoxParameters& parameters,
                                   const GreyBoxMotion& motion) {
  const VectorXd values = parameters.values(posterior.point);
  if (!motion.both_ways()) {
    const double way = motion.upward >= motion.downward ? 1.0 : -1.0;
    posterior.one_way = way * parameters.list()[P::offset_torque].spread;
  }
  // A slope that makes more than the level is no slope above it: the rise itself was fitted.
  const double level = values(P::coulomb_torque) + values(P::saturating_torque);
  if (motion.highest_rate < saturated * values(P::saturating_rate) ||
      values(P::viscous_friction) * motion.highest_rate > level) {
    posterior.unsaturated = parameters.list()[P::saturating_torque].spread;
  }
}

double offset_discrepancy(const GreyBoxObjective& objective, const GreyBoxPosterior& posterior,
                          const std::vector<GreyBoxRecord>& records,
                          const GreyBoxParameters& parameters, double torque_balance,
                          double unknown_torque) {
  // One stretch a channel: longer than any record.
  constexpr double endless = 1e6;
  const VectorXd moves = objective.scores(posterior.point, endless).transpose() *
                         posterior.formal.col(P::offset_torque);
  VectorXd by_record = VectorXd::Zero(static_cast<Index>(records.size()));
  for (std::size_t c = 0; c < objective.channels().size(); ++c) {
    by_record(static_cast<Index>(objective.channels()[c].record)) += moves(static_cast<Index>(c));
  }
  const auto count = static_cast<double>((by_record.array() != 0.0).count());
  const double lasting = count > 1.0 ? by_record.squaredNorm() * count / (count - 1.0) : 0.0;
  const double beyond =
      std::max(0.0, lasting - posterior.covariance(P::offset_torque, P::offset_torque));
  double square = 0.0, samples = 0.0;
  for (const auto& record : records) {
    square += record.torque.squaredNorm();
    samples += static_cast<double>(record.samples());
  }
  const double balance =
      samples > 0.0
          ? torque_balance * std::sqrt(square / samples / static_cast<double>(records.size()))
          : 0.0;
  const double unit = parameters.list()[P::offset_torque].spread;
  return std::hypot(unit * std::sqrt(beyond), balance, unknown_torque);
}

}  // namespace boresight::identification
