#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/problem/mission.hpp>
#include <boresight/design/problem/standstill.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {

TrackingProblem tracking_problem(const Mission& mission,
                                 const std::vector<plant::AntennaChange>& changes) {
  return tracking_problem(mission, changed(mission.antenna, changes));
}

TrackingProblem tracking_problem(const Mission& mission, const plant::Antenna& antenna) {
  TrackingProblem problem;
  problem.plant = linear_plant(antenna);
  problem.gear_ratio = gear_ratio(antenna);
  problem.delay = antenna.dead_time;
  const plant::Sensors& sensors = antenna.sensors;
  problem.noise = {sky_to_motor(antenna, sensors.encoder_noise), sensors.tachometer_noise,
                   sensors.noise_bandwidth, sensors.torque_noise};
  problem.wind = mission.wind;
  problem.rms_band = mission.rms_band;
  return problem;
}

Constraints constraints(const Mission& mission) {
  Constraints goals = mission.stated_constraints;
  const double half_step = 0.5 * encoder_step(mission.antenna);
  // What the message allows is rounded, and must be accepted.
  constexpr double rounding = 1e-3;
  if (mission.limit_cycle_amplitude.value_or(half_step) < (1.0 - rounding) * half_step) {
    throw InfeasibleRequirement(fmt::format(
        "goals.limit_cycle_amplitude: expected at least {0:.4g} mdeg, half an encoder step, found "
        "{1:.4g} mdeg: a loop does not sense smaller motion. Allow {0:.4g} mdeg, or take an "
        "encoder "
        "with steps of {2:.4g} mdeg instead of {3:.4g}",
        half_step / millidegree, *mission.limit_cycle_amplitude / millidegree,
        2.0 * *mission.limit_cycle_amplitude / millidegree, 2.0 * half_step / millidegree));
  }
  if (goals.standstill) {
    goals.standstill->friction = standstill_friction(mission.antenna);
    goals.standstill->amplitude = standstill_amplitudes(mission.antenna);
    goals.standstill->edges = encoder_edges(mission.antenna);
    goals.standstill->breakaway_stiffness = breakaway_stiffness(mission.antenna);
  }
  if (!mission.limits_gusts) return goals;
  goals.gust_torque = plant::available_wind_torque(mission.antenna);
  if (!(*goals.gust_torque > 0.0)) {
    throw InvalidInput(fmt::format(
        "goals.crest_factor: expected a supply torque above friction and offset at the tracking "
        "rate, found {:.4g} N.m, which they take",
        plant::supply_torque(mission.antenna)));
  }
  goals.gust_demand = plant::largest_demand(mission.antenna);
  return goals;
}

double torque_limited_wind_speed(const Mission& mission) {
  const double left = plant::available_wind_torque(mission.antenna);
  if (!(left > 0.0)) return 0.0;
  const double speed = mission.wind.mean_speed;
  // The torque scales with the square of the speed.
  return speed * std::sqrt(left * gear_ratio(mission.antenna) /
                           std::abs(plant::mean_wind_torque(mission.wind.site, speed)));
}

double tightest_budget(const Mission& mission) {
  const auto tightest = std::ranges::min_element(mission.budgets, {}, &PointingBudget::rms);
  return tightest != mission.budgets.end() ? tightest->rms : millidegree;
}

double allowed_limit_cycle(const Mission& mission) {
  return mission.limit_cycle_amplitude.value_or(std::numbers::sqrt2 * tightest_budget(mission));
}

}  // namespace boresight::design
