#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <boresight/identification/records/channel_defects.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Equal samples one behind the other.
struct Run {
  Index begin = 0;
  Index end = 0;
  Index length() const { return end - begin; }
};

std::vector<Run> runs_of(const Eigen::VectorXd& values) {
  std::vector<Run> runs;
  for (Index i = 0; i < values.size();) {
    Index end = i + 1;
    while (end < values.size() && values[end] == values[i]) ++end;
    if (std::isfinite(values[i])) runs.push_back({i, end});
    i = end;
  }
  return runs;
}

struct Extremes {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
};

Extremes extremes_of(const Eigen::VectorXd& values, Index begin, Index end) {
  Extremes extremes;
  for (Index i = begin; i < end; ++i) {
    if (!std::isfinite(values[i])) continue;
    extremes.smallest = std::min(extremes.smallest, values[i]);
    extremes.largest = std::max(extremes.largest, values[i]);
  }
  return extremes;
}

// Length of the fourth longest of the runs for which `counts` holds: what is usual, however a few
// defects stand out.
template <typename Condition>
Index usual_length(const std::vector<Run>& runs, const Condition& counts) {
  std::array<Index, 4> longest{};
  for (const Run& run : runs) {
    if (!counts(run) || run.length() <= longest.back()) continue;
    longest.back() = run.length();
    std::sort(longest.begin(), longest.end(), std::greater<>());
  }
  return std::max<Index>(1, longest.back());
}

RecordDefect masked(DefectKind kind, const RawChannel& channel, const Eigen::VectorXd& time,
                    Index first, Index count, std::string explanation) {
  return {kind,  DefectHandling::masked, channel.name, first, time[first],
          count, std::move(explanation)};
}

void mask(Eigen::VectorXd& values, const Run& run, Index guard) {
  const Index begin = std::max<Index>(0, run.begin - guard);
  const Index end = std::min(values.size(), run.end + guard);
  values.segment(begin, end - begin).setConstant(no_number);
}

// The polynomial of Lagrange through present samples.
double through(const Eigen::VectorXd& values, const std::vector<Index>& nodes, Index at) {
  double sum = 0.0;
  for (const Index node : nodes) {
    double weight = 1.0;
    for (const Index other : nodes) {
      if (other != node) {
        weight *= static_cast<double>(at - other) / static_cast<double>(node - other);
      }
    }
    sum += weight * values[node];
  }
  return sum;
}

// Absolute difference of a sample from the one before, 0 if one is missing.
double step_at(const Eigen::VectorXd& values, Index i) {
  const double step = std::abs(values[i] - values[i - 1]);
  return std::isfinite(step) ? step : 0.0;
}

}  // namespace

double spread(const Eigen::VectorXd& values) {
  const Extremes extremes = extremes_of(values, 0, values.size());
  return std::max(0.0, extremes.largest - extremes.smallest);
}

bool fill_from_neighbours(Eigen::VectorXd& values, Index begin, Index end) {
  constexpr Index longest = 3;
  if (end - begin > longest || begin < 1 || end >= values.size()) return false;
  std::vector<Index> nodes;
  for (const Index node : {begin - 2, begin - 1, end, end + 1}) {
    if (node >= 0 && node < values.size() && std::isfinite(values[node])) nodes.push_back(node);
  }
  Eigen::VectorXd filled(end - begin);
  for (Index i = begin; i < end; ++i) filled[i - begin] = through(values, nodes, i);
  values.segment(begin, end - begin) = filled;
  return true;
}

double finite_median(const Eigen::VectorXd& values) {
  std::vector<double> finite;
  for (const double value : values) {
    if (std::isfinite(value)) finite.push_back(value);
  }
  return finite.empty() ? 0.0 : numerics::median(std::move(finite));
}

double correlation(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  double count = 0.0;
  double mean_one = 0.0;
  double mean_other = 0.0;
  for (Index i = 0; i < one.size(); ++i) {
    if (!std::isfinite(one[i]) || !std::isfinite(other[i])) continue;
    count += 1.0;
    mean_one += (one[i] - mean_one) / count;
    mean_other += (other[i] - mean_other) / count;
  }
  double product = 0.0;
  double square_one = 0.0;
  double square_other = 0.0;
  for (Index i = 0; i < one.size(); ++i) {
    if (!std::isfinite(one[i]) || !std::isfinite(other[i])) continue;
    product += (one[i] - mean_one) * (other[i] - mean_other);
    square_one += (one[i] - mean_one) * (one[i] - mean_one);
    square_other += (other[i] - mean_other) * (other[i] - mean_other);
  }
  const double scale = std::sqrt(square_one * square_other);
  return scale > 0.0 ? product / scale : 0.0;
}

std::vector<RecordDefect> missing_samples(RawChannel& channel, const Eigen::VectorXd& time,
                                          bool bridge) {
  Eigen::VectorXd& values = channel.values;
  Index left = 0, first_left = 0;
  Index bridged = 0, first_bridged = 0;
  for (Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    Run run{i, i + 1};
    while (run.end < values.size() && !std::isfinite(values[run.end])) ++run.end;
    if (bridge && fill_from_neighbours(values, run.begin, run.end)) {
      if (bridged == 0) first_bridged = i;
      bridged += run.length();
    } else {
      if (left == 0) first_left = i;
      left += run.length();
    }
    i = run.end - 1;
  }
  std::vector<RecordDefect> defects;
  if (left > 0) {
    defects.push_back(
        masked(DefectKind::missing_samples, channel, time, first_left, left, "no number there"));
  }
  if (bridged > 0) {
    defects.push_back(masked(DefectKind::missing_samples, channel, time, first_bridged, bridged,
                             "at most three at a time, filled from their neighbours"));
    defects.back().handling = DefectHandling::bridged;
  }
  return defects;
}

