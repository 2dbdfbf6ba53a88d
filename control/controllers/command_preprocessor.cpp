#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

void require_positive(const char* what, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidInput(
      fmt::format("command preprocessor: expected a positive finite {}, found {}", what, value));
}

// The root x >= 0 of T x/2 + D(x) = way, where T x/2 + D(x) = T (n x - A T n (n - 1)/2).
double approach_rate(double way, double acceleration, double sample_time) {
  const double step = acceleration * sample_time;  // of the rate, in a sample
  const double triangular = way / (step * sample_time);
  const double n = std::max(1.0, std::ceil(0.5 * (std::sqrt(1.0 + 8.0 * triangular) - 1.0)));
  return way / (n * sample_time) + 0.5 * step * (n - 1.0);
}

}  // namespace

CommandPreprocessor::CommandPreprocessor(CommandLimits limits, double sample_time,
                                         CommandSample start)
    : limits_(limits), sample_time_(sample_time), now_(start) {
  require_positive("rate limit", limits.rate);
  require_positive("acceleration limit", limits.acceleration);
  require_positive("sample time", sample_time);
  if (!std::isfinite(start.angle) || !(std::abs(start.rate) <= limits.rate)) {
    throw InvalidInput(fmt::format(
        "command preprocessor: expected a start at a finite angle, no faster than {} rad/s, found "
        "{} rad and {} rad/s",
        limits.rate, start.angle, start.rate));
  }
}

const CommandSample& CommandPreprocessor::advance(double angle, double rate) {
  if (!std::isfinite(angle) || !std::isfinite(rate)) {
    throw InvalidInput(fmt::format(
        "command preprocessor: expected a finite target, found {} rad and {} rad/s", angle, rate));
  }
  const double step = limits_.acceleration * sample_time_;
  const double lowest = std::max(now_.rate - step, -limits_.rate);
  const double highest = std::min(now_.rate + step, limits_.rate);
  // Way to go beyond what this sample goes anyway if it ends at the target's rate.
  const double way = angle - now_.angle - 0.5 * sample_time_ * (now_.rate + rate);
  // Angles are known to the rounding that samples have added up: what is nearer than that is
  // reached, and what is left of the rate is no more than the limit's rounding.
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  const double known = rounding * (std::abs(angle) + std::abs(now_.angle) + step * sample_time_);
  const double slack = 1e-10 * step;
  CommandSample next;
  if (std::abs(way) <= known && rate >= lowest - slack && rate <= highest + slack) {
    next.angle = angle;
    next.rate = rate;
  } else {
    const double relative =
        std::copysign(approach_rate(std::abs(way), limits_.acceleration, sample_time_), way);
    next.rate = std::clamp(rate + relative, lowest, highest);
    next.angle = now_.angle + 0.5 * sample_time_ * (now_.rate + next.rate);
  }
  next.acceleration = (next.rate - now_.rate) / sample_time_;
  return now_ = next;
}

double min_move_time(const CommandLimits& limits, double distance) {
  require_positive("rate limit", limits.rate);
  require_positive("acceleration limit", limits.acceleration);
  const double way = std::abs(distance);
  const double reach = limits.rate * limits.rate / limits.acceleration;  // up to the limit and down
  return way <= reach ? 2.0 * std::sqrt(way / limits.acceleration)
                      : way / limits.rate + limits.rate / limits.acceleration;
}

}  // namespace boresight::control
