#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/impulse/impulse_windows.hpp>
#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/identification/signals/rate_smoothing.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

bool changes_speed(TestKind test) {
  return test == TestKind::fast_ramp || test == TestKind::constant_speed ||
         test == TestKind::valve_steps || test == TestKind::valve_chirp;
}

// Stretches of one direction, faster than the lowest rate.
std::vector<MotionWindow> one_way(const Eigen::VectorXd& rate, const MotionWindow& stretch,
                                  double lowest) {
  std::vector<MotionWindow> found;
  for (Eigen::Index i = stretch.first; i <= stretch.last; ++i) {
    if (std::abs(rate(i)) < lowest) continue;
    const Eigen::Index first = i;
    while (i + 1 <= stretch.last && std::abs(rate(i + 1)) >= lowest &&
           (rate(i + 1) > 0.0) == (rate(first) > 0.0)) {
      ++i;
    }
    found.push_back({first, i, 0});
  }
  return found;
}

// Turning points of the rate within a stretch, ends included: a turn counts once the rate has come
// back by `step`.
std::vector<Eigen::Index> turning_points(const Eigen::VectorXd& rate, const MotionWindow& stretch,
                                         double step) {
  std::vector<Eigen::Index> turns{stretch.first};
  Eigen::Index lowest = stretch.first, highest = stretch.first;
  int trend = 0;
  for (Eigen::Index i = stretch.first; i <= stretch.last; ++i) {
    if (rate(i) < rate(lowest)) lowest = i;
    if (rate(i) > rate(highest)) highest = i;
    if (trend >= 0 && rate(i) < rate(highest) - step) {
      if (trend > 0 || highest > stretch.first) turns.push_back(highest);
      trend = -1;
      lowest = i;
    } else if (trend <= 0 && rate(i) > rate(lowest) + step) {
      if (trend < 0 || lowest > stretch.first) turns.push_back(lowest);
      trend = 1;
      highest = i;
    }
  }
  turns.push_back(stretch.last);
  return turns;
}

}  // namespace

double structure_period(const DriveKnowledge& knowledge) {
  if (knowledge.locked_rotor_frequencies.empty() ||
      !(knowledge.locked_rotor_frequencies.front().value > 0.0)) {
    return 0.5;
  }
  return 1.0 / knowledge.locked_rotor_frequencies.front().value;
}

double speed_smoothing_time(const DriveKnowledge& knowledge) {
  return 0.5 * structure_period(knowledge);
}

std::vector<ImpulseWindow> ramp_windows(const Campaign& campaign, std::size_t record_index) {
  if (record_index >= campaign.records.size()) {
    throw InvalidInput(fmt::format("ramp_windows: expected one of {} records, found number {}",
                                   campaign.records.size(), record_index));
  }
  const auto& record = campaign.records[record_index];
  const auto& rate = record.motor_rate.values;
  const Eigen::Index samples = rate.size();
  if (samples < 3) return {};
  const auto clipped = [&](Eigen::Index i) {
    return !record.motor_rate.is_valid(i) || std::abs(rate(i)) >= 0.999 * record.motor_rate_limit;
  };
  Eigen::Index rise = 0;  // end of the first window
  while (rise < samples && (!clipped(rise) || rate(rise) <= 0.0)) ++rise;
  Eigen::Index fall = rise;  // start of the second
  const double largest = rate.maxCoeff();
  if (rise < samples) {
    while (fall < samples && clipped(fall)) ++fall;
    --rise;
  } else {
    // The first half period's largest rate: up to where the rate has turned to half of it again.
    if (!(largest > 0.0)) return {};
    rise = 0;
    for (Eigen::Index i = 0; i < samples; ++i) {
      if (rate(i) > rate(rise)) rise = i;
      if (rate(rise) > 0.7 * largest && rate(i) < 0.5 * rate(rise)) break;
    }
    fall = rise;
  }
  // Back to where the rate became positive for good: noise and creep before it are no ramp.
  const double noise = std::max(5.0 * noise_level(rate), 0.02 * largest);
  Eigen::Index first = std::max<Eigen::Index>(0, rise);
  while (first > 0 && rate(first - 1) > noise) --first;
  const Eigen::Index length = rise - first;
  if (length < 1 || fall + length >= samples) return {};
  return {{record_index, {first, rise, 0}, 1, true, rate(first), rate(rise)},
          {record_index, {fall, fall + length, 0}, 1, false, rate(fall), rate(fall + length)}};
}

