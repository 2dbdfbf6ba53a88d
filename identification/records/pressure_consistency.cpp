#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <boresight/identification/records/channel_defects.hpp>
#include <boresight/identification/records/compared_channel.hpp>
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/identification/records/pressure_consistency.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;
using Channel = ChannelCheck::Channel;
using Motors = std::set<std::size_t>;

constexpr double gravity = 9.80665;  // m/s2
constexpr double not_recorded = std::numeric_limits<double>::quiet_NaN();

/// Means of one record over blocks of time; NaN throughout for a channel that is mostly missing.
struct BlockMeans {
  std::vector<Eigen::VectorXd> channels;  // one a motor
  Eigen::VectorXd rate;                   // rad/s
  Eigen::VectorXd acceleration;           // rad/s2
  Eigen::VectorXd noise_variance;         // of a channel's mean, by the samples' noise
};

bool is_present(const Eigen::VectorXd& values, Index samples) {
  return values.size() == samples && 2 * values.array().isFinite().count() >= samples;
}

double sample_time(const Eigen::VectorXd& time) {
  std::vector<double> steps;
  for (Index i = 1; i < time.size(); ++i) {
    const double step = time(i) - time(i - 1);
    if (step > 0.0) steps.push_back(step);
  }
  return steps.empty() ? 0.0 : numerics::median(std::move(steps));
}

double noise_of(const Eigen::VectorXd& values) {
  Eigen::VectorXd finite(values.size());
  Index count = 0;
  for (const double value : values) {
    if (std::isfinite(value)) finite(count++) = value;
  }
  return noise_level(finite.head(count));
}

// `channels`: one a motor, of the record's rows.
BlockMeans block_means(const RawRecord& raw, const std::vector<Eigen::VectorXd>& channels,
                       double block) {
  const Index samples = raw.time.size();
  BlockMeans means;
  const double step = sample_time(raw.time);
  const Index size = step > 0.0 ? std::max<Index>(1, std::lround(block / step)) : samples;
  const Index count = size > 0 ? samples / size : 0;
  std::vector<bool> present;
  for (const auto& channel : channels) {
    present.push_back(is_present(channel, samples));
    means.channels.emplace_back(Eigen::VectorXd::Constant(count, not_recorded));
  }
  means.rate = Eigen::VectorXd::Zero(count);
  means.acceleration = Eigen::VectorXd::Zero(count);
  means.noise_variance.resize(static_cast<Index>(channels.size()));
  for (std::size_t k = 0; k < channels.size(); ++k) {
    means.noise_variance(static_cast<Index>(k)) =
        present[k] ? std::pow(noise_of(channels[k]), 2) / static_cast<double>(size) : 0.0;
  }
  const bool has_rate = raw.tachometer.values.size() == samples;
  for (Index b = 0; b < count; ++b) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Index>(channels.size()));
    double rate = 0.0, moment = 0.0, spread = 0.0, rates = 0.0;
    const double centre = static_cast<double>(b * size) + 0.5 * static_cast<double>(size - 1);
    Index taken = 0;
    for (Index i = b * size; i < (b + 1) * size; ++i) {
      if (has_rate && std::isfinite(raw.tachometer.values(i))) {
        const double place = static_cast<double>(i) - centre;
        rate += raw.tachometer.values(i);
        moment += place * raw.tachometer.values(i);
        spread += place * place;
        rates += 1.0;
      }
      const auto is_missing = [&](std::size_t k) {
        return present[k] && !std::isfinite(channels[k](i));
      };
      bool all = true;
      for (std::size_t k = 0; k < channels.size() && all; ++k) all = !is_missing(k);
      if (!all) continue;
      ++taken;
      for (std::size_t k = 0; k < channels.size(); ++k) {
        if (present[k]) sums(static_cast<Index>(k)) += channels[k](i);
      }
    }
    if (rates > 0.0) means.rate(b) = rate / rates;
    if (spread > 0.0) means.acceleration(b) = moment / spread / step;
    if (2 * taken < size) continue;
    for (std::size_t k = 0; k < channels.size(); ++k) {
      if (present[k])
        means.channels[k](b) = sums(static_cast<Index>(k)) / static_cast<double>(taken);
    }
  }
  return means;
}

