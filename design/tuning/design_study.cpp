#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/analysis/absolute_stability.hpp>
#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/loops/conditional_loop.hpp>
#include <boresight/design/problem/mean_wind_load.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/tuning/plant_evaluator.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::design {

namespace {

// The same problem evaluated over the whole analysis band with noise white throughout: what a
// Lyapunov equation can be compared with.
TrackingProblem without_band_limits(TrackingProblem problem) {
  problem.rms_band = analysis_band(problem);
  problem.noise.encoder_rms *= std::sqrt(problem.rms_band.highest / problem.noise.bandwidth);
  problem.noise.tachometer_rms *= std::sqrt(problem.rms_band.highest / problem.noise.bandwidth);
  problem.noise.torque_rms *= std::sqrt(problem.rms_band.highest / problem.noise.bandwidth);
  problem.noise.bandwidth = problem.rms_band.highest;
  return problem;
}

std::array<control::Margins, 3> margins_of(TrackingProblem problem,
                                           const control::Controller& controller) {
  problem.points_per_decade = 100;
  const Eigen::ArrayXd all = analysis_grid(problem);
  const auto beyond = std::ranges::upper_bound(all, control::nyquist_frequency(controller));
  const Eigen::ArrayXd grid = all.head(beyond - all.begin());
  const plant::PointResponse response(problem.plant);
  std::array<control::Margins, 3> margins;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    if (!control::has_break(controller, control::loop_breaks[b])) {
      margins[b].increasing_gain_margin = margins[b].delay_margin =
          std::numeric_limits<double>::infinity();
      margins[b].sensitivity.magnitude = 1.0;
      continue;
    }
    margins[b] = control::margins(
        [&](double w) {
          return control::loop_gain(response(w), w, controller, problem.delay,
                                    control::loop_breaks[b]);
        },
        grid);
  }
  return margins;
}

constexpr double met = 1.0 + 1e-6;

// Margins from every crossover, bandwidth from |S| along the grid: the first goal missed.
std::string missed_margin(const TrackingProblem& problem, const control::Controller& controller,
                          const Constraints& goals) {
  const auto margins = margins_of(problem, controller);
  for (std::size_t b = 0; b < margins.size(); ++b) {
    if (!control::has_break(controller, control::loop_breaks[b])) continue;
    const std::string_view cut = control::to_string(control::loop_breaks[b]);
    const double gain =
        std::min(margins[b].increasing_gain_margin, 1.0 / margins[b].decreasing_gain_margin);
    if (goals.gain_margin[b].value_or(0.0) > gain * met) {
      return fmt::format("gain margin at {}: {:.6f} below {:g}", cut, gain,
                         goals.gain_margin[b].value_or(0.0));
    }
    const double phase = margins[b].phase_margin_deg * std::numbers::pi / 180.0;
    if (goals.phase_margin[b].value_or(0.0) > phase * met) {
      return fmt::format("phase margin at {}: {:.6f} rad below {:g}", cut, phase,
                         goals.phase_margin[b].value_or(0.0));
    }
  }
  const plant::PointResponse response(problem.plant);
  for (const double w : analysis_grid(problem)) {
    if (w * met > goals.bandwidth.value_or(0.0)) break;
    const auto loop = control::loop_gain(response(w), w, controller, problem.delay,
                                         control::LoopBreak::position_loop);
    if (std::norm(1.0 + loop) < 2.0) {
      return fmt::format(
          "bandwidth: |S| of the position loop above 0.707 at {:.6f} rad/s, below "
          "{:g}",
          w, goals.bandwidth.value_or(0.0));
    }
  }
  return {};
}

std::string missed_in_mean_wind(const TrackingProblem& problem,
                                const control::Controller& controller, const Constraints& goals) {
  PlantEvaluator plant("", problem, goals, WindTable(problem));
  for (const NormalisedConstraint& goal : plant.evaluate(controller, false).ratios) {
    const bool in_mean_wind = goal.kind == GoalKind::gust_demand ||
                              goal.kind == GoalKind::gust_torque ||
                              goal.kind == GoalKind::static_encoder_error;
    if (in_mean_wind && goal.ratio > met) {
      return fmt::format("{}: {:.6f} times its limit", describe(goal), goal.ratio);
    }
  }
  return {};
}

// On a grid so fine that the trapezoid rule errs by less than 1e-6.
double control_effort(TrackingProblem problem, const control::Controller& controller) {
  problem.points_per_decade *= 4;
  return std::sqrt(make_evaluator(problem).evaluate(controller, false).effort_variance);
}

