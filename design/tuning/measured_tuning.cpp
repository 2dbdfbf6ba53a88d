#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/measured/measured_confidence.hpp>
#include <boresight/design/tuning/measured_search.hpp>
#include <boresight/design/tuning/measured_tuning.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::LoopEvaluation;
using Eigen::Index;

constexpr std::size_t breaks = control::loop_breaks.size();
// Radius times relative error of the least favourable responses, at most: in the first round, and
// how much more in each round.
constexpr double first_step = 0.5;
constexpr double step_growth = 0.06;
// Least favourable responses of so many rounds are carried.
constexpr std::size_t rounds_carried = 2;

std::vector<double> logarithms(const std::vector<double>& gains) {
  std::vector<double> result(gains.size());
  std::ranges::transform(gains, result.begin(), [](double gain) { return std::log(gain); });
  return result;
}

void check(const MeasuredProblem& problem, const MeasuredConstraints& goals,
           const MeasuredTuningOptions& options) {
  if (options.starts < 1 || options.evaluations_per_run < 1 ||
      options.search_points_per_decade < 1 || options.rounds < 1 || problem.points_per_decade < 1) {
    throw InvalidInput(fmt::format(
        "tune on a measured response: expected at least 1 start, evaluation a run, point a decade "
        "and round, found {}, {}, {} (the problem's own: {}) and {}",
        options.starts, options.evaluations_per_run, options.search_points_per_decade,
        problem.points_per_decade, options.rounds));
  }
  if (!(std::ranges::min(goals.sensitivity_peak) > 1.0) || !(goals.control_effort > 0.0)) {
    throw InvalidInput(
        fmt::format("tune on a measured response: expected sensitivity peaks above 1 and a control "
                    "effort above "
                    "0, found {}, {}, {} and {}",
                    goals.sensitivity_peak[0], goals.sensitivity_peak[1], goals.sensitivity_peak[2],
                    goals.control_effort));
  }
}

// Adds least favourable responses of the last controller to the measured one, searches again, and
// so on until the controller stays where it is. result.controller: in, the best for the measured
// response; out, the best that holds within the confidence, if any does.
void make_confident(const MeasuredProblem& problem, const MeasuredConstraints& goals,
                    const MeasuredTuningOptions& options, MeasuredSearch& tuning,
                    std::vector<MeasuredMember>& members, MeasuredTuningResult& result) {
  constexpr double settled = 1e-3;  // change of every ln(gain), gain in rms
  const Eigen::ArrayXd grid = members.front().evaluator.response().frequency;
  const std::vector<double> nominal = logarithms(result.controller.gains);
  control::Controller controller = result.controller;
  std::vector<double> before = nominal;
  double largest_error = result.verification.largest_error;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < options.rounds && !result.stopped; ++round) {
    if (members.size() > 1 + (rounds_carried - 1) * breaks) {
      members.erase(members.begin() + 1, members.begin() + 1 + static_cast<std::ptrdiff_t>(breaks));
    }
    // A controller whose errors reach far is led towards a better one by smaller errors first.
    const double step = first_step + step_growth * round;
    const double radius = result.radius * std::min(1.0, step / std::max(largest_error, step));
    for (std::size_t b = 0; b < breaks; ++b) {
      members.push_back(tuning.least_favourable(controller, b, radius, grid));
    }
    // From the controller itself the optimiser may stall where peaks change places.
    const auto here = logarithms(controller.gains);
    std::vector<std::vector<double>> starts{here, nominal};
    if (before != nominal) starts.push_back(before);
    const auto point = tuning.refine(members, starts, result);
    ++result.rounds;
    if (!point) return;
    before = here;
    controller = tuning.controller_of(*point);
    const MeasuredVerification verification = verify(problem, controller, goals, result.radius);
    largest_error = verification.largest_error;
    const double rms = std::exp(point->cost);
    const bool holds = verification.passed && point->violation <= 0.0;
    const bool no_better = holds && rms > best * (1.0 - settled);
    if (holds && rms < best) {
      best = rms;
      result.controller = controller;
      result.verification = verification;
      result.status = MeasuredTuningStatus::confident;
    }
    double change = 0.0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      change = std::max(change, std::abs(point->point[k] - here[k]));
    }
    if (no_better || (std::isfinite(best) && change < settled)) return;
  }
}

