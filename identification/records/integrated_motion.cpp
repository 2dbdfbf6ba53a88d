#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

// The flank's rise at x in [0, 1], its first and third derivative by x.
double flank(double x) {
  return x * x * x * x * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x)));
}
double flank_slope(double x) {
  const double y = x * (1.0 - x);
  return 140.0 * y * y * y;
}
double flank_jerk(double x) {
  return 840.0 * x * (1.0 + x * (-6.0 + x * (10.0 - 5.0 * x)));
}

void check(const DriveRecord& record, const MotionWindow& window, double group_time) {
  const Eigen::Index samples = record.samples();
  if (window.first < 0 || window.last >= samples || window.last <= window.first ||
      window.taper < 0 || 2 * window.taper > window.last - window.first) {
    throw InvalidInput(fmt::format(
        "integrate_motion: expected a window of at least two of the {} samples of record '{}' with "
        "flanks that do not overlap, found {} to {} with flanks of {}",
        samples, record.name, window.first, window.last, window.taper));
  }
  if (!(group_time > 0.0) || !(record.sample_time > 0.0)) {
    throw InvalidInput(
        fmt::format("integrate_motion: expected positive group and sample times, found {} and {}",
                    group_time, record.sample_time));
  }
  for (const auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (const auto& signal : *side) {
      if (signal.values.size() != samples) {
        throw InvalidInput(fmt::format(
            "integrate_motion: expected {} samples in every channel of record '{}', found a "
            "pressure of {}",
            samples, record.name, signal.values.size()));
      }
    }
  }
}

// phi times the sample time at every sample of the window: the trapezoidal rule without flanks.
Eigen::VectorXd weights(const MotionWindow& window, double sample_time) {
  const Eigen::Index count = window.last - window.first + 1;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(count, sample_time);
  if (window.taper == 0) {
    weight(0) *= 0.5;
    weight(count - 1) *= 0.5;
  }
  for (Eigen::Index i = 0; i < window.taper; ++i) {
    const double rise = flank(static_cast<double>(i) / static_cast<double>(window.taper));
    weight(i) *= rise;
    weight(count - 1 - i) *= rise;
  }
  return weight;
}

void integrate_rate(const DriveRecord& record, IntegratedMotion& motion) {
  const Eigen::Index first = motion.window.first, last = motion.window.last,
                     taper = motion.window.taper;
  const auto& rate = record.motor_rate.values;
  if (taper == 0) {
    motion.rate_change = rate(last) - rate(first);
    return;
  }
  const double flank_time = static_cast<double>(taper) * record.sample_time;
  const auto difference = [&](Eigen::Index i) { return rate(last - i) - rate(first + i); };
  double slope = 0.0, jerk = 0.0, slope_sum = 0.0, jerk_sum = 0.0;
  for (Eigen::Index i = 1; i < taper; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(taper);
    slope += flank_slope(x) * difference(i);
    jerk += flank_jerk(x) * difference(i);
    slope_sum += flank_slope(x);
    jerk_sum += flank_jerk(x);
  }
  // What sampling leaves of the integrals over the flank, 1 and 0, is put at its ends.
  const double ends = 0.5 * (difference(0) + difference(taper));
  slope += (static_cast<double>(taper) - slope_sum) * ends;
  jerk -= jerk_sum * ends;
  motion.rate_change = slope / static_cast<double>(taper);
  motion.jerk = jerk / static_cast<double>(taper) / (flank_time * flank_time);
}

void group_rates(const DriveRecord& record, const Eigen::VectorXd& weight, double group_time,
                 IntegratedMotion& motion) {
  const Eigen::Index count = weight.size();
  const auto stride = std::max<Eigen::Index>(
      1, static_cast<Eigen::Index>(std::lround(group_time / record.sample_time)));
  const Eigen::Index groups = (count + stride - 1) / stride;
  motion.rate.resize(groups);
  motion.rate_weight.resize(groups);
  for (Eigen::Index group = 0; group < groups; ++group) {
    const Eigen::Index from = group * stride;
    const Eigen::Index size = std::min(stride, count - from);
    motion.rate(group) = record.motor_rate.values.segment(motion.window.first + from, size).mean();
    motion.rate_weight(group) = weight.segment(from, size).sum();
  }
}

}  // namespace

