#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/studies/candidate_figures.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::optional<SlewFigures> slew_of(const plant::Antenna& antenna) {
  if (!antenna.nonlinear) return std::nullopt;
  constexpr double distance = 10.0 * degree;
  const double ratio = plant::gear_ratio(antenna);
  SlewFigures slew;
  slew.distance = distance;
  slew.rate_asked = antenna.drive.slew_rate;
  const double open = antenna.nonlinear->valve_stroke * (1.0 - antenna.nonlinear->valve_overlap);
  const double wanted = std::min(slew.rate_asked * ratio, 0.999 * open);
  constexpr double any_acceleration = std::numeric_limits<double>::infinity();
  const double inertia =
      motor_inertia(antenna) + gear_train_inertia(antenna) + antenna_inertia(antenna);
  const auto reach =
      achievable_limits(plant::nonlinear_antenna(antenna), inertia, {wanted, any_acceleration});
  slew.reachable_acceleration = std::max(0.0, reach.acceleration / ratio);
  slew.rate = std::max(0.0, reach.rate / ratio);
  slew.acceleration =
      std::max(0.0, std::min(slew_acceleration * ratio, reach.acceleration) / ratio);
  if (slew.rate > 0.0 && slew.acceleration > 0.0) {
    const double ramps = slew.rate * slew.rate / slew.acceleration;
    slew.time = ramps >= distance ? 2.0 * std::sqrt(distance / slew.acceleration)
                                  : distance / slew.rate + slew.rate / slew.acceleration;
  }
  return slew;
}

}  // namespace

CandidateFigures candidate_figures(const Mission& mission, const std::vector<PointingBand>& bands,
                                   const std::vector<PointingBudget>& budgets,
                                   const CandidateController& tuned) {
  const control::Controller& controller = tuned.design.tuning.controller;
  const NonlinearEffect effect = tuned.effect();
  const bool known = std::isfinite(effect.factor);
  CandidateFigures figures;
  TrackingProblem problem = tracking_problem(mission);
  auto evaluator = make_evaluator(problem);
  evaluator.look_at_gusts(true);
  const auto evaluation = evaluator.evaluate(controller, false);
  const auto losses = [&](double rms) {
    std::vector<double> found;
    for (const auto& band : bands) {
      found.push_back(
          known ? pointing_loss_db(rms, band.beamwidth, LossConvention::mean_loss_two_axes) : nan);
    }
    return found;
  };
  figures.torque_limited_wind_speed = torque_limited_wind_speed(mission);
  figures.losses =
      losses(effect.rms(std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio));
  figures.speed_limits = known ? budget_speeds(problem, evaluator, controller,
                                               evaluation.noise_variance, budgets, effect)
                               : std::vector<double>(budgets.size(), nan);
  const double crest = mission.stated_constraints.crest_factor;
  const double mean = std::abs(plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) /
                               problem.gear_ratio);
  const auto& drive = problem.plant.drive;
  figures.supply_margin = plant::available_wind_torque(mission.antenna) /
                          (mean + crest * std::sqrt(evaluation.wind_torque_variance));
  figures.demand_margin =
      plant::largest_demand(mission.antenna) / (drive.leakage_rate / drive.oil_stiffness * mean +
                                                crest * std::sqrt(evaluation.wind_demand_variance));
  figures.slew_rate_margin = plant::slew_rate_margin(mission.antenna);
  figures.slew = slew_of(mission.antenna);
  if (!mission.climate.empty()) {
    problem.climate = mission.climate;
    figures.climate_rms = effect.rms(
        std::sqrt(make_evaluator(problem).evaluate(controller, false).boresight_variance()) /
        problem.gear_ratio);
    figures.climate_losses = losses(*figures.climate_rms);
  }
  return figures;
}

}  // namespace boresight::design