/// What instruments and differences between motors allow, of one channel.
struct Allowance {
  double gain = 0.0;
  double zero = 0.0;
  double height = 0.0;  // of the zero, a real difference
  double widest_zero = 0.0;
};

/// Channels of one kind, one a motor, that should show the same.
class Siblings {
 public:
  Siblings(std::vector<BlockMeans> records, std::string unit, const Allowance& allowance,
           const ChannelConsistencyOptions& options)
      : records_(std::move(records)),
        unit_(std::move(unit)),
        allowance_(allowance),
        options_(options) {}

  /// The motors to compare with: those that agree in all records and, in each record, are not far
  /// off in that one. Records with other references than the rest have other gains and zeros, so
  /// that a motor is not left out of one record lightly.
  void find_references(const Motors& motors) {
    references_.assign(records_.size(), motors);
    for (std::size_t place = 0; place < records_.size(); ++place) {
      references_[place] = agreeing(motors, {place}, 3.0 * options_.suspect_beyond);
    }
    std::vector<std::size_t> all(records_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    everywhere_ = agreeing(motors, all, options_.suspect_beyond);
  }
  const Motors& agreeing_everywhere() const { return everywhere_; }

  /// A motor's channel against the mean of the references.
  std::vector<ComparedQuantity> compare(std::size_t motor,
                                        const std::vector<std::size_t>& places) const {
    return compare(motor, everywhere_, places);
  }

 private:
  // Leaves out the furthest off until the others agree or two are left.
  Motors agreeing(Motors motors, const std::vector<std::size_t>& places, double limit) const {
    while (motors.size() > 2) {
      double furthest = limit;
      std::optional<std::size_t> suspect;
      for (const std::size_t motor : motors) {
        for (const ComparedQuantity& one : compare(motor, motors, places)) {
          const double departure = one.departure(options_.suspect_beyond);
          if (!(departure > furthest)) continue;
          furthest = departure;
          suspect = motor;
        }
      }
      if (!suspect) break;
      motors.erase(*suspect);
    }
    return motors;
  }

  std::vector<ComparedQuantity> compare(std::size_t motor, const Motors& reference,
                                        const std::vector<std::size_t>& places) const {
    std::vector<double> own, others, rates, accelerations;
    double noise = 0.0;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const std::size_t place : places) {
      const BlockMeans& means = records_[place];
      Motors present;
      double variance = 0.0;
      for (const std::size_t other : reference) {
        if (other == motor || !references_[place].contains(other)) continue;
        if (!means.channels[other].array().isFinite().any()) continue;
        present.insert(other);
        variance += means.noise_variance(static_cast<Index>(other));
      }
      if (present.empty()) continue;
      const auto count = static_cast<double>(present.size());
      const std::size_t rows_before = own.size();
      for (Index b = 0; b < means.rate.size(); ++b) {
        double sum = 0.0;
        for (const std::size_t other : present) sum += means.channels[other](b);
        if (!std::isfinite(sum) || !std::isfinite(means.channels[motor](b))) continue;
        own.push_back(means.channels[motor](b));
        others.push_back(sum / count);
        rates.push_back(means.rate(b));
        accelerations.push_back(means.acceleration(b));
      }
      if (own.size() == rows_before) continue;
      noise += static_cast<double>(own.size() - rows_before) * variance / (count * count);
      fewest = std::min(fewest, present.size());
    }
    return regress(own, others, rates, accelerations, noise, fewest);
  }