std::vector<ImpulseWindow> impulse_windows(const Campaign& campaign,
                                           const ImpulseWindowOptions& options) {
  if (!(options.guard_time >= 0.0) || !(options.smallest_change > 0.0) ||
      !(options.lowest_rate >= 0.0)) {
    throw InvalidInput(
        fmt::format("impulse_windows: expected a guard time and a lowest rate of at least 0 and a "
                    "positive smallest change, found {}, {} and {}",
                    options.guard_time, options.lowest_rate, options.smallest_change));
  }
  const double period = structure_period(campaign.knowledge);
  std::vector<ImpulseWindow> found;
  double largest = 0.0, largest_change = 0.0;
  for (const auto& record : campaign.records) {
    if (!changes_speed(record.test) || record.samples() < 3) continue;
    largest = std::max(largest, record.motor_rate.values.cwiseAbs().maxCoeff());
  }
  for (std::size_t index = 0; index < campaign.records.size(); ++index) {
    const auto& record = campaign.records[index];
    if (!changes_speed(record.test) || record.samples() < 3) continue;
    const auto samples = [&](double time) {
      return static_cast<Eigen::Index>(std::lround(time / record.sample_time));
    };
    const auto usable = usable_samples(record, options.guard_time);
    for (const auto& stretch : stretches(usable)) {
      Eigen::VectorXd rate = record.motor_rate.values;
      rate.segment(stretch.first, stretch.last - stretch.first + 1) = moving_mean(
          rate.segment(stretch.first, stretch.last - stretch.first + 1), samples(0.25 * period));
      for (const auto& way : one_way(rate, stretch, options.lowest_rate * largest)) {
        const auto turns = turning_points(rate, way, 0.02 * largest);
        for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
          const Eigen::Index length = turns[i + 1] - turns[i];
          if (length < std::max<Eigen::Index>(2, samples(period))) continue;
          const double from = rate(turns[i]), to = rate(turns[i + 1]);
          largest_change = std::max(largest_change, std::abs(to - from));
          found.push_back({index,
                           {turns[i], turns[i + 1], std::min(samples(period), length / 2)},
                           from + to > 0.0 ? 1 : -1,
                           std::abs(to) > std::abs(from),
                           from,
                           to});
        }
      }
    }
  }
  std::erase_if(found, [&](const ImpulseWindow& one) {
    return std::abs(one.to_rate - one.from_rate) < options.smallest_change * largest_change;
  });
  return found;
}

std::vector<ImpulseWindow> common_path(const Campaign& campaign,
                                       const std::vector<ImpulseWindow>& windows, int direction,
                                       double cut_low, double cut_high) {
  const double same_path_smoothing = speed_smoothing_time(campaign.knowledge);
  const auto select = [&](bool ramps_only) {
    std::vector<ImpulseWindow> chosen;
    double largest = 0.0;
    for (const auto& one : windows) {
      if (one.direction != direction ||
          (ramps_only && campaign.records[one.record].test != TestKind::fast_ramp)) {
        continue;
      }
      const Eigen::Index minimum =
          shortest_speed_window(campaign.records[one.record].sample_time, same_path_smoothing);
      if (one.window.last - one.window.first + 1 < minimum) continue;
      chosen.push_back(one);
      largest = std::max(largest, std::abs(one.to_rate - one.from_rate));
    }
    std::erase_if(chosen, [&](const ImpulseWindow& one) {
      return std::abs(one.to_rate - one.from_rate) < 0.5 * largest;
    });
    const auto speeds_up = std::count_if(chosen.begin(), chosen.end(),
                                         [](const ImpulseWindow& one) { return one.accelerating; });
    if (speeds_up == 0 || speeds_up == std::ssize(chosen)) chosen.clear();
    return chosen;
  };
  auto chosen = select(true);
  if (chosen.empty()) chosen = select(false);
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  for (const auto& one : chosen) {
    low = std::max(low, std::min(std::abs(one.from_rate), std::abs(one.to_rate)));
    high = std::min(high, std::max(std::abs(one.from_rate), std::abs(one.to_rate)));
  }
  if (!(high > low) || !std::isfinite(high)) return {};
  // A little within: a rate smoothed once more still reaches both ends.
  const double span = high - low;
  low += (0.02 + cut_low) * span;
  high -= (0.02 + cut_high) * span;
  for (auto& one : chosen) {
    const double sign = direction;
    one.from_rate = sign * (one.accelerating ? low : high);
    one.to_rate = sign * (one.accelerating ? high : low);
    one.window.taper = 0;
  }
  return chosen;
}

}  // namespace boresight::identification