// With each friction of Constraints::standstill, by eigenvalues and bracketed peaks.
std::string missed_standstill(const TrackingProblem& problem, const control::Controller& controller,
                              const Standstill& standstill, const Eigen::ArrayXd& frequency) {
  plant::AntennaPlant plant = problem.plant;
  control::Controller linear = controller;
  for (std::size_t i = 0; i < standstill.friction.size(); ++i) {
    const double friction = standstill.friction[i];
    plant.drive.viscous_friction = friction;
    if (!standstill.amplitude.empty()) {
      linear = control::linear_equivalent(controller, standstill.amplitude.at(i));
    }
    if (!control::stability(plant, linear, problem.delay, frequency).stable()) {
      return fmt::format("not stable at standstill, with a friction of {:.3g} N.m.s/rad", friction);
    }
    const auto peaks = control::sensitivity_bounds(plant, linear, problem.delay);
    const double peak = peaks[static_cast<std::size_t>(control::LoopBreak::valve_command)].upper;
    if (!(peak <= standstill.sensitivity_peak * met)) {
      return fmt::format("Ms at standstill, with a friction of {:.3g} N.m.s/rad: {:.6f} above {:g}",
                         friction, peak, standstill.sensitivity_peak);
    }
  }
  return {};
}

// While the integral holds, and for every error in between.
std::string missed_absolute_stability(const TrackingProblem& problem,
                                      const control::Controller& controller,
                                      const Eigen::ArrayXd& frequency) {
  const auto held = control::without_conditional_integral(controller);
  if (!control::stability(problem.plant, held, problem.delay, frequency).stable()) {
    return "not stable while the integral of the position loop holds";
  }
  const plant::PointResponse response(problem.plant);
  const auto proof = control::absolute_stability(
      [&](double w) {
        return control::conditional_loop_gain(response(w), w, controller, problem.delay);
      },
      frequency);
  if (proof.proven) return {};
  return fmt::format(
      "not proven stable for every error of the integral with a dead zone or freeze: 1 + Re (1 + j "
      "w q) L falls to {:.3g} at {:.3g} Hz",
      proof.distance, proof.frequency / two_pi);
}

}  // namespace

Verification verify(const TrackingProblem& problem, const control::Controller& controller,
                    const Constraints& goals) {
  Verification verification;
  const TrackingProblem whole = without_band_limits(problem);
  control::LoopEvaluator evaluator = make_evaluator(whole);
  verification.spectral_rms = std::sqrt(evaluator.evaluate(controller, false).boresight_variance());
  std::string not_absolute;
  try {
    verification.stability = control::stability(problem.plant, controller, problem.delay,
                                                evaluator.response().frequency);
    verification.peaks = control::sensitivity_bounds(problem.plant, controller, problem.delay);
    if (!verification.stability.stable()) {
      verification.failure = "the closed loop is not stable";
      return verification;
    }
    verification.lyapunov = control::lyapunov_rms(problem.plant, controller, problem.delay,
                                                  fit_wind_filter(problem), whole.noise);
    if (controller.structure.has_conditional_integral()) {
      not_absolute = missed_absolute_stability(problem, controller, evaluator.response().frequency);
    }
  } catch (const NumericalFailure& error) {
    verification.failure = error.what();
    return verification;
  }
  verification.rms_disagreement =
      std::abs(verification.lyapunov.total / verification.spectral_rms - 1.0);
  for (std::size_t b = 0; b < verification.peaks.size(); ++b) {
    if (!(verification.peaks[b].upper <= goals.sensitivity_peak[b] * (1.0 + 1e-6))) {
      verification.failure =
          fmt::format("Ms at {}: {:.6f} above {:g}", control::to_string(control::loop_breaks[b]),
                      verification.peaks[b].upper, goals.sensitivity_peak[b]);
    }
  }
  const double effort = control_effort(problem, controller);
  if (effort > goals.control_effort * (1.0 + 1e-5)) {
    verification.failure = fmt::format("noise-driven control effort {:.6f} rad/s above {:g}",
                                       effort, goals.control_effort);
  }
  if (goals.ask_for_margins()) {
    const std::string missed = missed_margin(problem, controller, goals);
    if (!missed.empty()) verification.failure = missed;
  }
  if (goals.ask_for_gusts() || goals.static_encoder_error) {
    const std::string missed = missed_in_mean_wind(problem, controller, goals);
    if (!missed.empty()) verification.failure = missed;
  }
  if (goals.standstill) {
    const std::string missed =
        missed_standstill(problem, controller, *goals.standstill, evaluator.response().frequency);
    if (!missed.empty()) verification.failure = missed;
  }
  if (!not_absolute.empty()) verification.failure = not_absolute;
  if (!(verification.rms_disagreement < 0.005)) {
    verification.failure = fmt::format("Lyapunov and spectral rms are {:.2g} % apart",
                                       100.0 * verification.rms_disagreement);
  }
  verification.passed = verification.failure.empty();
  return verification;
}

