#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/commissioning/sampled_step.hpp>
#include <boresight/design/commissioning/stage_record.hpp>
#include <boresight/design/commissioning/step_responses.hpp>
#include <boresight/identification/grey_box/grey_box_whiteness.hpp>
#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::ServoRecord;
using identification::Signal;

constexpr Index fewest_samples = 100;
// What the response is smoothed over, in rise times: for its largest value, and for settling, which
// one noisy sample would delay. The error of a move: in periods of the crossover.
constexpr double smoothing = 1.0 / 15.0;
constexpr double smoothing_for_settling = 0.5;
constexpr double smoothing_of_move = 1.0 / 20.0;

// The longest stretch without an invalid sample.
VectorXd longest_valid(const Signal& signal) {
  Index best = 0, best_length = 0, first = 0;
  for (Index k = 0; k <= signal.values.size(); ++k) {
    if (k < signal.values.size() && signal.is_valid(k)) continue;
    if (k - first > best_length) {
      best = first;
      best_length = k - first;
    }
    first = k + 1;
  }
  return signal.values.segment(best, best_length);
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

struct StepFigures {
  std::optional<double> rise, settling;
  double overshoot = 0.0;
};

StepFigures figures_of(const VectorXd& response, double sample_time) {
  StepFigures figures;
  const double rough = rise_time(response, sample_time);
  const auto smooth_over = [&](double rise_times) {
    return smoothed(response, std::isfinite(rough)
                                  ? static_cast<Index>(0.5 * rise_times * rough / sample_time)
                                  : Index{0});
  };
  const VectorXd smooth = smooth_over(smoothing);
  if (const double rise = rise_time(smooth, sample_time); std::isfinite(rise)) figures.rise = rise;
  figures.overshoot = std::max(0.0, smooth.maxCoeff() - 1.0);
  const VectorXd slow = smooth_over(smoothing_for_settling);
  const Index settled = settled_from(slow);
  // For the last tenth of the step at least, else it may leave again.
  if (settled < slow.size() - slow.size() / 10) {
    figures.settling = sample_time * static_cast<double>(settled);
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

void measure_steps(const Signal& command, const Signal& response,
                   const std::vector<CommandStep>& steps, double sample_time,
                   const CommissioningStage& stage, StageMeasurement& measurement) {
  // Twice the rise that is expected.
  const double rise = stage.expected.rise_time.nominal;
  const auto least = static_cast<Index>(std::max(20.0, std::ceil(2.0 * rise / sample_time)));
  const StepResponses responses = step_responses(command, response, steps, least);
  if (responses.masked > 0) {
    measurement.remarks.push_back(
        fmt::format("{} of {} steps are left out: they hold missing or clipped samples",
                    responses.masked, steps.size()));
  }
  if (responses.hurried > 0) {
    measurement.remarks.push_back(
        fmt::format("{} of {} steps are left out: they last less than {:.3g} s, or follow too soon",
                    responses.hurried, steps.size(), static_cast<double>(least) * sample_time));
  }
  if (responses.single.empty()) {
    measurement.remarks.emplace_back("the command steps, but no step can be measured");
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
      std::hypot(noise * *figures.rise / 0.8 * std::numbers::sqrt2, 0.5 * sample_time);
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

VectorXd without_line(VectorXd values) {
  identification::remove_trend(values, identification::Detrend::line);
  return values;
}

// Standard uncertainty of the rms of correlated samples, relative: half that of their mean square.
double relative_uncertainty(const VectorXd& values) {
  const auto count = static_cast<double>(values.size());
  double sum = 1.0;
  for (const double correlation : identification::autocorrelations(values, values.size() / 10)) {
    // Less what the estimate's own noise adds.
    sum += 2.0 * std::max(0.0, correlation * correlation - 2.0 / count);
  }
  return std::sqrt(0.5 * sum / count);
}

void measure_rms(StageQuantity quantity, const std::optional<Signal>& signal, double scale,
                 StageMeasurement& measurement) {
  if (!signal) {
    measurement.remarks.push_back(fmt::format("no channel for the {}", to_string(quantity)));
    return;
  }
  const VectorXd valid = longest_valid(*signal);
  if (valid.size() < fewest_samples) {
    measurement.remarks.push_back(fmt::format("the {} has fewer than {} valid samples in a row",
                                              to_string(quantity), fewest_samples));
    return;
  }
  const VectorXd values = without_line(valid);
  const double rms = scale * values.norm() / std::sqrt(static_cast<double>(values.size()));
  measurement.quantities.push_back({quantity, rms, rms * relative_uncertainty(values), 0});
}

void measure_move(const Signal& error, const CommissioningStage& stage, double sample_time,
                  double gear_ratio, StageMeasurement& measurement) {
  if (!all_valid(error, 0, error.values.size())) {
    measurement.remarks.emplace_back("the record of the move holds missing or clipped samples");
    return;
  }
  // About what was there before the move: a static error is none of the motion.
  const Index before = error.values.size() / 20;
  const VectorXd about = error.values.array() - error.values.head(before).mean();
  const double reach =
      0.5 * smoothing_of_move * two_pi / (stage.expected.crossover.nominal * sample_time);
  const VectorXd smooth = smoothed(about, static_cast<Index>(std::clamp(reach, 0.0, 1e6)));
  // The largest value of noise lies some two deviations off.
  constexpr double of_largest = 2.0;
  const double noise = smooth.head(before).norm() / std::sqrt(static_cast<double>(before));
  measurement.quantities.push_back({StageQuantity::move_error,
                                    gear_ratio * smooth.cwiseAbs().maxCoeff(),
                                    gear_ratio * of_largest * noise, 0});
}

// The middle of the longest stretch in which the values are about their level while they are away
// from 0: the median of those above half of the largest, which may be an overshoot.
struct Plateau {
  Index first = 0, count = 0;
};

Plateau plateau_of(const VectorXd& values) {
  const double half = 0.5 * values.cwiseAbs().maxCoeff();
  std::vector<double> away;
  for (const double value : values) {
    if (std::abs(value) > half) away.push_back(std::abs(value));
  }
  if (away.empty()) return {};
  const double level = numerics::median(std::move(away));
  constexpr double about = 0.1;
  Plateau best, here;
  for (Index k = 0; k < values.size(); ++k) {
    if (std::abs(std::abs(values[k]) - level) > about * level) {
      here = {k + 1, 0};
      continue;
    }
    ++here.count;
    if (here.count > best.count) best = here;
  }
  return {best.first + best.count / 4, best.count / 2};
}

// Change of the steady valve command over that of the motor rate: of the longest steady motion
// against the start of the record.
void measure_valve(const Signal& rate, const Signal& valve, StageQuantity quantity,
                   StageMeasurement& measurement) {
  const Index before = std::max<Index>(rate.values.size() / 20, 2);
  const double start = rate.values.head(before).mean();
  const Index reach = std::max<Index>(rate.values.size() / 400, 1);
  const VectorXd moved = smoothed(rate.values, reach).array() - start;
  const Plateau plateau = plateau_of(moved);
  constexpr Index fewest = 20;
  if (plateau.count < fewest || !all_valid(rate, plateau.first, plateau.count) ||
      !all_valid(valve, plateau.first, plateau.count) || !all_valid(rate, 0, before) ||
      !all_valid(valve, 0, before)) {
    measurement.remarks.emplace_back("no steady motion of valid samples shows the valve's gain");
    return;
  }
  const auto deviation = [&](const VectorXd& values, Index first, Index count) {
    const VectorXd noise = without_line(values.segment(first, count));
    // As if a tenth of the samples were independent.
    constexpr double independent = 0.1;
    return noise.norm() / std::sqrt(static_cast<double>(count)) /
           std::sqrt(std::max(1.0, independent * static_cast<double>(count)));
  };
  const auto change = [&](const VectorXd& values) {
    return values.segment(plateau.first, plateau.count).mean() - values.head(before).mean();
  };
  const double rate_change = change(rate.values);
  const double ratio = change(valve.values) / rate_change;
  const double of_valve = std::hypot(deviation(valve.values, plateau.first, plateau.count),
                                     deviation(valve.values, 0, before));
  const double of_rate = std::hypot(deviation(rate.values, plateau.first, plateau.count),
                                    deviation(rate.values, 0, before));
  measurement.quantities.push_back(
      {quantity, ratio, std::hypot(of_valve, ratio * of_rate) / std::abs(rate_change), 0});
}

// What valve command, rate and torque say of the drive, whatever the command.
void measure_drive(const ServoRecord& record, const CommissioningStage& stage, bool rate_changes,
                   StageMeasurement& measurement) {
  if (!record.motor_rate || !record.valve_command) return;
  if (rate_changes) {
    measure_valve(*record.motor_rate, *record.valve_command, StageQuantity::valve_per_rate,
                  measurement);
  }
  if (!stage.flow || !record.motor_torque) return;
  if (rate_changes) {
    measure_valve(*record.motor_rate, valve_flow(record, *stage.flow), StageQuantity::flow_per_rate,
                  measurement);
  }
  if (const auto spring = oil_spring(record, *stage.flow)) {
    measurement.quantities.push_back(
        {StageQuantity::oil_stiffness, spring->stiffness, spring->uncertainty, 0});
  }
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
  if (!command || is_steady(command->values)) {
    measure_rms(StageQuantity::calm_valve, record.valve_command, 1.0, measurement);
    if (open) {
      measure_rms(StageQuantity::calm_tachometer, record.motor_rate, 1.0, measurement);
    } else {
      measure_rms(StageQuantity::calm_encoder, record.position_error, gear_ratio, measurement);
    }
  } else if (const auto steps = steps_of(command->values); !steps.empty()) {
    if (stage.controller.feedforward) {
      measurement.remarks.emplace_back("the command steps: the stage is checked by a move");
    } else if (!response) {
      measurement.remarks.push_back(fmt::format("the command steps, but no {} is beside it",
                                                open ? "tachometer" : "encoder"));
    } else {
      measure_steps(*command, *response, steps, record.sample_time, stage, measurement);
      measure_drive(record, stage, open, measurement);
    }
  } else if (stage.controller.feedforward && record.position_error) {
    measure_move(*record.position_error, stage, record.sample_time, gear_ratio, measurement);
    measure_drive(record, stage, true, measurement);
  } else {
    measurement.remarks.emplace_back(
        "the command moves without a step: neither a step nor still air can be read from it");
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
