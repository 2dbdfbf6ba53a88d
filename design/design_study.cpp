#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include <boresight/control/state_space_peaks.hpp>
#include <boresight/design/design_study.hpp>
#include <boresight/plant/plant_response.hpp>

namespace boresight::design {

Verification verify(const TrackingProblem& problem, const control::ControlLaw& law,
                    const HardGoals& goals) {
  Verification verification;
  control::LoopEvaluator evaluator = make_evaluator(problem);
  verification.spectral_rms = std::sqrt(evaluator.evaluate(law, false).beam_variance());
  verification.stability =
      control::stability(problem.plant, law, problem.delay, evaluator.response().frequency);
  verification.peaks = control::state_space_peaks(
      problem.plant, law, problem.delay, problem.lowest_frequency, problem.highest_frequency);
  bool passed = verification.stability.stable();
  for (std::size_t b = 0; b < verification.peaks.size(); ++b) {
    passed = passed && verification.peaks[b].magnitude <= goals.sensitivity_peak[b] * (1.0 + 1e-6);
  }
  if (verification.stability.stable()) {
    verification.lyapunov =
        control::lyapunov_rms(problem.plant, law, problem.delay,
                              fit_wind_filter(problem.wind, problem.gear_ratio), problem.noise);
    verification.rms_disagreement =
        std::abs(verification.lyapunov.total / verification.spectral_rms - 1.0);
    passed = passed && verification.rms_disagreement < 0.005;
  }
  verification.passed = passed;
  return verification;
}

Design solve(const DesignTask& task) {
  const TrackingProblem& problem = task.problem;
  Design design;
  design.name = task.name;
  design.tuning = tune(problem, task.structure, task.goals, task.options);
  design.hydraulic_mode = plant::hydraulic_mode(plant::plant_modes(problem.plant));
  design.reflected_inertia = plant::reflected_inertia(problem.plant);
  if (design.tuning.status == TuningStatus::unstable) {
    design.beam_rms = design.wind_rms = design.noise_rms = design.valve_effort =
        std::numeric_limits<double>::quiet_NaN();
    return design;
  }
  design.verification = verify(problem, design.tuning.law, task.goals);
  const auto& evaluation = design.tuning.evaluation;
  design.beam_rms = std::sqrt(evaluation.beam_variance()) / problem.gear_ratio;
  design.wind_rms = std::sqrt(evaluation.wind_variance) / problem.gear_ratio;
  design.noise_rms = std::sqrt(evaluation.noise_variance) / problem.gear_ratio;
  design.valve_effort = std::sqrt(evaluation.effort_variance);
  const Eigen::ArrayXd grid = plant::frequency_grid(problem.plant, problem.lowest_frequency,
                                                    problem.highest_frequency, 100);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    design.margins[b] = control::margins(
        [&](double w) {
          const auto response =
              plant::plant_response(problem.plant, Eigen::ArrayXd::Constant(1, w));
          return control::loop_gain(response, 0, design.tuning.law, problem.delay,
                                    control::loop_breaks[b]);
        },
        grid);
  }
  return design;
}

std::vector<Design> solve_all(const std::vector<DesignTask>& tasks, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<Design> designs(tasks.size());
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      try {
        designs[i] = solve(tasks[i]);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress(done, tasks.size());
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = tasks.size();
        return;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t count =
        std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(1, tasks.size()));
    for (std::size_t t = 1; t < count; ++t) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return designs;
}

}  // namespace boresight::design
