#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/studies/what_if_study.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

// The study of one controller at two numbers of disks, with the gains of the last held at both.
design::MatchingStudy study_of_one_controller(const io::Case& antenna) {
  design::MatchingStudy section;
  section.goals = make_goals(antenna);
  // A loop that is stable over the whole table.
  section.goals.standstill.reset();
  section.wind_speed = antenna.wind->design_speed.value;
  section.friction = antenna.drive->viscous_friction.value;
  section.tracking_friction = io::tracking_friction(antenna);
  design::DesignTask task;
  task.problem = make_problem(antenna);
  task.goals = section.goals;
  task.options.starts = 3;
  const auto found = design::solve(task).tuning;
  EXPECT_EQ(found.status, design::TuningStatus::optimal);
  design::MatchSeries series;
  series.name = "PI";
  for (const double disks : {12.0, 24.0}) {
    design::MatchPoint point;
    point.disks = disks;
    section.points.push_back(point);
    design::MatchedController controller;
    controller.controller = found.controller;
    controller.status = found.status;
    series.curve.controllers.push_back(controller);
  }
  section.series.push_back(std::move(series));
  return section;
}

// The page takes the rms between entries as linear in its logarithm: at the middle of every cell
// whose corners are stable that is what the plant gives.
TEST(WhatIf, InterpolatesWhatThePlantGives) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const design::MatchingStudy section = study_of_one_controller(antenna);
  const design::WhatIfTable table = design::what_if(io::mission_of(antenna), section, {});
  double largest = 0.0;
  int cells = 0, close = 0;
  for (std::size_t v = 0; v + 1 < table.wind_speeds.size(); ++v) {
    design::TrackingProblem problem = make_problem(antenna);
    problem.climate.clear();
    problem.wind.mean_speed = std::sqrt(table.wind_speeds[v] * table.wind_speeds[v + 1]);
    const design::MonteCarlo study{
        problem, section.series[0].curve.controllers[1].controller, section.goals, 0, {}};
    design::MonteCarloEvaluator evaluate(study);
    plant::AntennaPlant plant = problem.plant;
    for (std::size_t l = 0; l + 1 < table.leakage_rates.size(); ++l) {
      plant.drive.leakage_rate = 0.5 * (table.leakage_rates[l] + table.leakage_rates[l + 1]);
      for (std::size_t f = 0; f + 1 < table.friction_slopes.size(); ++f) {
        double sum = 0.0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
          sum += std::log(table.boresight_rms[table.place(0, 1, l + corner % 2, f + corner / 2 % 2,
                                                          v + corner / 4)]) /
                 8.0;
        }
        if (!std::isfinite(sum)) continue;
        plant.drive.viscous_friction =
            0.5 * (table.friction_slopes[f] + table.friction_slopes[f + 1]);
        const double found = evaluate.evaluate(plant, false).boresight_rms;
        const double error = std::abs(std::exp(sum) / found - 1.0);
        largest = std::max(largest, error);
        if (error < 0.02) ++close;
        ++cells;
      }
    }
  }
  // As docs/report.md has it: the largest beside plants on the verge of instability.
  EXPECT_EQ(cells, 200);
  EXPECT_GE(close, 175);
  EXPECT_LT(largest, 0.1);
}

}  // namespace
}  // namespace boresight::app