  std::vector<ComparedQuantity> regress(const std::vector<double>& own,
                                        const std::vector<double>& others,
                                        const std::vector<double>& rates,
                                        const std::vector<double>& accelerations, double noise,
                                        std::size_t references) const {
    const auto rows = static_cast<Index>(own.size());
    const std::vector<Index> groups = row_groups(rows);
    if (groups.empty()) return {};
    const auto series = [rows](const std::vector<double>& values) {
      return Eigen::Map<const Eigen::VectorXd>(values.data(), rows);
    };
    Eigen::MatrixXd regressors(rows, 5);
    regressors.col(0) = series(others);
    regressors.col(1).setOnes();
    regressors.col(2) = series(rates);
    regressors.col(3) = series(rates).cwiseProduct(series(rates).cwiseAbs());
    regressors.col(4) = series(accelerations);
    Eigen::VectorXd noise_variance = Eigen::VectorXd::Zero(5);
    noise_variance(0) = noise / static_cast<double>(rows);
    const auto found =
        numerics::grouped_regression(regressors, series(own), groups, noise_variance);
    const double both = std::sqrt(1.0 + 1.0 / static_cast<double>(references));
    const double scale = std::max(1.0, std::abs(found.coefficients(0)));
    const auto quantity = [&](ChannelQuantity which, Index column, double allowed, double real) {
      ComparedQuantity one;
      one.quantity = which;
      one.unit = which == ChannelQuantity::gain ? "1" : unit_;
      one.value = found.coefficients(column);
      one.standard_error = found.determined[static_cast<std::size_t>(column)]
                               ? std::hypot(std::sqrt(found.covariance(column, column)), real)
                               : std::numeric_limits<double>::infinity();
      one.degrees_of_freedom = found.degrees_of_freedom;
      one.own_stated = scale * allowed;
      one.stated = both * scale * allowed;
      one.widest =
          scale * (which == ChannelQuantity::gain ? options_.widest_gain : allowance_.widest_zero);
      return one;
    };
    return {quantity(ChannelQuantity::gain, 0, allowance_.gain, 0.0),
            quantity(ChannelQuantity::zero, 1, allowance_.zero, allowance_.height)};
  }

  std::vector<BlockMeans> records_;
  std::vector<Motors> references_;  // one a record
  Motors everywhere_;
  std::string unit_;
  Allowance allowance_;
  const ChannelConsistencyOptions& options_;
};

// Whether a motor's own values are used in one of the records.
bool is_used(const std::vector<EvaluatedRecord>& records, Channel channel, std::size_t motor,
             const std::string& record) {
  const auto replaced = [motor](const std::vector<std::size_t>& motors) {
    return std::ranges::find(motors, motor) != motors.end();
  };
  return std::ranges::any_of(records, [&](const EvaluatedRecord& one) {
    if (!one.clean->record || (!record.empty() && one.raw->name != record)) return false;
    const bool inlet = replaced(one.clean->replaced_inlets);
    const bool outlet = replaced(one.clean->replaced_outlets);
    return !(channel == Channel::inlet    ? inlet
             : channel == Channel::outlet ? outlet
                                          : inlet || outlet);
  });
}

// Ports of a motor that are suspect in all records.
std::ptrdiff_t suspect_ports(const std::vector<ChannelCheck>& rows, std::size_t motor) {
  std::set<Channel> ports;
  for (const ChannelCheck& one : rows) {
    const bool port = one.channel == Channel::inlet || one.channel == Channel::outlet;
    if (port && one.motor == motor && one.record.empty() &&
        one.verdict == ChannelVerdict::suspect) {
      ports.insert(one.channel);
    }
  }
  return std::ssize(ports);
}

Eigen::VectorXd channel_values(const RawRecord& raw, Channel channel, std::size_t motor,
                               double torque_per_pressure) {
  const Eigen::VectorXd& inlet = raw.inlet[motor].values;
  const Eigen::VectorXd& outlet = raw.outlet[motor].values;
  if (channel == Channel::inlet) return inlet;
  if (channel == Channel::outlet) return outlet;
  if (inlet.size() != outlet.size()) return {};
  return torque_per_pressure * (inlet - outlet);
}

