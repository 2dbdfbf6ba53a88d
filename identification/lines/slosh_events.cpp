#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/lines/slosh.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Sum over the ports of p(t) less the mean of half a period before and after, squared: twice the
// oscillation at the band's centre, next to nothing of what is slow. Running sum, so that a mean is
// a difference.
VectorXd running_energy(const DriveRecord& record, Index half_period) {
  const Index samples = record.samples();
  VectorXd energy = VectorXd::Zero(samples);
  const auto add = [&](const Signal& signal) {
    for (Index i = half_period; i < samples - half_period; ++i) {
      if (signal.is_valid(i - half_period) && signal.is_valid(i) &&
          signal.is_valid(i + half_period)) {
        const double y = signal.values(i) -
                         0.5 * (signal.values(i - half_period) + signal.values(i + half_period));
        energy(i) += y * y;
      }
    }
  };
  for (const auto& signal : record.inlet_pressure) add(signal);
  for (const auto& signal : record.outlet_pressure) add(signal);
  VectorXd running(samples + 1);
  running(0) = 0.0;
  for (Index i = 0; i < samples; ++i) running(i + 1) = running(i) + energy(i);
  return running;
}

double mean_speed(const DriveRecord& record, Index first, Index last) {
  first = std::clamp<Index>(first, 0, record.samples() - 1);
  last = std::clamp<Index>(last, first + 1, record.samples());
  return record.motor_rate.values.segment(first, last - first).cwiseAbs().mean();
}

}  // namespace

std::vector<SloshEvent> slosh_events(const DriveRecord& record, double lowest, double highest,
                                     const SloshOptions& options) {
  if (!(lowest > 0.0) || !(highest > lowest) || !(record.sample_time > 0.0)) {
    throw InvalidInput(fmt::format(
        "slosh_events: expected a band of positive frequencies and a positive sample time, found "
        "{} .. {} Hz and {} s",
        lowest, highest, record.sample_time));
  }
  const double period = 1.0 / std::sqrt(lowest * highest);
  const auto half = std::max<Index>(1, std::llround(0.5 * period / record.sample_time));
  const auto span = std::max<Index>(4, std::llround(2.0 * period / record.sample_time));
  const Index samples = record.samples();
  std::vector<SloshEvent> events;
  if (samples < 6 * span) return events;
  const VectorXd running = running_energy(record, half);
  VectorXd after(samples - span);
  for (Index i = 0; i < after.size(); ++i) after(i) = running(i + span) - running(i);
  VectorXd sorted = after;
  std::sort(sorted.begin(), sorted.end());
  const double loudest = sorted(sorted.size() - 1);
  // What is there when nothing rings, and no less than a record without noise needs.
  const double quiet = std::max(sorted(sorted.size() / 5), 1e-6 * loudest);

  VectorXd rise = VectorXd::Zero(after.size());
  for (Index i = span; i < after.size(); ++i) {
    if (after(i) > 0.03 * loudest) rise(i) = after(i) / std::max(after(i - span), quiet);
  }
  const double minimum = options.min_ringing_ratio * options.min_ringing_ratio;
  for (Index i = span; i < rise.size(); ++i) {
    const Index from = std::max(i - 2 * span, Index{0});
    const Index count = std::min(i + 2 * span, rise.size() - 1) - from + 1;
    Index top = 0;
    if (rise(i) < minimum || rise.segment(from, count).maxCoeff(&top) > rise(i) ||
        from + top != i) {
      continue;
    }
    // The filter looks half a period ahead.
    events.push_back(
        {static_cast<double>(i + half) * record.sample_time, std::sqrt(rise(i)), false});
  }
  for (std::size_t k = 0; k < events.size(); ++k) {
    const auto at = static_cast<Index>(events[k].time / record.sample_time);
    const auto tenth = std::max<Index>(1, std::llround(0.1 / record.sample_time));
    const Index next = k + 1 < events.size()
                           ? static_cast<Index>(events[k + 1].time / record.sample_time)
                           : samples;
    const Index end = std::min(next, at + 20 * tenth);
    const double before = mean_speed(record, at - tenth, at);
    events[k].closing = mean_speed(record, end - tenth, end) < 0.5 * before;
  }
  return events;
}

}  // namespace boresight::identification
