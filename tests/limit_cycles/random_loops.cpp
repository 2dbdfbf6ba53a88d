#include "random_loops.hpp"

#include <cmath>

#include "random_numbers.hpp"
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/problem/standstill.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::limit_cycles {
namespace {

using reference::RandomNumbers;

// By the method of G. E. P. Box and M. E. Muller.
double normal(RandomNumbers& numbers) {
  const double size = std::sqrt(-2.0 * std::log(1.0 - numbers.uniform(0.0, 1.0)));
  return size * std::cos(numbers.uniform(0.0, two_pi));
}

std::vector<control::Controller> tuned(const design::Mission& mission,
                                       const design::TrackingProblem& problem, unsigned threads) {
  design::Constraints goals = design::constraints(mission);
  if (goals.standstill) {
    constexpr double hardly_any = 100.0;
    goals.standstill->sensitivity_peak = hardly_any;
  }
  const std::vector<const char*> names{"PI-0",   "PI",   "DPF",    "LL",      "FULL",
                                       "FULL+L", "LL+L", "FULL+C", "FULL+L+C"};
  std::vector<control::Controller> controllers(names.size());
  numerics::for_each_index(names.size(), threads, [&](std::size_t i) {
    design::TuningOptions options;
    options.starts = 6;
    controllers[i] =
        tune(problem, control::LoopStructure::named(names[i]), goals, options).controller;
  });
  return controllers;
}

}  // namespace

std::vector<RandomLoops> random_loops(const design::Mission& mission, std::size_t frictions,
                                      std::size_t controllers, std::uint64_t seed,
                                      unsigned threads) {
  const design::TrackingProblem problem = tracking_problem(mission);
  const std::vector<control::Controller> bases = tuned(mission, problem, threads);
  const plant::NonlinearAntenna antenna = plant::nonlinear_antenna(mission.antenna);
  RandomNumbers numbers(seed);
  std::vector<RandomLoops> all(frictions);
  for (RandomLoops& loops : all) {
    loops.antenna = make_simulated_loop(problem, antenna, bases.front());
    loops.antenna.encoder_resolution =
        design::encoder_step(mission.antenna) * problem.gear_ratio * numbers.log_uniform(0.3, 3.3);
    plant::FrictionCurve& friction = loops.antenna.antenna.friction.curve;
    const double scale = numbers.log_uniform(0.5, 2.0);
    friction.coulomb_torque *= scale;
    friction.saturating_torque *= scale;
    friction.breakaway_torque *= scale * numbers.log_uniform(1.0, 1.65);
    friction.stribeck_rate *= numbers.log_uniform(0.5, 2.0);
    while (loops.controllers.size() < controllers) {
      control::Controller controller =
          bases[static_cast<std::size_t>(numbers.integer(0, static_cast<int>(bases.size()) - 1))];
      for (double& gain : controller.gains) gain *= std::exp(0.7 * normal(numbers));
      if (control::stability(problem.plant, controller, problem.delay, {}).stable()) {
        loops.controllers.push_back(controller);
      }
    }
  }
  return all;
}

}  // namespace boresight::limit_cycles
