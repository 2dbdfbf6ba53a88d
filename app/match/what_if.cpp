#include <algorithm>
#include <limits>

#include <boresight/app/match/what_if.hpp>
#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {
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

HeldState state_of(const design::PlantOutcome& outcome) {
  if (!outcome.stable()) return HeldState::unstable;
  return outcome.broken_goals != 0 ? HeldState::goals_missed : HeldState::goals_met;
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

WhatIfTable what_if(const io::Case& antenna, const MatchSection& section,
                    const WhatIfOptions& options) {
  WhatIfTable table;
  table.leakage_rate = antenna.drive.leakage_rate.value;
  table.friction_slope = section.friction;
  table.tracking_friction = section.tracking_friction;
  table.wind_speed = section.wind_speed;
  table.disks_as_built = antenna.motor.flywheel_disks;
  table.bands = make_bands(antenna);
  table.budgets = make_budgets(antenna);
  std::vector<std::size_t> points;
  for (std::size_t p = 0; p < section.points.size(); ++p) {
    if (!in_table(section.points[p], table.disks_as_built)) continue;
    points.push_back(p);
    table.disks.push_back(section.points[p].disks);
  }
  for (const auto& series : section.series) table.structures.push_back(series.name);
  table.leakage_rates = scaled(table.leakage_rate, {0.3, 0.4, 0.5, 0.62, 0.75, 0.87, 1.0, 1.3});
  const double tracking = section.tracking_friction;
  table.friction_slopes = rising({0.0, 0.5 * section.friction, section.friction, tracking / 3.0,
                                  tracking / 1.5, tracking, 1.5 * tracking});
  table.wind_speeds = scaled(section.wind_speed, {0.5, 0.75, 1.0, 1.25, 1.5, 2.0});

  const std::size_t laws = table.structures.size() * points.size();
  const std::size_t entries =
      table.leakage_rates.size() * table.friction_slopes.size() * table.wind_speeds.size();
  table.beam_rms.assign(laws * entries, std::numeric_limits<double>::quiet_NaN());
  table.states.assign(laws * entries, HeldState::unstable);

  std::vector<design::TrackingProblem> problems;
  for (const std::size_t p : points) {
    problems.push_back(
        make_problem(antenna, {plant::set_to("motor.flywheel_disks", section.points[p].disks)}));
    // The sliders name one speed; a climate has no say in it.
    problems.back().climate.clear();
  }
  numerics::StepCounter counter(laws, options.progress);
  numerics::for_each_index(laws, options.threads, [&](std::size_t i) {
    if (options.interrupted && options.interrupted()) return;
    const std::size_t s = i / points.size(), d = i % points.size();
    const auto& law = section.series[s].curve.laws[points[d]];
    if (law.status != design::TuningStatus::unstable) {
      for (std::size_t v = 0; v < table.wind_speeds.size(); ++v) {
        design::MonteCarlo study{problems[d], law.law, section.goals, 0, {}};
        study.problem.wind.mean_speed = table.wind_speeds[v];
        design::MonteCarloJudge judge(study);
        plant::AntennaPlant plant = study.problem.plant;
        for (std::size_t l = 0; l < table.leakage_rates.size(); ++l) {
          plant.drive.leakage_rate = table.leakage_rates[l];
          for (std::size_t f = 0; f < table.friction_slopes.size(); ++f) {
            plant.drive.viscous_friction = table.friction_slopes[f];
            const auto outcome = judge.judge(plant, false);
            const std::size_t place = table.place(s, d, l, f, v);
            table.states[place] = state_of(outcome);
            table.beam_rms[place] = outcome.beam_rms;
          }
        }
      }
    }
    counter.step();
  });
  return table;
}

}  // namespace boresight::app
