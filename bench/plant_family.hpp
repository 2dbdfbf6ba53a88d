#pragma once

#include <cmath>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight {

/// The 70-m reference drive with `modes` structural modes spread evenly in ln f over 2.4..40 Hz.
inline design::TrackingProblem plant_family(int modes) {
  plant::StructureSpecification specification;
  specification.antenna_inertia = 0.39714;
  specification.bull_gear_beam_weight = 0.05;
  specification.locked_rotor_frequency = 1.2;
  for (int i = 0; i < modes; ++i) {
    const double place = modes > 1 ? static_cast<double>(i) / (modes - 1) : 0.0;
    specification.modes.push_back(
        {2.4 * std::pow(40.0 / 2.4, place), 0.01, 0.87 / modes, 1.0 / modes, 0.95 / modes});
  }
  design::TrackingProblem problem;
  problem.plant.structure = plant::make_structure(specification);
  problem.plant.drive = {52.608, 1.219, 0.9, 1.42, two_pi * 12.0, 0.7, two_pi * 20.0};
  problem.gear_ratio = 28723.647;
  problem.delay = 0.03;
  problem.noise = {0.05, 0.02, 25.0};
  problem.wind = {{1.1, 0.005, 0.1, 1.0, 8.0, 70.0}, plant::WindModel::coherence, 10.0};
  return problem;
}

/// A stable controller of that family, with lag.
inline control::Controller stable_controller() {
  return {control::LoopStructure::pi_with_lag(), {0.05, 0.5, 3.0, 0.3, 0.01}};
}

}  // namespace boresight
