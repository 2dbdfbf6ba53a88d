#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/loops/command_loop.hpp>
#include <boresight/design/ensembles/ensemble_curves.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/point_response.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::design {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index speeds = 60;
constexpr Index step_times = 300;

ArrayXd sensitivity_grid(const TrackingProblem& problem) {
  constexpr double lowest = 0.01;  // Hz
  constexpr double points_per_decade = 150.0;
  const auto band = analysis_band(problem);
  const double from = std::max(lowest, problem.rms_band.lowest);
  const auto points =
      static_cast<Index>(std::ceil(points_per_decade * std::log10(band.highest / from))) + 1;
  return two_pi * ArrayXd::LinSpaced(points, std::log(from), std::log(band.highest)).exp();
}

std::array<ArrayXd, 3> sensitivities(const plant::AntennaPlant& plant, double delay,
                                     const control::Controller& controller,
                                     const ArrayXd& frequency) {
  const auto response = plant::plant_response(plant, frequency);
  std::array<ArrayXd, 3> found;
  for (std::size_t b = 0; b < found.size(); ++b) {
    found.at(b).resize(frequency.size());
    for (Index i = 0; i < frequency.size(); ++i) {
      const auto gain = control::loop_gain(plant::point(response, i), frequency[i], controller,
                                           delay, control::loop_breaks.at(b));
      found.at(b)[i] = 1.0 / std::abs(1.0 + gain);
    }
  }
  return found;
}

// The problem's wind at each speed, its spectrum as a table.
struct WindAtSpeeds {
  ArrayXd speed;
  std::vector<WindTable> tables;
};

WindAtSpeeds wind_at_speeds(TrackingProblem problem, double highest) {
  WindAtSpeeds winds;
  winds.speed = ArrayXd::LinSpaced(speeds, highest / static_cast<double>(speeds), highest);
  problem.climate.clear();
  for (const double speed : winds.speed) {
    problem.wind.mean_speed = speed;
    winds.tables.emplace_back(problem);
  }
  return winds;
}

ArrayXd rms_at_speeds(const TrackingProblem& problem, const control::Controller& controller,
                      const WindAtSpeeds& winds) {
  const ArrayXd frequency = analysis_grid(problem);
  control::LoopEvaluator evaluator(problem.plant, frequency,
                                   {.delay = problem.delay,
                                    .noise = problem.noise,
                                    .wind_spectrum = ArrayXd::Zero(frequency.size()),
                                    .band = problem.rms_band});
  const ArrayXd weight = evaluator.integration_weight() * evaluator.wind_transmission(controller);
  const double noise = evaluator.evaluate(controller, false).noise_variance;
  ArrayXd rms(winds.speed.size());
  for (Index k = 0; k < rms.size(); ++k) {
    const WindTable& table = winds.tables[static_cast<std::size_t>(k)];
    double variance = noise;
    for (Index i = 0; i < frequency.size(); ++i) {
      if (weight[i] > 0.0) variance += weight[i] * table.spectrum(frequency[i]);
    }
    rms[k] = std::sqrt(variance) / problem.gear_ratio;
  }
  return rms;
}

using CommandLoop = plant::StateSpace (*)(const plant::StateSpace&, const control::Controller&,
                                          double);

// The loop's first output after a unit step of its first input, at equal steps from 0.
ArrayXd step_response(const plant::StateSpace& loop, double step, Index count) {
  Eigen::MatrixXd input = Eigen::MatrixXd::Zero(count, static_cast<Index>(loop.inputs.size()));
  input.col(0).setOnes();
  plant::LinearSimulation simulation(loop, step);
  return simulation.simulate(input).col(0).array();
}

// When the response stays within 2 % of 1 for good: `longest` if it does not before that.
double settled_after(const plant::StateSpace& loop, double longest) {
  constexpr Index samples = 4000;
  constexpr double within = 0.02;
  const double step = longest / static_cast<double>(samples);
  const ArrayXd response = step_response(loop, step, samples);
  Index last = samples - 1;
  while (last > 0 && std::abs(response[last] - 1.0) <= within) --last;
  return step * static_cast<double>(last + 1);
}

ArrayXd step_grid(const plant::StateSpace& loop) {
  constexpr double longest = 120.0;  // s
  const double shown = std::min(1.5 * settled_after(loop, longest), longest);
  return ArrayXd::LinSpaced(step_times, 0.0, shown);
}

// One plant's curves.
struct PlantCurves {
  std::array<ArrayXd, 3> sensitivity;
  ArrayXd boresight_rms;
  std::array<ArrayXd, 2> steps;
};

EnsembleBand band_over(const ArrayXd& nominal, const std::vector<PlantCurves>& members,
                       const auto& curve) {
  EnsembleBand band{nominal, nominal, nominal};
  for (const PlantCurves& member : members) {
    const ArrayXd& values = curve(member);
    if (values.size() == 0) continue;
    band.lower = band.lower.min(values);
    band.upper = band.upper.max(values);
  }
  return band;
}