// Fractions by evaluating the controller on the measured band alone and on what lies below and
// above it.
void find_fractions(const MeasuredProblem& problem, MeasuredTuningResult& result) {
  const Eigen::ArrayXd grid = measured_grid(problem, problem.points_per_decade, true);
  const double lowest = problem.channels.lowest_frequency() / two_pi;
  const double highest = problem.channels.highest_frequency() / two_pi;
  const control::LoopChannels channels = problem.channels.on(grid);
  const LoopEvaluation& all = result.evaluation;
  const auto fraction = [](double part, double whole) { return whole > 0.0 ? part / whole : 0.0; };
  const auto add = [&](control::FrequencyBand band, double AssumedFraction::*where) {
    if (!(band.highest > band.lowest)) return;
    auto evaluator = measured_evaluator(problem, channels, band);
    const LoopEvaluation part = evaluator.evaluate(result.controller, false);
    result.wind_fraction.*where += fraction(part.wind_variance, all.wind_variance);
    result.noise_fraction.*where += fraction(part.noise_variance, all.noise_variance);
    result.effort_fraction.*where += fraction(part.effort_variance, all.effort_variance);
  };
  const auto& rms = problem.rms_band;
  add({rms.lowest, std::min(lowest, rms.highest)}, &AssumedFraction::below);
  add({std::max(highest, rms.lowest), rms.highest}, &AssumedFraction::above);
  const auto add_all = [&](const std::vector<control::PointBand>& bands,
                           double AssumedFraction::*where) {
    for (const auto& band : bands) {
      add({std::max(band.lowest / two_pi, rms.lowest),
           std::min(band.highest / two_pi, rms.highest)},
          where);
    }
  };
  add_all(problem.channels.unresolved(), &AssumedFraction::unresolved);
  add_all(problem.channels.encoder_assumed(), &AssumedFraction::encoder);
}

// Central differences over the oil spring, gains fixed.
void find_oil_sensitivity(const MeasuredProblem& problem, MeasuredTuningResult& result) {
  constexpr double step = 1e-3;
  const Eigen::ArrayXd grid = measured_grid(problem, problem.points_per_decade, false);
  const auto log_rms = [&](double stiffness, double loss) {
    const control::OilSpring& oil = problem.channels.oil();
    const auto channels = problem.channels.with_oil(
        {oil.stiffness * std::exp(stiffness), oil.loss_rate * std::exp(loss)});
    auto evaluator = measured_evaluator(problem, channels.on(grid), problem.rms_band);
    return 0.5 * std::log(evaluator.evaluate(result.controller, false).boresight_variance());
  };
  result.by_stiffness = (log_rms(step, 0.0) - log_rms(-step, 0.0)) / (2.0 * step);
  result.by_loss_rate = (log_rms(0.0, step) - log_rms(0.0, -step)) / (2.0 * step);
}

void describe(const MeasuredConstraints& goals, MeasuredTuningResult& result) {
  for (std::size_t b = 0; b < breaks; ++b) {
    const auto& peak = result.verification.peaks[b].within_confidence;
    if (peak.magnitude < 0.995 * goals.sensitivity_peak[b]) continue;
    result.active_constraints.push_back(fmt::format("sensitivity peak at {}, {:.2f} Hz",
                                                    control::to_string(control::loop_breaks[b]),
                                                    peak.frequency / two_pi));
  }
  if (result.control_effort > 0.999 * goals.control_effort) {
    result.active_constraints.emplace_back("noise-driven control effort");
  }
  const auto& descriptions = control::gain_descriptions(result.controller.structure);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const double value = result.controller.gains[k];
    if (value < 1.001 * descriptions[k].lower || value > 0.999 * descriptions[k].upper) {
      result.gains_at_bound.push_back(descriptions[k].name);
    }
  }
}

}  // namespace

std::string_view to_string(MeasuredTuningStatus status) {
  switch (status) {
    case MeasuredTuningStatus::confident:
      return "goals met within the measurement's confidence";
    case MeasuredTuningStatus::nominal:
      return "goals met by the measured response, not within its confidence";
    case MeasuredTuningStatus::infeasible:
      return "goals not met";
    case MeasuredTuningStatus::unstable:
      return "no stable controller found";
  }
  throw InvalidInput("to_string: not a status");
}

