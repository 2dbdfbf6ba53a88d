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

}  // namespace

std::vector<ScaleConflict> scale_conflicts(const std::vector<const DriveRecord*>& records) {
  using enum ScaleConflict::Channel;
  Gains by_rate(records.size()), by_valve(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i] == nullptr) continue;
    by_rate[i] = gain_of(*records[i], records[i]->rate_command);
    by_valve[i] = gain_of(*records[i], records[i]->valve_command);
  }
  std::vector<ScaleConflict> conflicts;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto rate = against_others(by_rate, i);
    const auto valve = against_others(by_valve, i);
    const bool rate_off = rate && is_off(*rate);
    const bool valve_off = valve && is_off(*valve);
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