std::vector<RecordDefect> mask_clipped(RawChannel& channel, const Eigen::VectorXd& time,
                                       const DefectOptions& options, double* limit) {
  std::vector<RecordDefect> defects;
  Eigen::VectorXd& values = channel.values;
  const std::vector<Run> runs = runs_of(values);
  const Extremes extremes = extremes_of(values, 0, values.size());
  const auto at_extreme = [&](const Run& run) {
    return values[run.begin] == extremes.largest || values[run.begin] == extremes.smallest;
  };
  const Index usual = usual_length(runs, [&](const Run& run) { return !at_extreme(run); });
  const double largest = std::max(std::abs(extremes.largest), std::abs(extremes.smallest));
  Index stated = 0;
  Index first_stated = 0;
  Index found = 0;
  Index first_found = 0;
  double plateau = 0.0;
  std::vector<Run> clipped;
  for (const Run& run : runs) {
    const double value = values[run.begin];
    const double tolerance = options.limit_tolerance;
    const bool beyond = value >= channel.upper_limit - tolerance * std::abs(channel.upper_limit) ||
                        value <= channel.lower_limit + tolerance * std::abs(channel.lower_limit);
    // A plateau within the record, away from zero, longer than noise allows.
    const bool flat = at_extreme(run) && run.begin > 0 && run.end < values.size() &&
                      run.length() >= std::max<Index>(8, 4 * usual) &&
                      extremes.largest > extremes.smallest && std::abs(value) >= 0.5 * largest;
    if (beyond) {
      if (stated == 0) first_stated = run.begin;
      stated += run.length();
    } else if (flat) {
      if (found == 0) first_found = run.begin;
      found += run.length();
      plateau = value;
    }
    if (beyond || flat) clipped.push_back(run);
  }
  for (const Run& run : clipped) mask(values, run, options.guard_samples);
  const std::string guard =
      fmt::format("masked with {} more to either side", options.guard_samples);
  if (stated > 0) {
    defects.push_back(masked(DefectKind::clipped, channel, time, first_stated, stated,
                             "at the recorder's limit: " + guard));
  }
  if (found > 0) {
    defects.push_back(masked(DefectKind::clipped, channel, time, first_found, found,
                             fmt::format("flat at an extreme, {:.6g} (SI), where no limit is "
                                         "stated: {}",
                                         plateau, guard)));
    if (limit != nullptr) *limit = std::min(*limit, std::abs(plateau));
  }
  return defects;
}

std::vector<RecordDefect> mask_spikes(RawChannel& channel, const Eigen::VectorXd& time) {
  constexpr Index near = 2;
  constexpr Index window = 16;
  Eigen::VectorXd& values = channel.values;
  std::vector<double> steps;
  double quantum = std::numeric_limits<double>::infinity();
  for (Index i = 1; i < values.size(); ++i) {
    const double step = step_at(values, i);
    steps.push_back(step);
    if (step > 0.0) quantum = std::min(quantum, step);
  }
  if (values.size() < 2 * window || !std::isfinite(quantum)) return {};
  const double usual = numerics::median(steps);
  const double floor = std::max(6.0 * quantum, 0.005 * spread(values));
  std::vector<Index> spikes;
  for (Index i = near; i + near < values.size(); ++i) {
    std::array<double, 4> around{values[i - 2], values[i - 1], values[i + 1], values[i + 2]};
    std::sort(around.begin(), around.end());
    const double off = std::abs(values[i] - 0.5 * (around[1] + around[2]));
    if (!(off > floor) || off <= 6.0 * usual) continue;
    // The neighbours agree with one another: neither a step nor a wave.
    if (around[2] - around[1] > 0.25 * off) continue;
    const Index begin = std::max<Index>(1, i - window);
    const Index end = std::min(values.size(), i + window);
    std::vector<double> local(steps.begin() + begin - 1, steps.begin() + end - 1);
    std::sort(local.begin(), local.end());
    // Two spikes and both their flanks are not what is usual here.
    const double here = local[local.size() * 4 / 5];
    if (off > 12.0 * here) spikes.push_back(i);
  }
  if (spikes.empty()) return {};
  for (const Index i : spikes) values[i] = no_number;
  return {masked(DefectKind::spike, channel, time, spikes.front(),
                 static_cast<Index>(spikes.size()), "far off the samples to both sides")};
}

std::vector<RecordDefect> mask_stuck(RawChannel& channel,
                                     const std::vector<const RawChannel*>& others,
                                     const Eigen::VectorXd& time) {
  constexpr Index shortest = 25;
  Eigen::VectorXd& values = channel.values;
  const std::vector<Run> runs = runs_of(values);
  const Index usual = usual_length(runs, [](const Run&) { return true; });
  const Extremes all = extremes_of(values, 0, values.size());
  const double largest = std::max(std::abs(all.largest), std::abs(all.smallest));
  Index count = 0;
  Index first = 0;
  for (const Run& run : runs) {
    // A machine at rest is not a stuck channel.
    if (run.length() < std::max(shortest, 8 * usual) ||
        std::abs(values[run.begin]) < 0.01 * largest) {
      continue;
    }
    const bool others_move = std::any_of(others.begin(), others.end(), [&](const RawChannel* one) {
      const Extremes there = extremes_of(one->values, run.begin, run.end);
      return there.largest - there.smallest > 0.1 * spread(one->values);
    });
    if (!others_move) continue;
    if (count == 0) first = run.begin;
    count += run.length() - 1;
    mask(values, {run.begin + 1, run.end}, 0);
  }
  if (count == 0) return {};
  return {masked(DefectKind::stuck, channel, time, first, count,
                 "one value while other channels move")};
}

}  // namespace boresight::identification
