#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/measured/measured_confidence.hpp>
#include <boresight/design/tuning/measured_tuning.hpp>

namespace boresight::design {
namespace {

using Complex = std::complex<double>;
using control::LoopBreak;
using Eigen::Index;

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
// Interpolating L and interpolating the responses that make it up differ between points.
constexpr double interpolation = 2e-3;

struct EncirclementCount {
  int unstable = 0;
  double gain_at_highest = 0.0;
};

// Zeros of 1 + L in the right half plane; L starts as c/s^integrators with c > 0.
EncirclementCount encirclements(const MeasuredProblem& problem,
                                const control::Controller& controller, LoopBreak loop_break,
                                int integrators, std::vector<control::PointBand>& open_steps) {
  const auto& channels = problem.channels;
  std::vector<double> frequency;
  constexpr double step = 1.02;
  for (double w = 2.0 * pi * std::min(problem.rms_band.lowest, 1e-4);
       w < channels.lowest_frequency() / std::sqrt(step); w *= step) {
    frequency.push_back(w);
  }
  frequency.insert(frequency.end(), channels.frequency().begin(), channels.frequency().end());
  const double start = -0.5 * pi * integrators;
  double angle = 0.0;
  Complex last = 0.0;
  EncirclementCount result;
  for (std::size_t i = 0; i < frequency.size(); ++i) {
    const double w = frequency[i];
    const Complex gain =
        control::loop_gain(channels.at(w), w, controller, problem.delay, loop_break);
    const Complex value = 1.0 + gain;
    if (i == 0) {
      angle = start + std::remainder(std::arg(value) - start, 2.0 * pi);
    } else {
      const double turn = std::arg(value / last);
      angle += turn;
      if (std::abs(turn) > 0.5 * pi) open_steps.push_back({frequency[i - 1], w});
    }
    last = value;
    result.gain_at_highest = std::abs(gain);
  }
  // With |L| < 1 from here on, 1 + L goes to 1 the short way. Its angle, having begun at `start`,
  // then is 0 for a stable loop; each zero in the right half plane takes pi away.
  const double end = angle - std::arg(last);
  result.unstable = static_cast<int>(std::lround(-end / pi));
  return result;
}

control::MeasuredLoop measured_loop(const MeasuredProblem& problem,
                                    const control::Controller& controller, LoopBreak loop_break) {
  control::MeasuredLoop loop;
  loop.frequency = problem.channels.frequency();
  loop.gain.resize(loop.frequency.size());
  for (Index i = 0; i < loop.frequency.size(); ++i) {
    const double w = loop.frequency[i];
    loop.gain[i] =
        control::loop_gain(problem.channels.at(w), w, controller, problem.delay, loop_break);
  }
  return loop;
}

void find_peak(const MeasuredProblem& problem, const control::Controller& controller,
               LoopBreak loop_break, double radius, const Eigen::ArrayXd& grid, MeasuredPeak& peak,
               double& largest_error) {
  const auto& channels = problem.channels;
  for (const double w : grid) {
    const auto loop =
        control::measured_loop_point(channels, controller, problem.delay, loop_break, w);
    const double measured = 1.0 / std::abs(1.0 + loop.loop_gain);
    if (measured > peak.measured.magnitude) peak.measured = {w, measured};
    double largest = measured;
    const double error = radius * loop.relative_error;
    largest_error = std::max(largest_error, error);
    if (error >= 1.0) {
      largest = infinity;
    } else if (error > 0.0) {
      const double length = radius / loop.relative_error;
      const auto worst =
          channels.changed(w, channels.covariance(w) * loop.log_sensitivity.adjoint() * length);
      largest =
          1.0 / std::abs(1.0 + control::loop_gain(worst, w, controller, problem.delay, loop_break));
    }
    if (largest > peak.within_confidence.magnitude) {
      peak.within_confidence = {w, largest};
      peak.basis = channels.basis(w);
    }
  }
}

}  // namespace

MeasuredVerification verify(const MeasuredProblem& problem, const control::Controller& controller,
                            const MeasuredConstraints& goals, double radius) {
  control::validate(controller);
  MeasuredVerification result;
  const int rate =
      controller.structure.count(control::LoopPath::rate, control::BlockKind::integral);
  const int position =
      controller.structure.count(control::LoopPath::position, control::BlockKind::integral);
  const EncirclementCount open =
      encirclements(problem, controller, LoopBreak::rate_loop_alone, rate, result.open_steps);
  const EncirclementCount closed = encirclements(problem, controller, LoopBreak::valve_command,
                                                 rate + position + 1, result.open_steps);
  result.unstable = {open.unstable, closed.unstable};
  result.gain_at_highest = {open.gain_at_highest, closed.gain_at_highest};

  // Between the tuner's points: the verdict is not to rest on where those stand.
  const Eigen::ArrayXd points = measured_grid(problem, problem.points_per_decade, true);
  Eigen::ArrayXd grid(2 * points.size() - 1);
  for (Index i = 0; i + 1 < points.size(); ++i) {
    grid[2 * i] = points[i];
    grid[2 * i + 1] = std::sqrt(points[i] * points[i + 1]);
  }
  grid[grid.size() - 1] = points[points.size() - 1];
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    const LoopBreak loop_break = control::loop_breaks[b];
    result.margins[b] = control::margins(measured_loop(problem, controller, loop_break));
    find_peak(problem, controller, loop_break, radius, grid, result.peaks[b], result.largest_error);
  }

  if (open.unstable != 0 || closed.unstable != 0) {
    result.failure = fmt::format(
        "1 + L winds as with {} unstable poles with the position loop open, {} with both closed",
        open.unstable, closed.unstable);
  } else if (!(std::max(open.gain_at_highest, closed.gain_at_highest) < 1.0)) {
    result.failure = fmt::format(
        "the loop gain is {:.2g} where the measurement ends, {:.3g} Hz: whether the loop is stable "
        "lies beyond it",
        std::max(open.gain_at_highest, closed.gain_at_highest),
        problem.channels.highest_frequency() / (2.0 * pi));
  } else if (!result.open_steps.empty()) {
    result.failure = fmt::format(
        "1 + L turns by more than 90 degrees from {:.4g} to {:.4g} Hz: the points are "
        "too far apart there to count its encirclements",
        result.open_steps.front().lowest / (2.0 * pi),
        result.open_steps.front().highest / (2.0 * pi));
  } else if (!(result.largest_error < 1.0)) {
    result.failure = "responses within the confidence reach -1: the loop may be unstable";
  }
  for (std::size_t b = 0; b < control::loop_breaks.size() && result.failure.empty(); ++b) {
    const double limit = goals.sensitivity_peak[b] * (1.0 + interpolation);
    const double on_points = result.margins[b].margins.sensitivity.magnitude;
    const double within = result.peaks[b].within_confidence.magnitude;
    if (std::max(on_points, within) <= limit) continue;
    result.failure = fmt::format(
        "sensitivity at {} reaches {:.4g} on the measured points and {:.4g} within the confidence "
        "({:.3g} Hz), allowed {:g}",
        control::to_string(control::loop_breaks[b]), on_points, within,
        result.peaks[b].within_confidence.frequency / (2.0 * pi), goals.sensitivity_peak[b]);
  }
  result.passed = result.failure.empty();
  return result;
}

}  // namespace boresight::design
