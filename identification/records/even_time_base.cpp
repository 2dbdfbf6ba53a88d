#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include <boresight/identification/records/channel_defects.hpp>
#include <boresight/identification/records/even_time_base.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;

// Steps over which the sample rate is told.
constexpr std::size_t step_block = 32;

// Indices of the longest rising subsequence.
std::vector<std::size_t> longest_rise(const std::vector<double>& values) {
  std::vector<std::size_t> ends;  // last index of the best run of each length
  std::vector<std::size_t> before(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto place = std::lower_bound(ends.begin(), ends.end(), values[i],
                                        [&](std::size_t a, double b) { return values[a] < b; });
    before[i] = place == ends.begin() ? i : *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
    } else {
      *place = i;
    }
  }
  std::vector<std::size_t> rise(ends.size());
  std::size_t at = ends.back();
  for (std::size_t i = rise.size(); i-- > 0;) {
    rise[i] = at;
    at = before[at];
  }
  return rise;
}

// The step that the times are written in multiples of (1e-3 for three decimals); 0 if none is seen.
double written_step(const std::vector<double>& times) {
  for (double step = 1.0; step > 5e-10; step *= 0.1) {
    const bool fits = std::all_of(times.begin(), times.end(), [step](double time) {
      const double multiple = time / step;
      return std::abs(multiple - std::round(multiple)) < 1e-4 + 1e-12 * std::abs(multiple);
    });
    if (fits) return step;
  }
  return 0.0;
}

struct Line {
  double start = 0.0;
  double slope = 0.0;
  double largest_residual = 0.0;
};

Line fitted_line(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0.0;
  double mean_y = 0.0;
  const auto count = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  double square = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    square += (x[i] - mean_x) * (x[i] - mean_x);
    product += (x[i] - mean_x) * (y[i] - mean_y);
  }
  Line line;
  // Sums of many terms end in rounding errors; no recorder's clock has twelve digits.
  line.slope = std::round(product / square * 1e12) * 1e-12;
  line.start = mean_y - line.slope * mean_x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.largest_residual =
        std::max(line.largest_residual, std::abs(y[i] - line.start - line.slope * x[i]));
  }
  return line;
}

class TimeBaseMaker {
 public:
  TimeBaseMaker(const Eigen::VectorXd& time, const DefectOptions& options,
                std::vector<RecordDefect>& defects)
      : time_(time), options_(options), defects_(defects) {}

  EvenTimeBase make() {
    take_known();
    if (!take_coarse()) {
      take_rising();
      place();
    }
    for (double& time : base_.times) time -= start_;
    if (base_.samples < options_.fewest_samples) refuse_short(base_.samples);
    return std::move(base_);
  }

 private:
  [[noreturn]] void refuse_short(Index samples) const {
    throw UnusableTimes(DefectKind::too_short, fmt::format("expected at least {} samples, found {}",
                                                           options_.fewest_samples, samples));
  }

  void add(DefectKind kind, DefectHandling handling, Index first, Index count,
           std::string explanation) {
    defects_.push_back({kind, handling, "", first, time_[first], count, std::move(explanation)});
  }

  void take_known() {
    Index first = -1;
    for (Index i = 0; i < time_.size(); ++i) {
      if (std::isfinite(time_[i])) {
        base_.rows.push_back(i);
        base_.times.push_back(time_[i]);
      } else if (first < 0) {
        first = i;
      }
    }
    const auto unknown = time_.size() - static_cast<Index>(base_.rows.size());
    if (unknown > 0) {
      add(DefectKind::missing_times, DefectHandling::left_out, first, unknown,
          "samples without a time");
    }
    if (static_cast<Index>(base_.rows.size()) < options_.fewest_samples) {
      refuse_short(static_cast<Index>(base_.rows.size()));
    }
  }

