#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/guessed_fractions.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/present_gains.hpp>
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

design::WindCondition wind_of(const Case& stated) {
  const WindEntry& wind = *stated.wind;
  return {{wind.air_density.value, wind.gusts.surface_drag, wind.torque_coefficient.value,
           wind.gradient_coefficient.value, wind.coherence_decay.value,
           stated.antenna->dish_diameter.value, wind.gusts},
          wind_model(wind.model),
          wind.design_speed.value};
}

std::vector<design::WeightedWind> climate_of(const Case& stated) {
  design::WindCondition wind = wind_of(stated);
  if (stated.wind->climate_torque_coefficient) {
    wind.site.torque_coefficient = *stated.wind->climate_torque_coefficient;
  }
  std::vector<design::WeightedWind> winds;
  for (const auto& one : stated.wind->climate) {
    wind.mean_speed = one.speed;
    winds.push_back({wind, one.weight});
  }
  return winds;
}

design::Constraints stated_constraints_of(const GoalsEntry& entry) {
  design::Constraints goals;
  for (std::size_t b = 0; b < goals.sensitivity_peak.size(); ++b) {
    const auto& own = entry.peak_at_break.at(b);
    goals.sensitivity_peak.at(b) = own ? own->value : entry.sensitivity_peak.value;
  }
  goals.control_effort = entry.control_effort.value;
  if (entry.gain_margin) goals.gain_margin.fill(std::pow(10.0, entry.gain_margin->value / 20.0));
  if (entry.phase_margin) goals.phase_margin.fill(entry.phase_margin->value);
  if (entry.bandwidth) goals.bandwidth = entry.bandwidth->value;
  goals.standstill.emplace();
  if (entry.standstill_peak) goals.standstill->sensitivity_peak = entry.standstill_peak->value;
  if (entry.static_encoder_error) goals.static_encoder_error = entry.static_encoder_error->value;
  if (entry.crest_factor) goals.crest_factor = entry.crest_factor->value;
  return goals;
}

design::Objective objective_of(const GoalsEntry& entry) {
  design::Objective soft;
  soft.quantile = entry.quantile;
  switch (entry.objective) {
    case ObjectiveKind::nominal:
      break;
    case ObjectiveKind::expected:
      soft.kind = design::ObjectiveKind::expected;
      break;
    case ObjectiveKind::worst_case:
      soft.kind = design::ObjectiveKind::worst_case;
      break;
    case ObjectiveKind::quantile:
      soft.kind = design::ObjectiveKind::quantile;
      break;
  }
  return soft;
}

// Relative; 0 where the case states none.
double stated_uncertainty(const Quantity& quantity) {
  return quantity.uncertainty_given ? relative_uncertainty(quantity) : 0.0;
}

design::AntennaUncertainty uncertainty_of(const Case& stated) {
  design::AntennaUncertainty uncertainty;
  uncertainty.ranges = member_ranges(stated);
  if (stated.ensemble->random_samples > 0) {
    uncertainty.random_samples = static_cast<std::size_t>(stated.ensemble->random_samples);
  }
  uncertainty.antenna_inertia = relative_uncertainty(stated.antenna->inertia);
  uncertainty.motor_inertia = relative_uncertainty(stated.motor->inertia);
  uncertainty.wind_torque = std::hypot(stated_uncertainty(stated.wind->torque_coefficient),
                                       stated_uncertainty(stated.wind->air_density));
  return uncertainty;
}

std::vector<design::AlternativeAntenna> alternatives_of(const Case& stated) {
  const bool with_efficiency = stated.oil->efficiency_in_stiffness;
  std::vector<design::AlternativeAntenna> alternatives{
      {with_efficiency ? "oil stiffness without efficiencies" : "oil stiffness with efficiencies",
       {plant::set_to(
           "at_shaft.oil_stiffness",
           oil_stiffness(stated, with_efficiency ? plant::EfficiencyInStiffness::none
                                                 : plant::EfficiencyInStiffness::both))}}};
  for (const auto& alternative : stated.antenna->alternatives) {
    alternatives.push_back(
        {"antenna inertia of " + alternative.name, changes_of(stated, alternative)});
  }
  for (const auto place : other_guesses) {
    if (!moves_guessed_fractions(*stated.structure, place)) continue;
    alternatives.push_back(
        {std::string(to_string(place)), guessed_fraction_changes(*stated.structure, place)});
  }
  return alternatives;
}

// Wind and constraints, without the antenna: its structure may take time to solve for.
design::Mission asked_of(const Case& stated) {
  design::Mission mission;
  mission.wind = wind_of(stated);
  mission.rms_band = {stated.goals->lowest_frequency.value, stated.goals->highest_frequency.value};
  mission.stated_constraints = stated_constraints_of(*stated.goals);
  mission.limits_gusts = stated.goals->crest_factor.has_value();
  if (const auto& amplitude = stated.goals->limit_cycle_amplitude) {
    mission.limit_cycle_amplitude = amplitude->value;
  }
  return mission;
}

}  // namespace

