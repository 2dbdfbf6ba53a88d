#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/QR>
#include <fmt/format.h>

#include <boresight/design/commissioning/stage_record.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::ServoRecord;
using identification::Signal;

constexpr Index fewest_samples = 100;
constexpr double settled = 0.05;
// A sample-to-sample change of the command is a step above this part of the largest one.
constexpr double step_part = 0.5;
// A change so many times the median change is a step, not a motion.
constexpr double step_over_motion = 20.0;
// What the response is smoothed over, in rise times: for its largest value, and for settling, which
// one noisy sample would delay.
constexpr double smoothing = 1.0 / 15.0;
constexpr double smoothing_for_settling = 0.5;

struct Line {
  double start = 0.0, slope = 0.0;

  double at(double sample) const { return start + slope * sample; }
};

Line line_through(const Eigen::Ref<const VectorXd>& values) {
  const Index n = values.size();
  if (n == 1) return {values[0], 0.0};
  const double middle = 0.5 * static_cast<double>(n - 1);
  const VectorXd from_middle = VectorXd::LinSpaced(n, -middle, middle);
  const double slope = from_middle.dot(values) / from_middle.squaredNorm();
  return {values.mean() - slope * middle, slope};
}

VectorXd without_line(const VectorXd& values) {
  const Line line = line_through(values);
  return values - VectorXd::LinSpaced(values.size(), line.start,
                                      line.at(static_cast<double>(values.size() - 1)));
}

// Samples at which the command has a new value.
std::vector<Index> steps_of(const VectorXd& command) {
  VectorXd change =
      (command.tail(command.size() - 1) - command.head(command.size() - 1)).cwiseAbs();
  const double largest = change.maxCoeff();
  VectorXd sorted = change;
  std::ranges::nth_element(sorted, sorted.begin() + sorted.size() / 2);
  if (!(largest > step_over_motion * sorted[sorted.size() / 2])) return {};
  std::vector<Index> steps;
  for (Index k = 0; k < change.size(); ++k) {
    if (change[k] > step_part * largest) steps.push_back(k + 1);
  }
  return steps;
}

// Responses over their steps, on the samples of the shortest.
struct StepResponses {
  std::vector<VectorXd> single;
  double noise = 0.0;  // standard, before the steps, over the step
  double size = 0.0;   // mean of the steps' sizes
};

StepResponses step_responses(const VectorXd& command, const VectorXd& response,
                             const std::vector<Index>& steps) {
  constexpr Index fewest = 10;  // samples before a step and of one
  Index shortest = command.size();
  std::vector<Index> usable;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Index before = steps[i] - (i == 0 ? 0 : steps[i - 1]);
    const Index after = (i + 1 < steps.size() ? steps[i + 1] : command.size()) - steps[i];
    if (before < fewest || after < fewest) continue;
    usable.push_back(steps[i]);
    shortest = std::min({shortest, after, i == 0 ? after : before});
  }
  StepResponses found;
  for (const Index step : usable) {
    const Index before = std::min(step, shortest);
    // What the step before left decays in the first half.
    const Index fitted = std::max<Index>(fewest, before / 2);
    const Line from = line_through(command.segment(step - fitted, fitted));
    const Line seen = line_through(response.segment(step - fitted, fitted));
    const double size = command[step] - from.at(static_cast<double>(fitted));
    if (size == 0.0) continue;
    VectorXd over(shortest);
    for (Index k = 0; k < shortest; ++k) {
      over[k] = (response[step + k] - seen.at(static_cast<double>(fitted + k))) / size;
    }
    VectorXd noise = response.segment(step - fitted, fitted);
    for (Index k = 0; k < fitted; ++k) noise[k] -= seen.at(static_cast<double>(k));
    found.noise += noise.norm() / std::sqrt(static_cast<double>(fitted)) / std::abs(size);
    found.size += std::abs(size);
    found.single.push_back(std::move(over));
  }
  if (found.single.empty()) return found;
  found.noise /= static_cast<double>(found.single.size());
  found.size /= static_cast<double>(found.single.size());
  return found;
}

VectorXd smoothed(const VectorXd& values, Index reach) {
  VectorXd result(values.size());
  for (Index k = 0; k < values.size(); ++k) {
    const Index first = std::max<Index>(0, k - reach);
    const Index last = std::min(values.size() - 1, k + reach);
    result[k] = values.segment(first, last - first + 1).mean();
  }
  return result;
}

