#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/records/integrated_motion.hpp>
#include <boresight/identification/signals/rate_smoothing.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

// Central differences, one-sided at the ends.
Eigen::VectorXd derivative(const Eigen::VectorXd& series, double sample_time) {
  const Eigen::Index count = series.size();
  Eigen::VectorXd slope(count);
  slope(0) = (series(1) - series(0)) / sample_time;
  slope(count - 1) = (series(count - 1) - series(count - 2)) / sample_time;
  slope.segment(1, count - 2) =
      (series.tail(count - 2) - series.head(count - 2)) / (2.0 * sample_time);
  return slope;
}

// Of the moving means: two of them make the smoothing time.
Eigen::Index half_width(double sample_time, double smoothing_time) {
  return std::max<Eigen::Index>(
      1, static_cast<Eigen::Index>(std::lround(0.25 * smoothing_time / sample_time)));
}

}  // namespace

Eigen::Index shortest_speed_window(double sample_time, double smoothing_time) {
  return 8 * half_width(sample_time, smoothing_time);
}

IntegratedMotion integrate_over_speed(const DriveRecord& record, const MotionWindow& window,
                                      double from_rate, double to_rate, double smoothing_time) {
  const double dt = record.sample_time;
  // Checks the window and the record, and gives the arrays their sizes.
  IntegratedMotion motion = integrate_motion(record, {window.first, window.last, 0}, dt);
  const Eigen::Index half = half_width(dt, smoothing_time);
  const Eigen::Index count = window.last - window.first + 1;
  if (!(smoothing_time > 0.0) || shortest_speed_window(dt, smoothing_time) > count) {
    throw InvalidInput(fmt::format(
        "integrate_over_speed: expected a positive smoothing time and a window of {} samples for "
        "it, found {} s and {} samples",
        shortest_speed_window(dt, smoothing_time), smoothing_time, count));
  }
  // Samples outside the window help to smooth its ends where there are any.
  const Eigen::Index before = std::min(window.first, 2 * half);
  const Eigen::Index after = std::min(record.samples() - 1 - window.last, 2 * half);
  const auto smooth = [&](const Eigen::VectorXd& series) {
    const Eigen::VectorXd once =
        moving_mean(series.segment(window.first - before, count + before + after), half);
    return Eigen::VectorXd(moving_mean(once, half).segment(before, count));
  };
  const Eigen::VectorXd rate = smooth(record.motor_rate.values);
  const Eigen::VectorXd acceleration = derivative(rate, dt);
  const Eigen::VectorXd jerk_rate = derivative(derivative(acceleration, dt), dt);
  // Steps between samples, cut to the two rates: the path's ends do not depend on where samples
  // lie.
  const auto [low, high] = std::minmax(from_rate, to_rate);
  const Eigen::VectorXd within = rate.cwiseMax(low).cwiseMin(high);
  const Eigen::Index steps = count - 1;
  const Eigen::VectorXd weight = within.tail(steps) - within.head(steps);
  const auto middle = [steps](const Eigen::VectorXd& series) {
    return Eigen::VectorXd(0.5 * (series.head(steps) + series.tail(steps)));
  };
  motion.window = window;
  motion.duration = weight.sum();
  motion.rate_change = weight.dot(middle(acceleration));
  motion.jerk = weight.dot(middle(jerk_rate));
  motion.mean_rate = 0.5 * (from_rate + to_rate);
  Eigen::Index channel = 0;
  for (const auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (const auto& signal : *side) {
      motion.pressure_impulse(channel++) = weight.dot(middle(smooth(signal.values)));
    }
  }
  motion.rate = middle(within);
  motion.rate_weight = weight;
  return motion;
}

}  // namespace boresight::identification