std::string name_of(const RawRecord& raw, Channel channel, std::size_t motor) {
  if (channel == Channel::inlet) return raw.inlet[motor].name;
  if (channel == Channel::outlet) return raw.outlet[motor].name;
  return fmt::format("{} - {}", raw.inlet[motor].name, raw.outlet[motor].name);
}

}  // namespace

std::vector<ChannelCheck> pressure_consistency(const std::vector<EvaluatedRecord>& records,
                                               const DriveKnowledge& knowledge,
                                               const Instruments& instruments,
                                               const ChannelConsistencyOptions& options) {
  std::vector<EvaluatedRecord> moving;
  std::size_t motors = std::numeric_limits<std::size_t>::max();
  for (const EvaluatedRecord& one : records) {
    if (one.raw->test == TestKind::slosh) continue;
    moving.push_back(one);
    motors = std::min({motors, one.raw->inlet.size(), one.raw->outlet.size()});
  }
  std::vector<ChannelCheck> rows;
  if (moving.empty() || motors < 2) return rows;
  const double per_pressure = torque_per_pressure(knowledge);
  const double height = knowledge.oil_density.value * gravity * options.height;
  const double widest_zero = options.widest_zero * knowledge.supply_pressure;
  Motors all;
  for (std::size_t motor = 0; motor < motors; ++motor) all.insert(motor);
  Motors trusted = all;  // of both ports
  for (const Channel channel : {Channel::inlet, Channel::outlet, Channel::torque}) {
    const bool torque = channel == Channel::torque;
    std::vector<BlockMeans> means;
    double level = 0.0;  // Pa, the highest record's
    for (const EvaluatedRecord& one : moving) {
      std::vector<Eigen::VectorXd> channels;
      for (std::size_t motor = 0; motor < motors; ++motor) {
        channels.push_back(channel_values(*one.raw, channel, motor, per_pressure));
      }
      means.push_back(block_means(*one.raw, channels, options.pressure_block));
      std::vector<double> pressures;
      for (const auto& inlet : one.raw->inlet) {
        pressures.push_back(std::abs(finite_median(inlet.values)));
      }
      level = std::max(level, numerics::median(std::move(pressures)));
    }
    Allowance allowance{instruments.pressure_gain, instruments.pressure_zero, height, widest_zero};
    if (torque) {
      // Gains that differ between the two ports make an offset of the pressure they share.
      const double zero = std::numbers::sqrt2 *
                          std::hypot(instruments.pressure_zero, instruments.pressure_gain * level);
      allowance = {instruments.pressure_gain / std::numbers::sqrt2, per_pressure * zero, 0.0,
                   per_pressure * widest_zero};
    }
    Siblings siblings(std::move(means), torque ? "N m" : "Pa", allowance, options);
    siblings.find_references(torque && trusted.size() > 1 ? trusted : all);
    for (const std::size_t motor : all) {
      if (!torque && !siblings.agreeing_everywhere().contains(motor)) trusted.erase(motor);
      ChannelCheck row;
      row.channel = channel;
      row.motor = motor;
      row.name = name_of(*moving.front().raw, channel, motor);
      row.against = torque                      ? "torque of the other motors"
                    : channel == Channel::inlet ? "inlets of the other motors"
                                                : "outlets of the other motors";
      const auto found = checked_channel(
          row, moving,
          [&](const std::vector<std::size_t>& places) { return siblings.compare(motor, places); },
          options);
      // One wrong port makes a torque that is no multiple of the others'.
      const bool no_multiple = torque && suspect_ports(rows, motor) == 1;
      for (ChannelCheck one : found) {
        if (no_multiple && !one.record.empty()) continue;
        if (no_multiple) one.likely.reset();
        one.is_used = is_used(moving, channel, motor, one.record);
        rows.push_back(std::move(one));
      }
    }
  }
  return rows;
}

}  // namespace boresight::identification