Eigen::ArrayXd measured_grid(const MeasuredProblem& problem, int points_per_decade,
                             bool with_points) {
  const auto& channels = problem.channels;
  const double lowest = two_pi * std::min(problem.rms_band.lowest, 1e-4);
  const double highest = std::max(
      {two_pi * problem.rms_band.highest, two_pi * 25.0, 4.0 * channels.highest_frequency()});
  const auto intervals = static_cast<int>(
      std::ceil(std::log10(highest / lowest) * static_cast<double>(points_per_decade)));
  std::vector<double> points;
  for (int i = 0; i <= intervals; ++i) {
    points.push_back(lowest * std::pow(highest / lowest, static_cast<double>(i) / intervals));
  }
  for (const double edge : {two_pi * problem.rms_band.lowest, two_pi * problem.rms_band.highest,
                            two_pi * problem.noise.bandwidth, channels.lowest_frequency(),
                            channels.highest_frequency()}) {
    if (edge >= lowest && edge <= highest) points.push_back(edge);
  }
  if (with_points) {
    points.insert(points.end(), channels.frequency().begin(), channels.frequency().end());
  }
  std::ranges::sort(points);
  const auto copies =
      std::ranges::unique(points, [](double x, double y) { return y - x < 1e-9 * x; });
  points.erase(copies.begin(), copies.end());
  return Eigen::Map<Eigen::ArrayXd>(points.data(), static_cast<Index>(points.size()));
}

control::LoopEvaluator make_evaluator(const MeasuredProblem& problem) {
  const Eigen::ArrayXd grid = measured_grid(problem, problem.points_per_decade, true);
  return measured_evaluator(problem, problem.channels.on(grid), problem.rms_band);
}

MeasuredTuningResult tune(const MeasuredProblem& problem, const control::LoopStructure& structure,
                          const MeasuredConstraints& goals, const MeasuredTuningOptions& options) {
  check(problem, goals, options);
  if (structure.has_conditional_integral()) {
    throw InvalidInput(fmt::format(
        "tune on a measured response: expected a linear structure, found {}, of which a measured "
        "response cannot prove that it is stable for every error",
        structure.name()));
  }
  MeasuredTuningResult result;
  result.controller.structure = structure;
  result.confidence = problem.channels.has_covariance() ? options.confidence : 0.0;
  result.radius =
      control::confidence_radius(result.confidence, problem.channels.degrees_of_freedom());
  MeasuredSearch tuning(problem, structure, goals, options);
  std::vector<std::vector<double>> starts;
  for (auto& point : tuning.from_everywhere(result)) starts.push_back(std::move(point.point));
  if (starts.empty()) return result;

  const Eigen::ArrayXd grid = measured_grid(problem, problem.points_per_decade, true);
  std::vector<MeasuredMember> members;
  members.push_back(tuning.measured(grid));
  auto point = tuning.refine(members, starts, result);
  if (!point) return result;
  const bool feasible = point->violation <= 0.0;
  const control::Controller controller = tuning.controller_of(*point);
  result.nominal_rms = std::exp(point->cost);
  result.controller = controller;
  result.verification = verify(problem, controller, goals, result.radius);
  result.status = feasible ? MeasuredTuningStatus::nominal : MeasuredTuningStatus::infeasible;
  if (feasible && result.verification.passed) {
    result.status = MeasuredTuningStatus::confident;
  } else if (feasible && result.radius > 0.0) {
    make_confident(problem, goals, options, tuning, members, result);
  }

  result.evaluation = members.front().evaluator.evaluate(result.controller, true);
  result.rms = std::sqrt(result.evaluation.boresight_variance());
  result.wind_rms = std::sqrt(result.evaluation.wind_variance);
  result.noise_rms = std::sqrt(result.evaluation.noise_variance);
  result.control_effort = std::sqrt(result.evaluation.effort_variance);
  find_fractions(problem, result);
  find_oil_sensitivity(problem, result);
  describe(goals, result);
  return result;
}

}  // namespace boresight::design
