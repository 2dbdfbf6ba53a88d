#pragma once

#include <optional>

#include "design/studies/fixed_controller.hpp"
#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/studies/commission_study.hpp>

namespace boresight::reference {

/// A plan to a controller on the demo antenna with an uncertain oil spring and leakage.
struct PlannedStages {
  design::Mission mission = uncertain_mission();
  design::PlantDistribution distribution = design::PlantDistribution::of_ranges(mission);
  design::CommandedMove move = design::commissioning_move(mission);
  design::CommissioningPlan plan;

  explicit PlannedStages(const control::Controller& target) {
    mission.uncertainty.random_samples = 12;
    plan =
        design::plan_commissioning(design::tracking_problem(mission),
                                   design::plant_members(mission, 1), std::nullopt, target, move);
  }
};

/// To one PI loop, the same for every test of a program.
inline const PlannedStages& planned_stages() {
  static const PlannedStages planned(fixed_controller("PI", 1.0).design.tuning.controller);
  return planned;
}

/// To pressure feedback, whose fast rate loop shows more of the plant.
inline const PlannedStages& fast_stages() {
  static const PlannedStages planned(
      {control::LoopStructure::named("DPF"), {1.2, 2.0, 300.0, 0.204, 5.66, 0.8, 0.2}});
  return planned;
}

}  // namespace boresight::reference
