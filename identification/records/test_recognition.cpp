#include <algorithm>
#include <cmath>

#include <boresight/identification/records/test_recognition.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;

double largest(const Eigen::VectorXd& values) {
  return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
}

bool is_driven(const Signal& command, double fastest) {
  return largest(command.values) > 1e-3 * fastest;
}

// As many samples as a time has, but no more than a fiftieth of the record.
Index block_width(const DriveRecord& record, double time) {
  const double maximum = static_cast<double>(record.samples()) / 50.0;
  return std::max<Index>(1, static_cast<Index>(std::min(maximum, time / record.sample_time)));
}

// Means over `width` samples each: noise and single samples out of the way.
Eigen::VectorXd block_means(const Eigen::VectorXd& values, Index width) {
  Eigen::VectorXd means(values.size() / width);
  for (Index i = 0; i < means.size(); ++i) means[i] = values.segment(i * width, width).mean();
  return means;
}

// Fraction of the samples within a twentieth of the range of one of two levels, the extremes' inner
// neighbours.
double fraction_at_two_levels(const Eigen::VectorXd& values) {
  std::vector<double> sorted(values.data(), values.data() + values.size());
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double fraction) {
    return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1))];
  };
  const double low = at(0.15);
  const double high = at(0.85);
  const double near = 0.05 * (high - low);
  const auto count = std::count_if(sorted.begin(), sorted.end(), [&](double value) {
    return std::abs(value - low) <= near || std::abs(value - high) <= near;
  });
  return static_cast<double>(count) / static_cast<double>(sorted.size());
}

// Times at which a signal crosses its median, with a band around it that noise does not leave. What
// it does for a short time only, on its way to a bias, does not count.
std::vector<double> crossings(const Eigen::VectorXd& values, double step) {
  std::vector<double> sorted(values.data(), values.data() + values.size());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t count = sorted.size();
  const double middle = sorted[count / 2];
  const double band = 0.1 * (sorted[count - 1 - count / 20] - sorted[count / 20]);
  std::vector<double> times;
  int side = 0;
  for (Index i = 0; i < values.size(); ++i) {
    const int now = values[i] > middle + band ? 1 : (values[i] < middle - band ? -1 : 0);
    if (now == 0 || now == side) continue;
    if (side != 0) times.push_back(static_cast<double>(i) * step);
    side = now;
  }
  return times;
}

// Intervals that shrink: the last quarter's median against the first's.
bool ever_faster(const std::vector<double>& times) {
  if (times.size() < 20) return false;
  const auto quarter = static_cast<std::ptrdiff_t>(times.size() / 4);
  const double first = times[static_cast<std::size_t>(quarter)] - times.front();
  const double last = times.back() - times[times.size() - 1 - static_cast<std::size_t>(quarter)];
  return last < 0.3 * first;
}

TestKind of_valve(const DriveRecord& record, const Eigen::VectorXd& valve) {
  const double duration = record.sample_time * static_cast<double>(valve.size());
  const Index width = block_width(record, 0.02);
  const Eigen::VectorXd means = block_means(valve, width);
  if (ever_faster(crossings(means, record.sample_time * static_cast<double>(width)))) {
    return TestKind::valve_chirp;
  }
  const double near = 0.1 * largest(means);
  const auto at_rest = (means.array().abs() < near).count();
  if (duration < 20.0 || 4 * at_rest > means.size()) return TestKind::slosh;
  // Steps: most of the time nothing, then everything at once.
  Index jumps = 0;
  const double range = means.maxCoeff() - means.minCoeff();
  for (Index i = 1; i < means.size(); ++i)
    jumps += std::abs(means[i] - means[i - 1]) > 0.05 * range;
  return jumps > 4 && 5 * jumps < means.size() ? TestKind::valve_steps : TestKind::other;
}

TestKind of_rate(const Eigen::VectorXd& rate, double fastest) {
  if (fraction_at_two_levels(rate) > 0.6) return TestKind::constant_speed;
  return largest(rate) < 0.15 * fastest ? TestKind::slow_ramp : TestKind::fast_ramp;
}

}  // namespace

double fastest_motion(const std::vector<const DriveRecord*>& records) {
  double fastest = 0.0;
  for (const DriveRecord* record : records) {
    const Eigen::VectorXd& seen =
        record->rate_command && largest(record->rate_command->values) > 0.0
            ? record->rate_command->values
            : record->motor_rate.values;
    fastest = std::max(fastest, largest(seen));
  }
  return fastest;
}

TestKind recognised_test(const DriveRecord& record, double fastest) {
  const auto& rate = record.rate_command;
  const auto& valve = record.valve_command;
  if (rate && is_driven(*rate, fastest)) return of_rate(rate->values, fastest);
  if (valve && is_driven(*valve, fastest)) return of_valve(record, valve->values);
  if (largest(record.motor_rate.values) <= 0.0) return TestKind::other;
  if (record.rate_command) {  // the valve driven, and not recorded
    const double duration = record.sample_time * static_cast<double>(record.samples());
    return duration < 20.0 ? TestKind::slosh : TestKind::other;
  }
  const Index width = block_width(record, 0.1);
  const Eigen::VectorXd means = block_means(record.motor_rate.values, width);
  return of_rate(means, fastest);
}

}  // namespace boresight::identification