IntegratedMotion integrate_motion(const DriveRecord& record, const MotionWindow& window,
                                  double group_time) {
  check(record, window, group_time);
  IntegratedMotion motion;
  motion.window = window;
  const Eigen::VectorXd weight = weights(window, record.sample_time);
  motion.duration = weight.sum();
  motion.mean_rate =
      weight.dot(record.motor_rate.values.segment(window.first, weight.size())) / motion.duration;
  motion.pressure_impulse.resize(
      static_cast<Eigen::Index>(record.inlet_pressure.size() + record.outlet_pressure.size()));
  Eigen::Index channel = 0;
  for (const auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (const auto& signal : *side) {
      motion.pressure_impulse(channel++) =
          weight.dot(signal.values.segment(window.first, weight.size()));
    }
  }
  integrate_rate(record, motion);
  group_rates(record, weight, group_time, motion);
  return motion;
}

std::vector<bool> usable_samples(const DriveRecord& record, double guard_time) {
  const auto samples = static_cast<std::size_t>(record.samples());
  const auto guard =
      static_cast<std::size_t>(std::max(0.0, std::ceil(guard_time / record.sample_time - 1e-9)));
  std::vector<bool> usable(samples, true);
  const auto exclude = [&](std::size_t sample) {
    const std::size_t from = sample > guard ? sample - guard : 0;
    const std::size_t to = std::min(samples - 1, sample + guard);
    for (std::size_t i = from; i <= to; ++i) usable[i] = false;
  };
  for (std::size_t i = 0; i < samples; ++i) {
    const auto sample = static_cast<Eigen::Index>(i);
    const auto invalid = [sample](const Signal& signal) { return !signal.is_valid(sample); };
    const bool clipped =
        std::abs(record.motor_rate.values(sample)) >= 0.999 * record.motor_rate_limit;
    if (clipped || invalid(record.motor_rate) ||
        std::any_of(record.inlet_pressure.begin(), record.inlet_pressure.end(), invalid) ||
        std::any_of(record.outlet_pressure.begin(), record.outlet_pressure.end(), invalid)) {
      exclude(i);
    }
  }
  return usable;
}

std::vector<MotionWindow> stretches(const std::vector<bool>& usable) {
  std::vector<MotionWindow> found;
  const auto count = static_cast<Eigen::Index>(usable.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!usable[static_cast<std::size_t>(i)]) continue;
    const Eigen::Index first = i;
    while (i + 1 < count && usable[static_cast<std::size_t>(i + 1)]) ++i;
    found.push_back({first, i, 0});
  }
  return found;
}

double noise_level(const Eigen::VectorXd& signal) {
  const Eigen::Index count = signal.size() - 2;
  if (count < 3) return 0.0;
  std::vector<double> size(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i) {
    size[static_cast<std::size_t>(i)] = std::abs(signal(i) - 2.0 * signal(i + 1) + signal(i + 2));
  }
  // The median size of a standard normal number is 0.6745; a second difference has variance 6.
  return numerics::median(std::move(size)) / (0.6745 * std::sqrt(6.0));
}

numerics::Uncertain structural_jerk_inertia(const DriveKnowledge& knowledge) {
  if (knowledge.locked_rotor_frequencies.empty()) return {};
  const double lowest = two_pi * knowledge.locked_rotor_frequencies.front().value;
  if (!(lowest > 0.0)) return {};
  const double largest = knowledge.antenna_inertia.value / (lowest * lowest);
  return {0.8 * largest, 0.4 * largest / std::sqrt(12.0)};
}

}  // namespace boresight::identification
