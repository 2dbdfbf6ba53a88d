#include <algorithm>
#include <limits>

#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/studies/what_if_study.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {
namespace {

// Rising, without those that are the same to a part in a million.
std::vector<double> rising(std::vector<double> values) {
  std::ranges::sort(values);
  std::vector<double> distinct;
  for (const double value : values) {
    if (distinct.empty() || value - distinct.back() > 1e-6 * values.back()) {
      distinct.push_back(value);
    }
  }
  return distinct;
}

std::vector<double> scaled(double value, const std::vector<double>& factors) {
  std::vector<double> values;
  for (const double factor : factors) values.push_back(factor * value);
  return rising(values);
}

bool in_table(const MatchPoint& point, double as_built) {
  return point.on_grid || point.disks == as_built;
}

FixedGainState state_of(const PlantOutcome& outcome) {
  if (!outcome.stable()) return FixedGainState::unstable;
  return outcome.violated_constraints != 0 ? FixedGainState::constraints_missed
                                           : FixedGainState::constraints_met;
}

}  // namespace

std::size_t WhatIfTable::place(std::size_t structure, std::size_t disk, std::size_t leakage,
                               std::size_t friction, std::size_t speed) const {
  std::size_t at = structure;
  at = at * disks.size() + disk;
  at = at * leakage_rates.size() + leakage;
  at = at * friction_slopes.size() + friction;
  return at * wind_speeds.size() + speed;
}

WhatIfTable what_if(const Mission& mission, const MatchingStudy& study,
                    const WhatIfOptions& options) {
  WhatIfTable table;
  table.leakage_rate = mission.antenna.drive.leakage_rate;
  table.friction_slope = study.friction;
  table.tracking_friction = study.tracking_friction;
  table.wind_speed = study.wind_speed;
  table.disks_as_built = mission.antenna.flywheels.disks;
  table.bands = mission.bands;
  table.budgets = mission.budgets;
  std::vector<std::size_t> points;
  for (std::size_t p = 0; p < study.points.size(); ++p) {
    if (!in_table(study.points[p], table.disks_as_built)) continue;
    points.push_back(p);
    table.disks.push_back(study.points[p].disks);
  }
  for (const auto& series : study.series) table.structures.push_back(series.name);
  table.leakage_rates = scaled(table.leakage_rate, {0.3, 0.4, 0.5, 0.62, 0.75, 0.87, 1.0, 1.3});
  const double tracking = study.tracking_friction;
  table.friction_slopes = rising({0.0, 0.5 * study.friction, study.friction, tracking / 3.0,
                                  tracking / 1.5, tracking, 1.5 * tracking});
  table.wind_speeds = scaled(study.wind_speed, {0.5, 0.75, 1.0, 1.25, 1.5, 2.0});

  const std::size_t controllers = table.structures.size() * points.size();
  const std::size_t entries =
      table.leakage_rates.size() * table.friction_slopes.size() * table.wind_speeds.size();
  table.boresight_rms.assign(controllers * entries, std::numeric_limits<double>::quiet_NaN());
  table.states.assign(controllers * entries, FixedGainState::unstable);

  std::vector<TrackingProblem> problems;
  for (const std::size_t p : points) {
    problems.push_back(
        tracking_problem(mission, {plant::set_to("motor.flywheel_disks", study.points[p].disks)}));
  }
  numerics::StepCounter counter(controllers, options.progress);
  numerics::for_each_index(controllers, options.threads, [&](std::size_t i) {
    if (options.interrupted && options.interrupted()) return;
    const std::size_t s = i / points.size(), d = i % points.size();
    const auto& controller = study.series[s].curve.controllers[points[d]];
    if (controller.status != TuningStatus::unstable) {
      for (std::size_t v = 0; v < table.wind_speeds.size(); ++v) {
        MonteCarlo held{problems[d], controller.controller, study.goals, 0, {}};
        held.problem.wind.mean_speed = table.wind_speeds[v];
        MonteCarloEvaluator evaluate(held);
        plant::AntennaPlant plant = held.problem.plant;
        for (std::size_t l = 0; l < table.leakage_rates.size(); ++l) {
          plant.drive.leakage_rate = table.leakage_rates[l];
          for (std::size_t f = 0; f < table.friction_slopes.size(); ++f) {
            plant.drive.viscous_friction = table.friction_slopes[f];
            const auto outcome = evaluate.evaluate(plant, false);
            const std::size_t place = table.place(s, d, l, f, v);
            table.states[place] = state_of(outcome);
            table.boresight_rms[place] = outcome.boresight_rms;
          }
        }
      }
    }
    counter.step();
  });
  return table;
}

}  // namespace boresight::design