  // Times of fewer digits than the sample rate needs: several samples share one, and their order
  // is all there is.
  bool take_coarse() {
    std::size_t repeated = 0;
    std::size_t first = 0;
    double step = 0.0;
    for (std::size_t i = 1; i < base_.times.size(); ++i) {
      const double difference = base_.times[i] - base_.times[i - 1];
      if (difference < 0.0) return false;
      if (difference == 0.0 && repeated++ == 0) first = i;
      step = std::max(step, difference);
    }
    if (5 * repeated < base_.times.size()) return false;
    std::vector<double> order(base_.times.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<double>(i);
    const Line line = fitted_line(order, base_.times);
    if (!(line.slope > 0.0) || line.largest_residual > 1.01 * step) {
      throw UnusableTimes(
          DefectKind::repeated_times,
          fmt::format("expected times that rise, found {} of {} that repeat the one above",
                      repeated, base_.times.size()));
    }
    add(DefectKind::repeated_times, DefectHandling::resampled, base_.rows[first],
        static_cast<Index>(repeated),
        fmt::format("the times have too few digits: samples taken as evenly {:.6g} s apart",
                    line.slope));
    start_ = base_.times.front();
    for (std::size_t i = 0; i < base_.times.size(); ++i) {
      base_.times[i] = start_ + line.slope * order[i];
      base_.places.push_back(static_cast<Index>(i));
    }
    base_.sample_time = line.slope;
    base_.samples = static_cast<Index>(order.size());
    base_.longest_step = 1.75 * line.slope;
    return true;
  }

  void take_rising() {
    const bool rising = std::adjacent_find(base_.times.begin(), base_.times.end(),
                                           std::greater_equal<>()) == base_.times.end();
    if (rising) return;
    const std::vector<std::size_t> rise = longest_rise(base_.times);
    Index repeated = 0;
    Index backward = 0;
    Index first_repeated = 0;
    Index first_backward = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < base_.times.size(); ++i) {
      if (kept < rise.size() && rise[kept] == i) {
        ++kept;
        continue;
      }
      const bool again = (i > 0 && base_.times[i] == base_.times[i - 1]) ||
                         (i + 1 < base_.times.size() && base_.times[i] == base_.times[i + 1]);
      Index& first = again ? first_repeated : first_backward;
      if ((again ? repeated : backward)++ == 0) first = base_.rows[i];
    }
    if (20 * static_cast<std::size_t>(repeated + backward) > base_.times.size()) {
      throw UnusableTimes(DefectKind::backward_times,
                          fmt::format("expected times that rise, found {} of {} that do not (first "
                                      "at sample {}): is the file "
                                      "made of several records?",
                                      repeated + backward, base_.times.size(),
                                      backward > 0 ? first_backward : first_repeated));
    }
    if (repeated > 0) {
      add(DefectKind::repeated_times, DefectHandling::left_out, first_repeated, repeated,
          "samples whose time stands there already");
    }
    if (backward > 0) {
      add(DefectKind::backward_times, DefectHandling::left_out, first_backward, backward,
          "samples whose time is not between its neighbours'");
    }
    std::vector<Index> rows;
    std::vector<double> times;
    for (const std::size_t i : rise) {
      rows.push_back(base_.rows[i]);
      times.push_back(base_.times[i]);
    }
    base_.rows = std::move(rows);
    base_.times = std::move(times);
  }