namespace {

Design finish(const DesignTask& task, TuningResult tuning) {
  const TrackingProblem& problem = task.problem;
  Design design;
  design.name = task.name;
  design.tuning = std::move(tuning);
  design.hydraulic_mode = plant::hydraulic_mode(plant::plant_modes(problem.plant));
  design.reflected_inertia = plant::reflected_inertia(problem.plant);
  if (design.tuning.status == TuningStatus::unstable) {
    design.boresight_rms = design.wind_rms = design.noise_rms = design.control_effort =
        std::numeric_limits<double>::quiet_NaN();
    return design;
  }
  design.verification = verify(problem, design.tuning.controller, task.goals);
  const auto& evaluation = design.tuning.evaluation;
  design.boresight_rms = std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio;
  design.wind_rms = std::sqrt(evaluation.wind_variance) / problem.gear_ratio;
  design.noise_rms = std::sqrt(evaluation.noise_variance) / problem.gear_ratio;
  design.control_effort = std::sqrt(evaluation.effort_variance);
  design.margins = margins_of(problem, design.tuning.controller);
  return design;
}

}  // namespace

Design solve(const DesignTask& task) {
  return finish(task, tune(task.problem, task.structure, task.goals, task.options));
}

Design assess(const TrackingProblem& problem, const control::Controller& controller,
              const Constraints& goals) {
  TuningResult given;
  given.controller = controller;
  control::LoopEvaluator evaluator = make_evaluator(problem);
  given.evaluation = evaluator.evaluate(controller, false);
  given.worst_constraint = worst_constraint(given.evaluation, goals);
  if (const auto& limit = goals.static_encoder_error) {
    const auto found = static_error_constraint(controller, mean_wind_load(problem).demand,
                                               problem.gear_ratio, *limit);
    given.worst_constraint = std::max(given.worst_constraint, found.ratio);
  }
  if (!control::stability(problem.plant, controller, problem.delay, evaluator.response().frequency)
           .stable()) {
    given.status = TuningStatus::unstable;
    given.worst_constraint = std::numeric_limits<double>::infinity();
  }
  Design design = finish({{}, problem, controller.structure, goals, {}}, std::move(given));
  if (design.verification.passed) design.tuning.status = TuningStatus::optimal;
  return design;
}

bool improve_from(const DesignTask& task, const std::vector<std::vector<double>>& starts,
                  Design& design) {
  if (starts.empty()) return false;
  TuningOptions options = task.options;
  options.starts = 0;
  options.warm_starts = starts;
  TuningResult tuning = tune(task.problem, task.structure, task.goals, options);
  const TuningResult& now = design.tuning;
  const bool better =
      tuning.status == TuningStatus::optimal && !tuning.interrupted &&
      (now.status != TuningStatus::optimal || tuning.soft_rms < (1.0 - 1e-4) * now.soft_rms);
  if (!better) return false;
  tuning.starts = now.starts;
  tuning.starts_at_optimum = 0;
  tuning.evaluations += now.evaluations;
  Design found = finish(task, std::move(tuning));
  if (!found.verification.passed) return false;
  design = std::move(found);
  return true;
}

void improve_along(const std::vector<DesignTask>& tasks, std::vector<Design>& designs) {
  if (tasks.size() != designs.size()) {
    throw InvalidInput(
        fmt::format("improve_along: expected as many designs as tasks, found {} and {}",
                    designs.size(), tasks.size()));
  }
  const auto improve = [&](std::size_t i, std::size_t neighbour) {
    const TuningResult& other = designs[neighbour].tuning;
    if (other.status == TuningStatus::optimal) {
      improve_from(tasks[i], {other.controller.gains}, designs[i]);
    }
  };
  for (std::size_t i = 1; i < tasks.size(); ++i) improve(i, i - 1);
  for (std::size_t i = tasks.size(); i-- > 1;) improve(i - 1, i);
}

std::vector<Design> solve_all(const std::vector<DesignTask>& tasks, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<Design> designs(tasks.size());
  numerics::StepCounter counter(tasks.size(), progress);
  numerics::for_each_index(tasks.size(), threads, [&](std::size_t i) {
    designs[i] = solve(tasks[i]);
    counter.step();
  });
  return designs;
}

}  // namespace boresight::design
