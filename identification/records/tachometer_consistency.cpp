#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boresight/identification/records/compared_channel.hpp>
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/identification/records/tachometer_consistency.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;

/// Changes from one block of time to the next, of the motor.
struct MotionChange {
  double encoder = 0.0;         // rad: change of the mean angle times the gear ratio
  double tachometer = 0.0;      // rad: change of the mean of its integral
  double duration = 0.0;        // s
  double torque = 0.0;          // N m
  double rate = 0.0;            // rad/s
  double noise_variance = 0.0;  // rad2, of `tachometer`
};

bool is_compared(const EvaluatedRecord& one) {
  return one.clean->record && one.clean->record->encoder && !one.clean->without_rate &&
         one.clean->record->test != TestKind::slosh;
}

// Samples at which tachometer and, `shift` samples earlier, encoder are what they saw.
std::vector<bool> usable(const DriveRecord& record, Index shift) {
  std::vector<bool> found(static_cast<std::size_t>(record.samples()), false);
  for (Index i = 0; i < record.samples(); ++i) {
    const Index at = i - shift;
    found[static_cast<std::size_t>(i)] =
        at >= 0 && at < record.samples() && record.motor_rate.is_valid(i) &&
        record.encoder->is_valid(at) &&
        std::abs(record.motor_rate.values(i)) < 0.999 * record.motor_rate_limit;
  }
  return found;
}

// Integral of the rate from the first sample to `lead` (s, below a sample interval) beyond each, by
// the trapezoidal rule with its end correction.
Eigen::VectorXd integrated(const Eigen::VectorXd& rate, double step, double lead) {
  const Index count = rate.size();
  Eigen::VectorXd angle(count);
  double sum = 0.0;
  for (Index i = 0; i < count; ++i) {
    if (i > 0) sum += 0.5 * step * (rate(i - 1) + rate(i));
    const Index before = std::max<Index>(i - 1, 0);
    const Index after = std::min(i + 1, count - 1);
    const double slope =
        (rate(after) - rate(before)) / (step * static_cast<double>(after - before));
    angle(i) = sum + lead * rate(i) + (0.5 * lead * lead - step * step / 12.0) * slope;
  }
  return angle;
}

/// `delay`: by how much the tachometer is taken to lag behind the encoder, s.
void add_changes(const DriveRecord& record, const DriveKnowledge& knowledge, double delay,
                 double block, std::vector<MotionChange>& changes) {
  const double step = record.sample_time;
  const auto shift = static_cast<Index>(std::floor(delay / step));
  const double lead = delay - step * static_cast<double>(shift);
  const Index size = std::max<Index>(2, std::lround(block / step));
  const Eigen::VectorXd torque = recorded_torque(record, knowledge);
  const Eigen::VectorXd& rate = record.motor_rate.values;
  const double duration = step * static_cast<double>(size);
  // Neighbouring means of the integral of white noise: half the block each at first order.
  const double noise = std::pow(noise_level(rate) * step, 2) * static_cast<double>(size);
  for (const MotionWindow& stretch : stretches(usable(record, shift))) {
    const Index count = stretch.last - stretch.first + 1;
    if (count < 2 * size) continue;
    const Eigen::VectorXd angle = integrated(rate.segment(stretch.first, count), step, lead);
    const Eigen::VectorXd encoder =
        knowledge.gear_ratio * record.encoder->values.segment(stretch.first - shift, count);
    const auto difference = [&](const auto& series, Index first) {
      return series.segment(first + size, size).mean() - series.segment(first, size).mean();
    };
    for (Index first = 0; first + 2 * size <= count; first += size) {
      MotionChange change;
      change.encoder = difference(encoder, first);
      change.tachometer = difference(angle, first);
      change.duration = duration;
      change.torque = difference(torque.segment(stretch.first - shift, count), first);
      change.rate = difference(rate.segment(stretch.first, count), first);
      change.noise_variance = 2.0 / 3.0 * noise;
      changes.push_back(change);
    }
  }
}

class TachometerComparison {
 public:
  TachometerComparison(const std::vector<EvaluatedRecord>& records, const DriveKnowledge& knowledge,
                       const Instruments& instruments, const ChannelConsistencyOptions& options)
      : records_(records), knowledge_(knowledge), instruments_(instruments), options_(options) {
    for (const EvaluatedRecord& one : records_) {
      if (!is_compared(one)) continue;
      fastest_ = std::max(fastest_, one.clean->record->motor_rate.values.cwiseAbs().maxCoeff());
      longest_step_ = std::max(longest_step_, one.clean->record->sample_time);
    }
  }

  std::vector<ComparedQuantity> fit(const std::vector<std::size_t>& places) const {
    // To first order in the delay: again about what was found.
    constexpr int rounds = 4;
    double shift = 0.0;  // s
    for (int round = 1;; ++round) {
      const auto found = fit_about(places, shift);
      const bool has_delay = found.size() == 3 && std::isfinite(found.back().standard_error);
      if (!has_delay || round == rounds) return found;
      const double next = std::clamp(found.back().value, -largest_delay, largest_delay);
      if (std::abs(next - shift) < 0.01 * longest_step_) return found;
      shift = next;
    }
  }