EnsembleCurves::Worst worst_at(std::size_t loop_break, const EnsembleResult& evaluated,
                               const std::vector<PlantCurves>& members) {
  EnsembleCurves::Worst worst;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const MemberResult& member = evaluated.members[i];
    if (!member.stable || !(member.sensitivity_peaks.at(loop_break) > worst.peak)) continue;
    worst.member = member.name;
    worst.peak = member.sensitivity_peaks.at(loop_break);
    worst.sensitivity = members[i].sensitivity.at(loop_break);
  }
  return worst;
}

double beyond_step(const Eigen::ArrayXd& response) {
  return response.size() == 0 ? 0.0 : std::max(response.maxCoeff() - 1.0, 0.0);
}

}  // namespace

double StepOverEnsemble::overshoot() const {
  return beyond_step(response.nominal);
}

double StepOverEnsemble::largest_overshoot() const {
  return beyond_step(response.upper);
}

double highest_compared_speed(double mean_speed, const std::vector<double>& speed_limits) {
  double fastest = 1.5 * mean_speed;
  for (const double limit : speed_limits) {
    if (!(limit > 0.0) || !std::isfinite(limit)) continue;
    fastest = std::max(fastest, std::min(1.08 * limit, 3.0 * mean_speed));
  }
  return fastest;
}

EnsembleCurves ensemble_curves(const TrackingProblem& problem,
                               const std::vector<EnsembleMember>& members,
                               const control::Controller& controller,
                               const EnsembleResult& evaluated, double highest_speed,
                               unsigned threads) {
  control::validate(controller);
  if (members.size() != evaluated.members.size() || !(highest_speed > 0.0)) {
    throw InvalidInput(fmt::format(
        "ensemble_curves: expected as many members as were evaluated and a highest speed "
        "above 0, found {}, {} and {} m/s",
        members.size(), evaluated.members.size(), highest_speed));
  }
  constexpr std::array<CommandLoop, 2> command_loops{control::rate_command_loop,
                                                     control::position_command_loop};
  EnsembleCurves curves;
  curves.members = members.size();
  curves.stable = static_cast<std::size_t>(
      std::ranges::count_if(evaluated.members, [](const MemberResult& one) { return one.stable; }));
  curves.frequency = sensitivity_grid(problem);
  const WindAtSpeeds winds = wind_at_speeds(problem, highest_speed);
  curves.wind_speed = winds.speed;
  // A controller without a rate loop has none of its step.
  const std::size_t first =
      control::has_break(controller, control::LoopBreak::rate_loop_alone) ? 0 : 1;
  std::array<ArrayXd, 2> times;
  for (std::size_t loop = first; loop < times.size(); ++loop) {
    times.at(loop) = step_grid(
        command_loops.at(loop)(plant::to_state_space(problem.plant), controller, problem.delay));
  }
  const auto curves_of = [&](TrackingProblem of_plant) {
    PlantCurves found;
    found.sensitivity = sensitivities(of_plant.plant, of_plant.delay, controller, curves.frequency);
    found.boresight_rms = rms_at_speeds(of_plant, controller, winds);
    for (std::size_t loop = first; loop < times.size(); ++loop) {
      found.steps.at(loop) = step_response(
          command_loops.at(loop)(plant::to_state_space(of_plant.plant), controller, of_plant.delay),
          times.at(loop)[1], step_times);
    }
    return found;
  };
  const PlantCurves nominal = curves_of(problem);
  std::vector<PlantCurves> found(members.size());
  numerics::for_each_index(members.size(), threads, [&](std::size_t i) {
    if (!evaluated.members[i].stable) return;
    TrackingProblem of_member = problem;
    of_member.plant = members[i].plant;
    // Ranges of smooth integrands: a third of the points of the problem's own figures.
    of_member.points_per_decade = std::min(problem.points_per_decade, 100);
    found[i] = curves_of(std::move(of_member));
  });
  for (std::size_t b = 0; b < curves.sensitivity.size(); ++b) {
    curves.sensitivity.at(b) =
        band_over(nominal.sensitivity.at(b), found,
                  [b](const PlantCurves& one) -> const ArrayXd& { return one.sensitivity.at(b); });
    curves.worst.at(b) = worst_at(b, evaluated, found);
  }
  curves.boresight_rms =
      band_over(nominal.boresight_rms, found,
                [](const PlantCurves& one) -> const ArrayXd& { return one.boresight_rms; });
  const auto step = [&](std::size_t loop) {
    return StepOverEnsemble{
        times.at(loop),
        band_over(nominal.steps.at(loop), found,
                  [loop](const PlantCurves& one) -> const ArrayXd& { return one.steps.at(loop); })};
  };
  curves.rate_step = step(0);
  curves.position_step = step(1);
  return curves;
}

}  // namespace boresight::design