  // Median step of the neighbourhood of each step; finds a change of the sample rate.
  std::vector<double> local_steps(const std::vector<double>& steps, double usual) {
    constexpr std::size_t block = step_block;
    constexpr double change = 1.3;
    std::vector<double> local(steps.size(), usual);
    Index first = -1;
    Index count = 0;
    double other = usual;
    for (std::size_t begin = 0; begin + block <= steps.size(); begin += block) {
      const auto from = steps.begin() + static_cast<std::ptrdiff_t>(begin);
      const double here = numerics::median(std::vector<double>(from, from + block));
      const std::size_t end = begin + 2 * block > steps.size() ? steps.size() : begin + block;
      std::fill(local.begin() + static_cast<std::ptrdiff_t>(begin),
                local.begin() + static_cast<std::ptrdiff_t>(end), here);
      if (here < change * usual && usual < change * here) continue;
      if (first < 0) {
        first = base_.rows[begin];
        other = here;
      }
      count += block;
    }
    if (first >= 0) {
      changed_ = true;
      add(DefectKind::rate_change, DefectHandling::resampled, first, count,
          fmt::format("about {} samples are {:.4g} s apart, most others {:.4g} s: interpolated to "
                      "the latter",
                      count, other, usual));
    }
    return local;
  }

  void place() {
    std::vector<double> steps;
    for (std::size_t i = 1; i < base_.times.size(); ++i) {
      steps.push_back(base_.times[i] - base_.times[i - 1]);
    }
    const double usual = numerics::median(steps);
    const std::vector<double> local = local_steps(steps, usual);
    const double span = base_.times.back() - base_.times.front();
    const auto rows = static_cast<double>(base_.rows.size());
    Index missing = 0;
    Index gaps = 0;
    Index first_gap = -1;
    double longest = 0.0;
    std::vector<double> order{0.0};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      order.push_back(order.back() + std::max(1.0, std::round(steps[i] / usual)));
      // A block about a change of the rate has the median of one side only.
      const double next = local[std::min(i + step_block, steps.size() - 1)];
      if (steps[i] <= 1.75 * std::max(local[i], next)) continue;
      if (++gaps == 1) first_gap = base_.rows[i];
      missing += static_cast<Index>(std::min(1e12, std::round(steps[i] / local[i]) - 1.0));
      longest = std::max(longest, steps[i]);
    }
    if (span / usual > 2.0 * rows + 1000.0) {
      throw UnusableTimes(DefectKind::gap, fmt::format("expected samples through most of {:.4g} s, "
                                                       "found {} gaps, the longest {:.4g} s (first "
                                                       "after sample {}): cut the file there",
                                                       span, gaps, longest, first_gap));
    }
    const Line line = fitted_line(order, base_.times);
    // Rounded times are off by half their last digit.
    const double tolerance =
        std::max(options_.jitter_tolerance * line.slope,
                 std::min(0.55 * written_step(base_.times), 0.45 * line.slope));
    if (!changed_ && line.largest_residual <= tolerance) {
      start_ = line.start;
      base_.sample_time = line.slope;
      for (const double place : order) base_.places.push_back(static_cast<Index>(place));
      base_.samples = base_.places.back() + 1;
      base_.longest_step = 1.75 * line.slope;
      base_.fills_short_gaps = options_.fill_short_gaps;
    } else {
      start_ = base_.times.front();
      // Jitter moves samples and adds none.
      const double intervals = changed_ ? std::max(1.0, std::round(span / usual))
                                        : rows - 1.0 + static_cast<double>(missing);
      base_.sample_time = span / intervals;
      base_.samples = static_cast<Index>(intervals) + 1;
      base_.longest_step = 1.75 * *std::max_element(local.begin(), local.end());
      if (!changed_) add_jitter(steps, usual);
    }
    if (gaps > 0) {
      add(DefectKind::gap, DefectHandling::masked, first_gap, missing,
          fmt::format("{} gaps without samples, the longest {:.4g} s{}", gaps, longest,
                      base_.fills_short_gaps
                          ? "; at most three samples at a time are filled from their neighbours"
                          : ""));
    }
  }

  void add_jitter(const std::vector<double>& steps, double usual) {
    Index off = 0;
    Index first = -1;
    double largest = 0.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double difference = std::abs(steps[i] - usual);
      if (difference <= options_.jitter_tolerance * usual || steps[i] > 1.75 * usual) continue;
      if (off++ == 0) first = base_.rows[i];
      largest = std::max(largest, difference);
    }
    add(DefectKind::jitter, DefectHandling::resampled, std::max<Index>(first, 0), off,
        fmt::format("steps differ from {:.6g} s by up to {:.2g} %: interpolated onto an even grid",
                    usual, 100.0 * largest / usual));
  }

  const Eigen::VectorXd& time_;
  const DefectOptions& options_;
  std::vector<RecordDefect>& defects_;
  EvenTimeBase base_;
  double start_ = 0.0;
  bool changed_ = false;
};

