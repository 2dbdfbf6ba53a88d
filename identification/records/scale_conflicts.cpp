#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <boresight/identification/records/scale_conflicts.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Gains = std::vector<std::optional<double>>;  // one a record

constexpr double other_scale = 3.0;
// Of the valve command of a slow record, which leakage under friction's load adds to.
constexpr double other_scale_when_slow = 8.0;
constexpr double slow = 0.1;  // of the fastest record's rate, rms
constexpr std::size_t fewest_others = 2;

std::optional<double> gain_of(const DriveRecord& record, const std::optional<Signal>& command) {
  if (!command || record.test == TestKind::slosh) return std::nullopt;
  double product = 0.0, square = 0.0;
  for (Eigen::Index k = 0; k < record.samples(); ++k) {
    if (!command->is_valid(k) || !record.motor_rate.is_valid(k)) continue;
    product += command->values(k) * record.motor_rate.values(k);
    square += command->values(k) * command->values(k);
  }
  if (!(square > 0.0) || !(product > 0.0)) return std::nullopt;
  return product / square;
}

// A record's gain over the median of the others'; nothing where it has none or too few others do.
std::optional<double> against_others(const Gains& gains, std::size_t record) {
  if (!gains[record]) return std::nullopt;
  std::vector<double> others;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (i != record && gains[i]) others.push_back(*gains[i]);
  }
  if (others.size() < fewest_others) return std::nullopt;
  return *gains[record] / numerics::median(std::move(others));
}

bool is_off(double ratio) {
  return std::abs(std::log(ratio)) >= std::log(other_scale);
}

double rms_rate(const DriveRecord& record) {
  double square = 0.0, count = 0.0;
  for (Eigen::Index k = 0; k < record.samples(); ++k) {
    if (!record.motor_rate.is_valid(k)) continue;
    square += record.motor_rate.values(k) * record.motor_rate.values(k);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

std::vector<bool> slow_records(const std::vector<const DriveRecord*>& records) {
  std::vector<double> rates;
  for (const DriveRecord* record : records) {
    const bool counts = record != nullptr && record->test != TestKind::slosh;
    rates.push_back(counts ? rms_rate(*record) : 0.0);
  }
  const double fastest = rates.empty() ? 0.0 : std::ranges::max(rates);
  std::vector<bool> is_slow;
  for (const double rate : rates) is_slow.push_back(rate < slow * fastest);
  return is_slow;
}

// A valve command that is large for the little rate of a slow record is the leakage's.
bool is_leakage(double ratio, bool is_slow) {
  return is_slow && ratio < 1.0 && ratio > 1.0 / other_scale_when_slow;
}

}  // namespace

std::vector<ScaleConflict> scale_conflicts(const std::vector<const DriveRecord*>& records) {
  using enum ScaleConflict::Channel;
  Gains by_rate(records.size()), by_valve(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i] == nullptr) continue;
    by_rate[i] = gain_of(*records[i], records[i]->rate_command);
    by_valve[i] = gain_of(*records[i], records[i]->valve_command);
  }
  const std::vector<bool> is_slow = slow_records(records);
  std::vector<ScaleConflict> conflicts;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto rate = against_others(by_rate, i);
    const auto valve = against_others(by_valve, i);
    const bool rate_off = rate && is_off(*rate);
    // A tachometer on another scale takes both gains, leakage that of the valve command alone.
    const bool leaks = valve && !rate_off && is_leakage(*valve, is_slow[i]);
    const bool valve_off = valve && is_off(*valve) && !leaks;
    if (rate_off && valve && !valve_off) {
      conflicts.push_back({i, rate_command, 1.0 / *rate});
    } else if (valve_off && rate && !rate_off) {
      conflicts.push_back({i, valve_command, 1.0 / *valve});
    } else if (rate_off || valve_off) {
      conflicts.push_back({i, tachometer, valve_off ? *valve : *rate});
    }
  }
  return conflicts;
}

}  // namespace boresight::identification
