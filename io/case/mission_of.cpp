#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/problem/pointing.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

design::LossConvention convention_of(const std::string& name) {
  if (name == "mean_loss_one_axis") return design::LossConvention::mean_loss_one_axis;
  if (name == "loss_at_mean_radial_error") return design::LossConvention::loss_at_mean_radial_error;
  return design::LossConvention::mean_loss_two_axes;
}

plant::WindModel wind_model(const std::string& name) {
  if (name == "uniform") return plant::WindModel::uniform;
  if (name == "vickery") return plant::WindModel::vickery;
  return plant::WindModel::coherence;
}

}  // namespace

design::TrackingProblem make_problem(const Case& antenna,
                                     const std::vector<plant::AntennaChange>& changes) {
  return make_problem(antenna, changed(antenna_of(antenna), changes));
}

design::TrackingProblem make_problem(const Case& antenna, const plant::Antenna& other) {
  design::TrackingProblem problem;
  problem.plant = linear_plant(other);
  problem.gear_ratio = plant::gear_ratio(other);
  problem.delay = other.dead_time;
  const plant::Sensors& sensors = other.sensors;
  problem.noise = {sky_to_motor(other, sensors.encoder_noise), sensors.tachometer_noise,
                   sensors.noise_bandwidth, sensors.torque_noise};
  const WindEntry& wind = antenna.wind;
  problem.wind = {{wind.air_density.value, wind.gusts.surface_drag, wind.torque_coefficient.value,
                   wind.gradient_coefficient.value, wind.coherence_decay.value,
                   antenna.antenna.dish_diameter.value, wind.gusts},
                  wind_model(wind.model),
                  wind.design_speed.value};
  problem.rms_band = {antenna.goals.lowest_frequency.value, antenna.goals.highest_frequency.value};
  return problem;
}

double supply_wind_speed(const Case& antenna, const design::TrackingProblem& problem) {
  const double left = torque_for_wind(antenna);
  if (!(left > 0.0)) return 0.0;
  const double speed = problem.wind.mean_speed;
  // The torque goes with the square of the speed.
  return speed * std::sqrt(left * problem.gear_ratio /
                           std::abs(plant::mean_wind_torque(problem.wind.site, speed)));
}

design::HardGoals make_goals(const Case& antenna) {
  const GoalsEntry& entry = antenna.goals;
  design::HardGoals goals;
  for (std::size_t b = 0; b < goals.sensitivity_peak.size(); ++b) {
    const auto& own = entry.peak_at_break.at(b);
    goals.sensitivity_peak.at(b) = own ? own->value : entry.sensitivity_peak.value;
  }
  goals.valve_effort = entry.valve_effort.value;
  if (entry.gain_margin) goals.gain_margin.fill(std::pow(10.0, entry.gain_margin->value / 20.0));
  if (entry.phase_margin) goals.phase_margin.fill(entry.phase_margin->value);
  if (entry.bandwidth) goals.bandwidth = entry.bandwidth->value;
  if (entry.crest_factor) {
    goals.crest_factor = entry.crest_factor->value;
    goals.gust_torque = torque_for_wind(antenna);
    if (!(*goals.gust_torque > 0.0)) {
      throw InvalidInput(fmt::format(
          "goals.crest_factor: expected a supply torque above friction and offset at the tracking "
          "rate, found {:.4g} N.m, which they take",
          supply_torque(antenna)));
    }
    goals.gust_demand = largest_demand(antenna);
  }
  return goals;
}

design::SoftGoal make_soft_goal(const Case& antenna) {
  design::SoftGoal soft;
  soft.quantile = antenna.goals.quantile;
  switch (antenna.goals.soft_goal) {
    case SoftGoalKind::nominal:
      break;
    case SoftGoalKind::expected:
      soft.kind = design::SoftGoalKind::expected;
      break;
    case SoftGoalKind::worst_case:
      soft.kind = design::SoftGoalKind::worst_case;
      break;
    case SoftGoalKind::quantile:
      soft.kind = design::SoftGoalKind::quantile;
      break;
  }
  return soft;
}

std::vector<design::WeightedWind> make_climate(const Case& antenna) {
  design::WindCondition wind = make_problem(antenna).wind;
  if (antenna.wind.climate_torque_coefficient) {
    wind.site.torque_coefficient = *antenna.wind.climate_torque_coefficient;
  }
  std::vector<design::WeightedWind> winds;
  for (const auto& one : antenna.wind.climate) {
    wind.mean_speed = one.speed;
    winds.push_back({wind, one.weight});
  }
  return winds;
}

std::vector<design::PointingBand> make_bands(const Case& antenna) {
  std::vector<design::PointingBand> bands;
  bands.reserve(antenna.bands.size());
  for (const auto& band : antenna.bands) {
    bands.push_back({band.name, band.frequency.value,
                     design::half_power_beamwidth(band.beamwidth_factor.value, band.frequency.value,
                                                  antenna.antenna.dish_diameter.value),
                     band.illumination});
  }
  return bands;
}

std::vector<design::PointingBudget> make_budgets(const Case& antenna) {
  std::vector<design::PointingBudget> budgets;
  const auto bands = make_bands(antenna);
  for (const auto& entry : antenna.budgets) {
    design::PointingBudget budget;
    budget.name = entry.name;
    budget.band = entry.band;
    if (entry.wind_speed) budget.wind_speed = entry.wind_speed->value;
    for (const auto& band : bands) {
      if (band.name == entry.band) budget.beamwidth = band.beamwidth;
    }
    if (entry.rms) {
      budget.rms = entry.rms->value;
      budget.convention = "rms error an axis";
    } else if (entry.loss) {
      const auto convention = convention_of(entry.convention);
      budget.rms = design::rms_for_loss(entry.loss->value, budget.beamwidth, convention);
      budget.convention = design::to_string(convention);
    }
    budgets.push_back(std::move(budget));
  }
  return budgets;
}

double tightest_budget(const Case& antenna) {
  const auto budgets = make_budgets(antenna);
  const auto tightest = std::ranges::min_element(budgets, {}, &design::PointingBudget::rms);
  return tightest != budgets.end() ? tightest->rms : 1e-3 * std::numbers::pi / 180.0;
}

}  // namespace boresight::io