// Grid samples between two rows, where both have values.
void fill_short_gaps(const EvenTimeBase& base, Signal& signal) {
  Eigen::VectorXd values = signal.values;
  for (Index i = 0; i < values.size(); ++i) {
    if (!signal.valid[static_cast<std::size_t>(i)]) values[i] = std::nan("");
  }
  for (std::size_t i = 1; i < base.places.size(); ++i) {
    const Index before = base.places[i - 1], after = base.places[i];
    if (after == before + 1 || !std::isfinite(values[before]) || !std::isfinite(values[after])) {
      continue;
    }
    if (!fill_from_neighbours(values, before + 1, after)) continue;
    for (Index k = before + 1; k < after; ++k) {
      signal.values[k] = values[k];
      signal.valid[static_cast<std::size_t>(k)] = true;
    }
  }
}

// Straight lines over what is not valid, the nearest valid value before the first and behind the
// last.
void bridge(Signal& signal) {
  Index before = -1;
  const Index count = signal.values.size();
  for (Index i = 0; i <= count; ++i) {
    if (i < count && !signal.is_valid(i)) continue;
    if (i == count && before < 0) return;
    for (Index k = before + 1; k < i; ++k) {
      if (before < 0) {
        signal.values[k] = signal.values[i];
      } else if (i == count) {
        signal.values[k] = signal.values[before];
      } else {
        const double fraction = static_cast<double>(k - before) / static_cast<double>(i - before);
        signal.values[k] =
            signal.values[before] + fraction * (signal.values[i] - signal.values[before]);
      }
    }
    before = i;
  }
}

}  // namespace

EvenTimeBase even_time_base(const Eigen::VectorXd& time, const DefectOptions& options,
                            std::vector<RecordDefect>& defects) {
  return TimeBaseMaker(time, options, defects).make();
}

Signal on_time_base(const EvenTimeBase& base, const Eigen::VectorXd& values) {
  Signal signal;
  signal.values = Eigen::VectorXd::Zero(base.samples);
  signal.valid.assign(static_cast<std::size_t>(base.samples), false);
  if (!base.places.empty()) {
    for (std::size_t i = 0; i < base.rows.size(); ++i) {
      const double value = values[base.rows[i]];
      if (!std::isfinite(value)) continue;
      signal.values[base.places[i]] = value;
      signal.valid[static_cast<std::size_t>(base.places[i])] = true;
    }
    if (base.fills_short_gaps) fill_short_gaps(base, signal);
  } else {
    std::size_t row = 0;
    for (Index i = 0; i < base.samples; ++i) {
      const double time = std::min(base.sample_time * static_cast<double>(i), base.times.back());
      while (row + 2 < base.times.size() && base.times[row + 1] < time) ++row;
      const double step = base.times[row + 1] - base.times[row];
      const double left = values[base.rows[row]];
      const double right = values[base.rows[row + 1]];
      const double fraction = (time - base.times[row]) / step;
      const double value = left + fraction * (right - left);
      if (step > base.longest_step || !std::isfinite(value)) continue;
      signal.values[i] = value;
      signal.valid[static_cast<std::size_t>(i)] = true;
    }
  }
  bridge(signal);
  if (std::find(signal.valid.begin(), signal.valid.end(), false) == signal.valid.end()) {
    signal.valid.clear();
  }
  return signal;
}

}  // namespace boresight::identification