// First time at which the samples reach a level; none if they do not.
std::optional<double> time_at(const VectorXd& values, double level, double sample_time) {
  for (Index k = 1; k < values.size(); ++k) {
    if (values[k] < level) continue;
    const double part = (level - values[k - 1]) / (values[k] - values[k - 1]);
    return sample_time * (static_cast<double>(k - 1) + std::clamp(part, 0.0, 1.0));
  }
  return std::nullopt;
}

std::optional<double> rise_time(const VectorXd& values, double sample_time) {
  const auto low = time_at(values, 0.1, sample_time);
  const auto high = time_at(values, 0.9, sample_time);
  return low && high ? std::optional(*high - *low) : std::nullopt;
}

struct StepFigures {
  std::optional<double> rise, settling;
  double overshoot = 0.0;
};

StepFigures figures_of(const VectorXd& response, double sample_time) {
  StepFigures figures;
  const auto rough = rise_time(response, sample_time);
  const auto smooth_over = [&](double rise_times) {
    return smoothed(response,
                    rough ? static_cast<Index>(0.5 * rise_times * *rough / sample_time) : Index{0});
  };
  const VectorXd smooth = smooth_over(smoothing);
  figures.rise = rise_time(smooth, sample_time);
  figures.overshoot = std::max(0.0, smooth.maxCoeff() - 1.0);
  const VectorXd slow = smooth_over(smoothing_for_settling);
  Index last = slow.size() - 1;
  while (last >= 0 && std::abs(slow[last] - 1.0) <= settled) --last;
  // Settled for the last tenth of the step at least, else it may leave again.
  if (last + 1 < slow.size() - slow.size() / 10) {
    figures.settling = sample_time * static_cast<double>(last + 1);
  }
  return figures;
}

// Scatter of the single steps about their mean, of the mean; of one step, what its noise makes.
template <typename Figure>
double uncertainty_of(const StepResponses& responses, double sample_time, const Figure& figure,
                      double by_noise) {
  std::vector<double> values;
  for (const auto& one : responses.single) {
    if (const std::optional<double> value = figure(figures_of(one, sample_time))) {
      values.push_back(*value);
    }
  }
  if (values.size() < 2) return by_noise;
  double mean = 0.0;
  double square = 0.0;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) mean += value / count;
  for (const double value : values) square += std::pow(value - mean, 2);
  return std::sqrt(square / (count - 1.0) / count);
}

void measure_steps(const VectorXd& command, const VectorXd& response,
                   const std::vector<Index>& steps, double sample_time,
                   StageMeasurement& measurement) {
  const StepResponses responses = step_responses(command, response, steps);
  if (responses.single.empty()) {
    measurement.remarks.emplace_back(
        "the command steps, but no step has 10 samples before and behind it");
    return;
  }
  VectorXd mean = VectorXd::Zero(responses.single.front().size());
  const auto count = static_cast<double>(responses.single.size());
  for (const auto& one : responses.single) mean += one / count;
  const StepFigures figures = figures_of(mean, sample_time);
  measurement.step_size = responses.size;
  const std::size_t averaged = responses.single.size();
  const double noise = responses.noise / std::sqrt(count);
  const auto add = [&](StageQuantity quantity, double value, const auto& figure, double by_noise) {
    measurement.quantities.push_back(
        {quantity, value, std::max(uncertainty_of(responses, sample_time, figure, by_noise), 0.0),
         averaged});
  };
  if (!figures.rise) {
    measurement.remarks.emplace_back("the response does not reach 90 % of the step");
    return;
  }
  // Both ends are read to half a sample, and at the slope 0.8/rise.
  const double by_noise =
      std::hypot(noise * *figures.rise / 0.8 * std::sqrt(2.0), 0.5 * sample_time);
  add(
      StageQuantity::rise_time, *figures.rise, [](const StepFigures& one) { return one.rise; },
      by_noise);
  add(
      StageQuantity::overshoot, figures.overshoot,
      [](const StepFigures& one) { return std::optional(one.overshoot); }, noise);
  if (figures.settling) {
    add(
        StageQuantity::settling_time, *figures.settling,
        [](const StepFigures& one) { return one.settling; }, by_noise);
  } else {
    measurement.remarks.emplace_back(
        "the step is not settled within 5 % for its last tenth: settling is not measured");
  }
}

// Standard uncertainty of the rms of correlated samples, relative: half that of their mean square.
double relative_uncertainty(const VectorXd& values) {
  const Index n = values.size();
  const double variance = values.squaredNorm() / static_cast<double>(n);
  if (!(variance > 0.0)) return 0.0;
  double sum = 1.0;
  for (Index lag = 1; lag < n / 4; ++lag) {
    const double correlation =
        values.head(n - lag).dot(values.tail(n - lag)) / (static_cast<double>(n - lag) * variance);
    // From here on it is noise of the estimate.
    if (correlation < 0.05) break;
    sum += 2.0 * correlation * correlation;
  }
  return std::sqrt(0.5 * sum / static_cast<double>(n));
}

