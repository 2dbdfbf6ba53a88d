#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_record.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check(const Signal& signal, const DriveRecord& record, const char* what) {
  if (signal.values.size() != record.samples() || !signal.values.allFinite() ||
      (!signal.valid.empty() &&
       signal.valid.size() != static_cast<std::size_t>(record.samples()))) {
    throw InvalidInput(
        fmt::format("prepare_records: expected {} finite values in '{}' of record '{}', found {}{}",
                    record.samples(), what, record.name, signal.values.size(),
                    signal.values.allFinite() ? "" : ", not all finite"));
  }
}

bool mostly_valid(const Signal& signal) {
  if (signal.valid.empty()) return true;
  return 2 * std::count(signal.valid.begin(), signal.valid.end(), true) >
         static_cast<std::ptrdiff_t>(signal.valid.size());
}

// Mean of the channels that work; `valid` loses the samples at which one of them is not.
VectorXd mean_pressure(const std::vector<Signal>& channels, const DriveRecord& record,
                       std::vector<bool>& valid) {
  VectorXd sum = VectorXd::Zero(record.samples());
  int count = 0;
  for (const auto& channel : channels) {
    check(channel, record, "pressure");
    if (!mostly_valid(channel)) continue;
    sum += channel.values;
    ++count;
    for (std::size_t k = 0; k < channel.valid.size(); ++k) {
      if (!channel.valid[k]) valid[k] = false;
    }
  }
  return count > 0 ? VectorXd(sum / count) : VectorXd();
}

// Weights of a low pass of linear phase (windowed sinc after Hamming) for thinning by a factor:
// flat to a quarter of the new rate, the stop band from its half.
VectorXd low_pass(Index factor) {
  const Index half = 7 * factor;
  VectorXd weights(2 * half + 1);
  const double corner = 0.375 / static_cast<double>(factor);
  for (Index k = -half; k <= half; ++k) {
    const double t = two_pi * corner * static_cast<double>(k);
    const double sinc = k == 0 ? 1.0 : std::sin(t) / t;
    const double window = 0.54 + 0.46 * std::cos(std::numbers::pi * static_cast<double>(k) /
                                                 static_cast<double>(half));
    weights(k + half) = sinc * window;
  }
  return weights / weights.sum();
}

// The ends continue as they stand.
VectorXd thin(const VectorXd& series, Index factor, const VectorXd& weights) {
  if (factor == 1) return series;
  const Index half = weights.size() / 2;
  VectorXd padded(series.size() + 2 * half);
  padded << VectorXd::Constant(half, series(0)), series,
      VectorXd::Constant(half, series(series.size() - 1));
  VectorXd thinned((series.size() - 1) / factor + 1);
  for (Index k = 0; k < thinned.size(); ++k) {
    thinned(k) = weights.dot(padded.segment(k * factor, weights.size()));
  }
  return thinned;
}

// Valid where everything within the reach of the filter's main lobe is.
std::vector<bool> thin(const std::vector<bool>& valid, Index factor) {
  const auto size = static_cast<Index>(valid.size());
  const Index reach = factor == 1 ? 0 : 2 * factor;
  std::vector<bool> thinned(static_cast<std::size_t>((size - 1) / factor + 1));
  for (std::size_t k = 0; k < thinned.size(); ++k) {
    const Index centre = static_cast<Index>(k) * factor;
    const auto first = valid.begin() + std::max<Index>(0, centre - reach);
    const auto last = valid.begin() + std::min(size, centre + reach + 1);
    thinned[k] = std::find(first, last, false) == last;
  }
  return thinned;
}

// Prediction starts afresh where something it is driven by was missing for longer than this.
constexpr double bridged_gap = 0.1;  // s

std::vector<bool> starts_after_gaps(const std::vector<bool>& known, Index gap) {
  std::vector<bool> starts(known.size(), false);
  starts[0] = true;
  Index missing = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (!known[k]) {
      ++missing;
      continue;
    }
    if (missing > gap) starts[k] = true;
    missing = 0;
  }
  return starts;
}

// Counting samples: known, and no start within the last `settling` samples.
std::vector<bool> settled(const std::vector<bool>& known, const std::vector<bool>& starts,
                          Index settling) {
  std::vector<bool> counts(known.size());
  Index since = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    since = starts[k] ? 0 : since + 1;
    counts[k] = known[k] && since >= settling;
  }
  return counts;
}

VectorXd slope(const VectorXd& series, double sample_time) {
  const Index n = series.size();
  VectorXd rate = VectorXd::Zero(n);
  if (n > 2) {
    rate.segment(1, n - 2) = (series.tail(n - 2) - series.head(n - 2)) / (2.0 * sample_time);
  }
  return rate;
}