design::TrackingProblem make_problem(const Case& antenna,
                                     const std::vector<plant::AntennaChange>& changes) {
  return make_problem(antenna, changed(antenna_of(antenna), changes));
}

design::TrackingProblem make_problem(const Case& antenna, const plant::Antenna& other) {
  return tracking_problem(asked_of(antenna), other);
}

double torque_limited_wind_speed(const Case& antenna, const design::TrackingProblem& problem) {
  design::Mission mission;
  mission.antenna = drive_of(antenna);
  mission.wind = problem.wind;
  return torque_limited_wind_speed(mission);
}

design::Constraints make_goals(const Case& antenna) {
  design::Mission mission = asked_of(antenna);
  mission.antenna = antenna_of(antenna);
  return constraints(mission);
}

design::Objective make_objective(const Case& antenna) {
  return objective_of(*antenna.goals);
}

std::vector<design::WeightedWind> make_climate(const Case& antenna) {
  return climate_of(antenna);
}

std::vector<design::PointingBand> make_bands(const Case& antenna) {
  std::vector<design::PointingBand> bands;
  bands.reserve(antenna.bands.size());
  for (const auto& band : antenna.bands) {
    bands.push_back({band.name, band.frequency.value,
                     design::half_power_beamwidth(band.beamwidth_factor.value, band.frequency.value,
                                                  antenna.antenna->dish_diameter.value),
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
      budget.convention = "rms error per axis";
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
  design::Mission mission;
  mission.budgets = make_budgets(antenna);
  return tightest_budget(mission);
}

design::CandidateStructures asked_structures(const Case& stated, std::vector<std::string> names) {
  if (names.empty()) names = stated.tuning->structures;
  for (const auto& name : names) {
    if (std::ranges::count(names, name) != 1) {
      throw InvalidInput(fmt::format("expected each structure once, found '{}' again", name));
    }
  }
  design::CandidateStructures structures;
  structures.state_space_named = std::erase(names, design::state_space_name) > 0;
  structures.state_space = structures.state_space_named || (names.empty() && stated.simulation);
  if (names.empty()) {
    names = stated.tuning->structures;
    std::erase(names, design::state_space_name);
  }
  const bool is_usual = names.empty();
  if (is_usual) {
    names = {"PI", "LL", "DPF", "FULL", "LL+L", "FULL+L+C"};
    for (const auto& loop : stated.loops) names.push_back(loop.structure.name());
  }
  for (const auto& name : names) structures.loops.push_back({name, loop_structure(stated, name)});
  for (const auto& one : structures.loops) {
    if (stated.simulation || !one.structure.has_conditional_integral()) continue;
    throw InvalidInput(fmt::format(
        "{}: expected [simulation] in the case for an integral with a dead zone or freeze, whose "
        "effect depends on the size of the errors, found none",
        one.name));
  }
  // Of no use without an integral; named ones are tuned, and the answer says what they miss.
  if (is_usual && stated.goals->static_encoder_error &&
      stated.goals->static_encoder_error->value == 0.0) {
    std::erase_if(structures.loops,
                  [](const auto& one) { return !one.structure.has_integral_action(); });
    structures.state_space = structures.state_space_named;
  }
  return structures;
}

design::Mission mission_of(const Case& stated) {
  design::Mission mission = asked_of(stated);
  mission.antenna = antenna_of(stated);
  mission.uncertainty = uncertainty_of(stated);
  mission.alternatives = alternatives_of(stated);
  mission.climate = climate_of(stated);
  mission.climate_parts = stated.wind->climate_parts;
  mission.torque_table = stated.wind->torque_table;
  mission.wind_record = stated.wind->record;
  const auto& dish = stated.antenna;
  if (dish->azimuth && dish->elevation) {
    mission.pointing = {dish->azimuth->value, dish->elevation->value};
  }
  mission.bands = make_bands(stated);
  mission.budgets = make_budgets(stated);
  mission.objective = objective_of(*stated.goals);
  if (stated.goals->boresight_rms) mission.rms_goal = stated.goals->boresight_rms->value;
  mission.minimises_climate = stated.goals->over_climate;
  mission.structures = asked_structures(stated);
  for (const auto& structure : usual_structures_with_lag(stated)) {
    mission.usual_structures.push_back({short_name(structure), structure});
  }
  mission.present_controllers = present_controllers(stated);
  if (stated.present_gains && stated.present_gains->gains.empty()) {
    const control::LoopStructure& present = stated.present_gains->structure;
    mission.present_structure = short_name(present);
    auto& loops = mission.structures.loops;
    const auto tuned =
        std::ranges::find(loops, mission.present_structure, &design::NamedStructure::name);
    if (tuned == loops.end()) loops.push_back({mission.present_structure, present});
  }
  mission.starts = static_cast<int>(stated.tuning->starts);
  if (!stated.matching->disks.empty()) mission.max_disks = stated.matching->disks.back();
  return mission;
}

}  // namespace boresight::io
