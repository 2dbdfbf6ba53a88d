#pragma once

#include <string>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::reference {

/// A law of that name whose gains are those of one PI loop, whatever the name, and whose simulated
/// rms is `factor` times that of its linear loops.
inline design::CandidateLaw held_law(const std::string& structure, double factor) {
  design::CandidateLaw law;
  law.structure = structure;
  law.goals_met = true;
  law.design.verification.passed = true;
  auto& tuning = law.design.tuning;
  tuning.status = design::TuningStatus::optimal;
  tuning.law.structure = control::LoopStructure::named("PI");
  // kr, wi, wp, kp, wip: near those of docs/reference-designs.md.
  tuning.law.gains = {0.15, 0.4, 2.6, 8.0, 0.15};
  auto& run = law.time_domain.emplace();
  run.wind.beam_rms = factor;
  run.wind.predicted_rms = 1.0;
  return law;
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
