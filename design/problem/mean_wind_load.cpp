#include <boresight/design/problem/mean_wind_load.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::design {

MeanWindLoad mean_wind_load(const TrackingProblem& problem) {
  const auto& drive = problem.plant.drive;
  const double torque =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
  return {torque, drive.leakage_rate / drive.oil_stiffness * torque};
}

}  // namespace boresight::design
