#include <boresight/design/problem/static_bending.hpp>

namespace boresight::design {

double static_bending(const TrackingProblem& problem) {
  double compliance = 0.0;
  for (const auto& mode : problem.plant.structure.modes) {
    compliance += mode.wind_fraction * mode.beam_weight / mode.stiffness;
  }
  return compliance * plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) /
         (problem.gear_ratio * problem.gear_ratio);
}

}  // namespace boresight::design
