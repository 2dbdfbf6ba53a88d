#pragma once

#include <string>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::reference {

/// A controller of that name whose gains are those of one PI loop, whatever the name, and whose
/// simulated rms is `factor` times that of its linear loops.
inline design::CandidateController fixed_controller(const std::string& structure, double factor) {
  design::CandidateController controller;
  controller.structure = structure;
  controller.constraints_met = true;
  controller.design.verification.passed = true;
  auto& tuning = controller.design.tuning;
  tuning.status = design::TuningStatus::optimal;
  tuning.controller.structure = control::LoopStructure::named("PI");
  // kr, wi, wp, kp, wip: near those of docs/reference-designs.md.
  tuning.controller.gains = {0.15, 0.4, 2.6, 8.0, 0.15};
  auto& run = controller.time_domain.emplace();
  run.wind.boresight_rms = factor;
  run.wind.predicted_rms = 1.0;
  return controller;
}

/// The demo mission with an uncertain oil spring and leakage.
inline design::Mission uncertain_mission() {
  design::Mission mission = demo_mission();
  const double leakage = mission.antenna.drive.leakage_rate;
  const double friction = mission.antenna.drive.viscous_friction;
  mission.uncertainty.ranges = {
      {1.0, 1.0}, {0.8, 1.33}, {0.5 * leakage, leakage}, {friction, friction}};
  return mission;
}

}  // namespace boresight::reference
