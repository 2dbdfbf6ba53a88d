#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/verification/integrator_agreement.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/numerics/statistics/double_sampling.hpp>

namespace boresight::design {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// |boresight / wind torque|^2 of the linear loop at the lines k/T, k = 1, 2, .., of a record of so
// many samples, below half the sampling rate (rad^2/(N m)^2 at the motor).
ArrayXd line_gains(const TrackingProblem& problem, const SimulatedLoop& loop, Index samples) {
  const Index lines = (samples - 1) / 2;
  const double step = two_pi / (loop.sample_time * static_cast<double>(samples));
  const ArrayXd frequency = step * ArrayXd::LinSpaced(lines, 1.0, static_cast<double>(lines));
  return wind_transmission(problem, loop.controller, frequency);
}

double mean_square(const VectorXd& errors, Index counted) {
  const auto rest = errors.tail(counted).array();
  return (rest - rest.mean()).square().mean();
}

void widen(numerics::Interval& interval, double numerical_error) {
  interval.lower = std::min(interval.lower, interval.value - numerical_error);
  interval.upper = std::max(interval.upper, interval.value + numerical_error);
}

}  // namespace

SimulatedRms simulated_rms(const TrackingProblem& problem, const SimulatedLoop& loop,
                           const SimulatedRmsOptions& options) {
  if (options.records < 4 || options.winds < options.records) {
    throw InvalidInput(
        fmt::format("simulated_rms: expected at least 4 records and as many winds, found {} and {}",
                    options.records, options.winds));
  }
  if (options.known.size() > options.records) {
    throw InvalidInput(fmt::format("simulated_rms: expected at most {} known records, found {}",
                                   options.records, options.known.size()));
  }
  const auto shared = options.shared ? options.shared : std::make_shared<SharedWinds>();
  const SharedWinds::Records records{problem, loop, options.tracking_rate * loop.gear_ratio,
                                     options.settling + options.duration};
  const auto courses = shared->courses(records);
  const auto counted = whole_samples(options.duration, loop.sample_time);
  const auto squares =
      shared->line_squares(records, counted, options.seed, options.winds, options.threads);
  // By Parseval, without the mean.
  const ArrayXd gains = line_gains(problem, loop, counted);
  const auto count = static_cast<double>(counted);
  VectorXd linear(options.winds), simulated(options.records);
  for (Index k = 0; k < linear.size(); ++k) {
    linear[k] = 2.0 * (squares->col(k) * gains).sum() / (count * count);
  }
  const Index known = options.known.size();
  simulated.head(known) = options.known;
  std::vector<RunStatus> ends(static_cast<std::size_t>(options.records), RunStatus::complete);
  numerics::for_each_index(
      ends.size() - static_cast<std::size_t>(known), options.threads, [&](std::size_t i) {
        const Index k = known + static_cast<Index>(i);
        LoopRunOptions how;
        how.seed = options.seed + static_cast<std::uint64_t>(k);
        const LoopRun run = run_loop(loop, courses->course(how.seed), how);
        ends[static_cast<std::size_t>(k)] = run.status;
        simulated[k] =
            run.status == RunStatus::complete ? mean_square(run.boresight_error, counted) : nan;
      });
  SimulatedRms result;
  result.status = *std::ranges::max_element(ends);
  result.records = options.records;
  result.winds = options.winds;
  result.seed = options.seed;
  result.rms = {nan, nan, nan, nan};
  if (result.status != RunStatus::complete) return result;
  const auto mean = numerics::mean_by_double_sampling(simulated, linear);
  const auto root = [](double square) { return std::sqrt(std::max(0.0, square)); };
  result.rms.value = root(mean.value);
  result.rms.lower = root(mean.lower);
  result.rms.upper = root(mean.upper);
  // To first order.
  result.rms.standard_uncertainty =
      mean.value > 0.0 ? 0.5 * mean.standard_uncertainty / result.rms.value : 0.0;
  widen(result.rms, integrator_agreement_limit * result.rms.value);
  result.mean_squares = std::move(simulated);
  result.linear_mean_squares = std::move(linear);
  return result;
}

std::optional<numerics::Interval> relative_change(const SimulatedFigure& from,
                                                  const SimulatedFigure& to) {
  const SimulatedRms &one = from.expected, &other = to.expected;
  const Index common = std::min(one.mean_squares.size(), other.mean_squares.size());
  const bool same_winds = one.seed == other.seed && one.winds == other.winds && common >= 4 &&
                          one.linear_mean_squares.size() == other.linear_mean_squares.size();
  const auto square = [](double value) { return value * value; };
  const double cycle = square(limit_cycle_rms(from.amplitude));
  const double base = square(one.rms.value) + cycle;
  if (!same_winds || !(base > 0.0)) return std::nullopt;
  const double constant = square(limit_cycle_rms(to.amplitude)) - cycle;
  const auto mean = numerics::mean_by_double_sampling(
      other.mean_squares.head(common) - one.mean_squares.head(common),
      other.linear_mean_squares - one.linear_mean_squares);
  const auto change = [&](double difference) {
    return std::sqrt(std::max(0.0, 1.0 + (difference + constant) / base)) - 1.0;
  };
  numerics::Interval result;
  result.value = change(mean.value);
  result.lower = change(mean.lower);
  result.upper = change(mean.upper);
  result.standard_uncertainty = 0.5 * mean.standard_uncertainty / base;
  // Of either loop's runs.
  widen(result, std::numbers::sqrt2 * integrator_agreement_limit);
  return result;
}

double left_open(const SimulatedFigure& one, const SimulatedFigure& other) {
  const auto change = relative_change(one, other);
  return change ? 0.5 * (change->upper - change->lower) : 0.0;
}

}  // namespace boresight::design