// Takes off a twelfth of the second difference.
VectorXd flattened(const VectorXd& series) {
  const Index n = series.size();
  VectorXd out = series;
  if (n > 2) {
    out.segment(1, n - 2) +=
        (2.0 * series.segment(1, n - 2) - series.head(n - 2) - series.tail(n - 2)) / 12.0;
  }
  return out;
}

GreyBoxRecord prepare(const DriveRecord& record, double torque_per_mean,
                      const GreyBoxRecordOptions& options) {
  std::vector<bool> valid(static_cast<std::size_t>(record.samples()), true);
  const VectorXd inlet = mean_pressure(record.inlet_pressure, record, valid);
  const VectorXd outlet = mean_pressure(record.outlet_pressure, record, valid);
  check(record.motor_rate, record, "motor_rate");
  GreyBoxRecord out;
  if (inlet.size() == 0 || outlet.size() == 0 || !mostly_valid(record.motor_rate)) return out;
  out.name = record.name;
  out.test = record.test;
  const auto factor = std::max<Index>(
      1, static_cast<Index>(1.0 / (record.sample_time * options.sample_rate) + 1e-9));
  out.sample_time = record.sample_time * static_cast<double>(factor);
  const VectorXd weights = low_pass(factor);
  out.side_1 = torque_per_mean * thin(inlet, factor, weights);
  out.side_2 = torque_per_mean * thin(outlet, factor, weights);
  out.torque = flattened(out.side_1 - out.side_2);
  out.common = flattened(0.5 * (out.side_1 + out.side_2));
  out.rate = thin(record.motor_rate.values, factor, weights);
  out.motion = flattened(out.rate);
  out.motion_slope = slope(out.motion, out.sample_time);

  std::vector<bool> rate_valid = record.motor_rate.valid;
  if (rate_valid.empty()) rate_valid.assign(valid.size(), true);
  const auto& command = record.valve_command ? record.valve_command : record.rate_command;
  std::vector<bool> valve_valid;
  if (command && (record.valve_command || !record.rate_loop_closed)) {
    check(*command, record, "valve command");
    const VectorXd& u = command->values;
    // A command that stands still while the valve is driven past it says nothing.
    if (mostly_valid(*command) &&
        u.maxCoeff() - u.minCoeff() > 0.02 * out.rate.cwiseAbs().maxCoeff()) {
      out.valve = flattened(thin(u, factor, weights));
      out.valve_calibrated = record.valve_command.has_value();
      valve_valid = command->valid;
    }
  }
  if (valve_valid.empty()) valve_valid.assign(valid.size(), true);

  const std::vector<bool> pressure_known = thin(valid, factor);
  out.rate_known = thin(rate_valid, factor);
  const std::vector<bool> valve_known = thin(valve_valid, factor);
  const auto gap = static_cast<Index>(bridged_gap / out.sample_time);
  const auto settling = static_cast<Index>(options.settling_time / out.sample_time);
  out.rate_restarts = starts_after_gaps(pressure_known, gap);
  std::vector<bool> rate_counts = out.rate_known;
  std::vector<bool> driven = pressure_known;
  for (std::size_t k = 0; k < driven.size(); ++k) {
    rate_counts[k] = rate_counts[k] && pressure_known[k];
    driven[k] = driven[k] && out.rate_known[k] && valve_known[k];
  }
  out.rate_counts = settled(rate_counts, out.rate_restarts, settling);
  out.pressure_restarts = starts_after_gaps(driven, 0);
  out.pressure_counts = settled(driven, out.pressure_restarts, gap);
  return out;
}

}  // namespace

std::vector<GreyBoxRecord> prepare_records(const Campaign& campaign,
                                           const GreyBoxRecordOptions& options) {
  if (!(options.sample_rate > 0.0) || !(options.settling_time >= 0.0)) {
    throw InvalidInput(fmt::format(
        "prepare_records: expected a positive sample rate and a settling time from 0, found {} and "
        "{}",
        options.sample_rate, options.settling_time));
  }
  const double torque_per_mean =
      torque_per_pressure(campaign.knowledge) * campaign.knowledge.motor_count;
  std::vector<GreyBoxRecord> records;
  double sum = 0.0, count = 0.0;
  for (const auto& record : campaign.records) {
    if (!(record.sample_time > 0.0)) {
      throw InvalidInput(
          fmt::format("prepare_records: expected a positive sample time of record '{}', found {}",
                      record.name, record.sample_time));
    }
    if (static_cast<double>(record.samples()) * record.sample_time < 2.0 * options.settling_time ||
        record.samples() < 10) {
      continue;
    }
    records.push_back(prepare(record, torque_per_mean, options));
    if (records.back().samples() == 0) {
      records.pop_back();
      continue;
    }
    sum += records.back().common.sum();
    count += static_cast<double>(records.back().samples());
  }
  for (auto& record : records) record.common.array() -= sum / count;
  return records;
}

}  // namespace boresight::identification