 private:
  static constexpr double largest_delay = 2.0;  // s

  std::vector<MotionChange> changes_of(const std::vector<std::size_t>& places, double shift,
                                       double block) const {
    std::vector<MotionChange> changes;
    for (const std::size_t place : places) {
      if (!is_compared(records_[place])) continue;
      add_changes(*records_[place].clean->record, knowledge_, shift, block, changes);
    }
    return changes;
  }

  std::vector<ComparedQuantity> fit_about(const std::vector<std::size_t>& places,
                                          double shift) const {
    // One short or mostly clipped record has too few long blocks.
    double block = options_.motion_block;
    auto changes = changes_of(places, shift, block);
    std::vector<Index> groups = row_groups(static_cast<Index>(changes.size()));
    while (groups.empty() && block > options_.shortest_motion_block) {
      block *= 0.5;
      changes = changes_of(places, shift, block);
      groups = row_groups(static_cast<Index>(changes.size()));
    }
    const auto rows = static_cast<Index>(changes.size());
    if (groups.empty()) return {};
    Eigen::MatrixXd regressors(rows, 4);
    Eigen::VectorXd response(rows);
    Eigen::VectorXd noise = Eigen::VectorXd::Zero(4);
    for (Index i = 0; i < rows; ++i) {
      const MotionChange& change = changes[static_cast<std::size_t>(i)];
      regressors.row(i) << change.tachometer, change.duration, change.torque, change.rate;
      response(i) = change.encoder;
      noise(0) += change.noise_variance / static_cast<double>(rows);
    }
    const auto found = numerics::grouped_regression(regressors, response, groups, noise);
    return quantities(found, shift);
  }

  // From d(encoder) = (1/G) d(tachometer) - (zero/G) dt + (delay/G) d(rate).
  std::vector<ComparedQuantity> quantities(const numerics::GroupedRegression& found,
                                           double shifted) const {
    const double slope = found.coefficients(0);
    const auto& covariance = found.covariance;
    const double infinite = std::numeric_limits<double>::infinity();
    const auto quantity = [&](ChannelQuantity which, const char* unit, double value,
                              double variance, Index column) {
      ComparedQuantity one;
      one.quantity = which;
      one.unit = unit;
      one.value = value;
      const bool determined =
          found.determined[0] && slope != 0.0 && found.determined[static_cast<std::size_t>(column)];
      one.standard_error = determined ? std::sqrt(std::max(0.0, variance)) : infinite;
      one.degrees_of_freedom = found.degrees_of_freedom;
      return one;
    };
    // Of a ratio q = sign * coefficient / slope.
    const auto ratio_variance = [&](double value, double sign, Index column) {
      return (covariance(column, column) - 2.0 * sign * value * covariance(0, column) +
              value * value * covariance(0, 0)) /
             (slope * slope);
    };
    const double scale = std::max(1.0, std::abs(1.0 / slope));
    auto gain =
        quantity(ChannelQuantity::gain, "1", 1.0 / slope, covariance(0, 0) / std::pow(slope, 4), 0);
    gain.stated = gain.own_stated = scale * instruments_.tachometer_scale;
    gain.widest = scale * options_.widest_gain;
    const double offset = -found.coefficients(1) / slope;
    auto zero =
        quantity(ChannelQuantity::zero, "rad/s", offset, ratio_variance(offset, -1.0, 1), 1);
    zero.stated = zero.own_stated = options_.tachometer_zero * fastest_;
    zero.widest = options_.widest_zero * fastest_;
    const double lag = found.coefficients(3) / slope;
    auto delay =
        quantity(ChannelQuantity::delay, "s", shifted + lag, ratio_variance(lag, 1.0, 3), 3);
    delay.stated = delay.own_stated = std::hypot(longest_step_, options_.filter_delay);
    delay.widest = options_.widest_delay;
    return {gain, zero, delay};
  }

  const std::vector<EvaluatedRecord>& records_;
  const DriveKnowledge& knowledge_;
  const Instruments& instruments_;
  const ChannelConsistencyOptions& options_;
  double fastest_ = 0.0;       // rad/s
  double longest_step_ = 0.0;  // s
};

}  // namespace

std::vector<ChannelCheck> tachometer_consistency(const std::vector<EvaluatedRecord>& records,
                                                 const DriveKnowledge& knowledge,
                                                 const Instruments& instruments,
                                                 const ChannelConsistencyOptions& options) {
  const auto first = std::ranges::find_if(records, is_compared);
  if (first == records.end() || !(knowledge.gear_ratio > 0.0)) return {};
  ChannelCheck row;
  row.channel = ChannelCheck::Channel::tachometer;
  row.name = first->raw->tachometer.name;
  row.against = "encoder";
  const TachometerComparison comparison(records, knowledge, instruments, options);
  return checked_channel(
      row, records, [&](const std::vector<std::size_t>& places) { return comparison.fit(places); },
      options);
}

}  // namespace boresight::identification
