#pragma once

#include "../reference_antenna.hpp"
#include <boresight/design/tuner.hpp>

namespace boresight::reference {

/// The reference antenna in a wind of 10 m/s.
inline design::TrackingProblem tracking_problem(double disks = 24.0) {
  design::TrackingProblem problem;
  problem.plant = antenna(disks);
  problem.gear_ratio = gear_ratio();
  problem.delay = 0.03;
  problem.noise = {0.1 * mdeg * gear_ratio(), 0.02, 25.0};
  problem.wind = {wind_site(), plant::WindModel::coherence, 10.0};
  return problem;
}

/// A cautious law, stable on the reference antenna.
inline control::ControlLaw cautious_law() {
  return {control::LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
}

}  // namespace boresight::reference