void measure_rms(StageQuantity quantity, const std::optional<Signal>& signal, double scale,
                 StageMeasurement& measurement) {
  if (!signal) {
    measurement.remarks.push_back(fmt::format("no channel for the {}", to_string(quantity)));
    return;
  }
  const VectorXd values = without_line(signal->values);
  const double rms = scale * values.norm() / std::sqrt(static_cast<double>(values.size()));
  measurement.quantities.push_back({quantity, rms, rms * relative_uncertainty(values), 0});
}

bool predicts(const CommissioningStage& stage, StageQuantity quantity) {
  const auto quantities = measured_quantities(stage);
  return std::ranges::find(quantities, quantity) != quantities.end();
}

}  // namespace

StageMeasurement measure_stage(const ServoRecord& record, const CommissioningStage& stage,
                               double gear_ratio) {
  const bool open = stage.controller.position_open;
  const auto& command = open ? record.rate_command : record.position_command;
  const auto& response = open ? record.motor_rate : record.encoder;
  const Signal* longest = nullptr;
  for (const auto* signal : {&command, &response, &record.valve_command, &record.position_error}) {
    if (*signal) longest = &**signal;
  }
  if (longest == nullptr) {
    throw InvalidInput(fmt::format(
        "{}: expected {} or the valve command, found none", record.name,
        open ? "rate command and tachometer" : "position command, encoder, position error"));
  }
  if (!(record.sample_time > 0.0) || longest->values.size() < fewest_samples) {
    throw InvalidInput(
        fmt::format("{}: expected at least {} samples at a positive sample time, found {} at {} s",
                    record.name, fewest_samples, longest->values.size(), record.sample_time));
  }
  StageMeasurement measurement;
  const std::vector<Index> steps = command ? steps_of(command->values) : std::vector<Index>{};
  if (!steps.empty() && !stage.controller.feedforward) {
    if (response) {
      measure_steps(command->values, response->values, steps, record.sample_time, measurement);
    } else {
      measurement.remarks.push_back(fmt::format("the command steps, but there is no {} beside it",
                                                open ? "tachometer" : "encoder"));
    }
  } else if (predicts(stage, StageQuantity::move_error) && command && record.position_error &&
             without_line(command->values).cwiseAbs().maxCoeff() >
                 10.0 * record.position_error->values.cwiseAbs().maxCoeff()) {
    // About what was there before the move: a static error is none of the motion.
    const VectorXd& whole = record.position_error->values;
    const VectorXd error = whole.array() - whole.head(whole.size() / 20).mean();
    measurement.quantities.push_back({StageQuantity::move_error,
                                      gear_ratio * error.cwiseAbs().maxCoeff(),
                                      gear_ratio * error.tail(error.size() / 10).norm() /
                                          std::sqrt(static_cast<double>(error.size() / 10)),
                                      0});
  } else {
    measure_rms(StageQuantity::calm_valve, record.valve_command, 1.0, measurement);
    if (open) {
      measure_rms(StageQuantity::calm_tachometer, record.motor_rate, 1.0, measurement);
    } else {
      measure_rms(StageQuantity::calm_encoder, record.position_error, gear_ratio, measurement);
    }
  }
  std::erase_if(measurement.quantities, [&](const MeasuredQuantity& one) {
    if (predicts(stage, one.quantity)) return false;
    measurement.remarks.push_back(
        fmt::format("the stage predicts no {}: it is not evaluated", to_string(one.quantity)));
    return true;
  });
  return measurement;
}

std::vector<EvaluatedQuantity> evaluated(const StageMeasurement& measurement,
                                         const CommissioningStage& stage, double rms_allowance) {
  std::vector<EvaluatedQuantity> result;
  for (const MeasuredQuantity& one : measurement.quantities) {
    result.push_back({one, pass_interval(one.quantity, stage, rms_allowance),
                      abort_limit(one.quantity, stage),
                      verdict_on(one.quantity, one.value, one.uncertainty, stage, rms_allowance)});
  }
  return result;
}

StageVerdict worst_verdict(const std::vector<EvaluatedQuantity>& quantities) {
  StageVerdict worst = StageVerdict::passes;
  for (const EvaluatedQuantity& one : quantities) worst = std::max(worst, one.verdict);
  return worst;
}

}  // namespace boresight::design
