#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/redesign/resonating_mode.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

numerics::Uncertain uncertain(const io::Quantity& quantity) {
  return {quantity.value, quantity.standard_uncertainty};
}

// An inertia about the antenna axis, at the motor shaft.
numerics::Uncertain reflected(const io::Case& antenna, const io::Quantity& inertia) {
  const double square = std::pow(io::gear_ratio(antenna), 2);
  return {inertia.value / square, inertia.standard_uncertainty / square};
}

numerics::Uncertain part_inertia(const io::Case& antenna, const io::AssemblyPart& part) {
  if (part.inertia) return uncertain(*part.inertia);
  const std::optional<io::Quantity>& density = antenna.gear_train.density;
  if (!part.radius || !part.length || !density) {
    throw InvalidInput(
        fmt::format("part_inertia: '{}' has neither inertia nor dimensions", part.name));
  }
  return uncertain(io::solid_disk(*part.radius, *part.length, *density));
}

// Of an alternative, at the motor shaft.
numerics::Uncertain reflected(const io::Case& antenna, const io::AntennaAlternative& alternative) {
  if (alternative.reflected_inertia) return uncertain(*alternative.reflected_inertia);
  if (!alternative.inertia) {
    throw InvalidInput(fmt::format("antenna alternative '{}' has no inertia", alternative.name));
  }
  return reflected(antenna, *alternative.inertia);
}

// A composite inertia if the case gives one, else the sum of its parts' inertias or disks.
numerics::Uncertain assembly_inertia(const io::Case& antenna,
                                     const io::RotatingAssembly& assembly) {
  if (assembly.inertia) return uncertain(*assembly.inertia);
  numerics::Uncertain sum;
  double variance = 0.0;
  for (const auto& part : assembly.parts) {
    const auto inertia = part_inertia(antenna, part);
    sum.value += inertia.value;
    variance += std::pow(inertia.standard_uncertainty, 2);
  }
  sum.standard_uncertainty = std::sqrt(variance);
  return sum;
}

plant::Structure make_structure(const io::Case& antenna, const PlantVariant& variant) {
  auto specification = io::structure_specifications(antenna.structure).at(variant.structure);
  place_guessed_shares(antenna.structure, variant.guessed_shares, specification);
  specification.antenna_inertia =
      variant.inertia_scale * variant.antenna_inertia.value_or(antenna_inertia(antenna));
  specification.locked_rotor_frequency *= variant.structure_frequency_scale;
  for (auto& mode : specification.modes) mode.frequency *= variant.structure_frequency_scale;
  return plant::make_structure(specification);
}

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

double gear_train_inertia(const io::Case& antenna) {
  const auto stages = io::gear_stages(antenna);
  double sum = 0.0;
  for (const auto& assembly : antenna.gear_train.assemblies) {
    sum += plant::reflected_inertia(assembly_inertia(antenna, assembly).value,
                                    plant::gear_ratio(stages, assembly.stages),
                                    static_cast<double>(assembly.count));
  }
  return sum;
}

double motor_inertia(const io::Case& antenna, double disks) {
  const io::MotorEntry& motor = antenna.motor;
  // As built the stated inertia holds; rotor and disks say what a change of disks does to it.
  return static_cast<double>(motor.count) *
         (motor.inertia.value + (disks - motor.flywheel_disks) * motor.disk_inertia.value);
}

double antenna_inertia(const io::Case& antenna) {
  return reflected(antenna, antenna.antenna.inertia).value;
}

double antenna_inertia(const io::Case& antenna, const io::AntennaAlternative& alternative) {
  return reflected(antenna, alternative).value;
}

PlantVariant variant_of(const io::Case& antenna, const io::AntennaAlternative& alternative) {
  const double inertia = antenna_inertia(antenna, alternative);
  return {.antenna_inertia = inertia,
          .structure_frequency_scale =
              alternative.keeps_springs ? std::sqrt(antenna_inertia(antenna) / inertia) : 1.0};
}

double bulk_modulus(const io::Case& antenna) {
  return io::bulk_modulus_of(antenna.oil).value;
}

double oil_stiffness(const io::Case& antenna, plant::EfficiencyInStiffness efficiency) {
  plant::HydraulicDrive drive = io::hydraulic_drive(antenna);
  drive.efficiency_in_stiffness = efficiency;
  return plant::oil_stiffness(drive);
}

double oil_stiffness(const io::Case& antenna) {
  return plant::oil_stiffness(io::hydraulic_drive(antenna));
}

double leakage_rate_at(const io::Case& antenna, double bulk_modulus_factor) {
  const io::DriveEntry& drive = antenna.drive;
  return drive.leakage_rate.value * (drive.leakage_by_flow ? bulk_modulus_factor : 1.0);
}

plant::AntennaPlant make_plant(const io::Case& antenna, const PlantVariant& variant) {
  plant::AntennaPlant plant;
  const double disks = variant.flywheel_disks.value_or(antenna.motor.flywheel_disks);
  plant.drive.oil_stiffness = variant.oil_stiffness.value_or(oil_stiffness(antenna));
  plant.drive.leakage_rate = variant.leakage_rate.value_or(antenna.drive.leakage_rate.value);
  plant.drive.viscous_friction =
      variant.viscous_friction.value_or(antenna.drive.viscous_friction.value);
  plant.drive.motor_inertia =
      variant.inertia_scale *
      (variant.motor_inertia_scale * motor_inertia(antenna, disks) + gear_train_inertia(antenna));
  plant.drive.valve_corner = two_pi * antenna.drive.valve_frequency.value;
  plant.drive.valve_damping = antenna.drive.valve_damping.value;
  plant.drive.tachometer_corner = two_pi * antenna.sensors.tachometer_frequency.value;

  plant.structure = make_structure(antenna, variant);
  plant.structure.bull_gear_wind_fraction *= variant.wind_torque_scale;
  for (auto& mode : plant.structure.modes) mode.wind_fraction *= variant.wind_torque_scale;
  return plant;
}

double largest_viscous_friction(const io::Case& antenna) {
  return std::max(io::tracking_friction(antenna), antenna.drive.viscous_friction.value);
}

design::TrackingProblem make_problem(const io::Case& antenna, const PlantVariant& variant) {
  design::TrackingProblem problem;
  problem.plant = make_plant(antenna, variant);
  problem.gear_ratio = io::gear_ratio(antenna);
  problem.delay = antenna.controller_delay.value;
  problem.noise = {antenna.sensors.encoder_noise.value * problem.gear_ratio,
                   antenna.sensors.tachometer_noise.value, antenna.sensors.noise_bandwidth.value,
                   antenna.sensors.torque_noise ? antenna.sensors.torque_noise->value : 0.0};
  const io::WindEntry& wind = antenna.wind;
  problem.wind = {{wind.air_density.value, wind.gusts.surface_drag, wind.torque_coefficient.value,
                   wind.gradient_coefficient.value, wind.coherence_decay.value,
                   antenna.antenna.dish_diameter.value, wind.gusts},
                  wind_model(wind.model),
                  wind.design_speed.value};
  problem.rms_band = {antenna.goals.lowest_frequency.value, antenna.goals.highest_frequency.value};
  return problem;
}

double supply_wind_speed(const io::Case& antenna, const design::TrackingProblem& problem) {
  const double left = io::torque_for_wind(antenna);
  if (!(left > 0.0)) return 0.0;
  const double speed = problem.wind.mean_speed;
  // The torque goes with the square of the speed.
  return speed * std::sqrt(left * problem.gear_ratio /
                           std::abs(plant::mean_wind_torque(problem.wind.site, speed)));
}

double static_bending(const design::TrackingProblem& problem) {
  double compliance = 0.0;
  for (const auto& mode : problem.plant.structure.modes) {
    compliance += mode.wind_fraction * mode.beam_weight / mode.stiffness;
  }
  return compliance * plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) /
         (problem.gear_ratio * problem.gear_ratio);
}

design::HardGoals make_goals(const io::Case& antenna) {
  const io::GoalsEntry& entry = antenna.goals;
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
    goals.gust_torque = io::torque_for_wind(antenna);
    if (!(*goals.gust_torque > 0.0)) {
      throw InvalidInput(fmt::format(
          "goals.crest_factor: expected a supply torque above friction and offset at the tracking "
          "rate, found {:.4g} N.m, which they take",
          io::supply_torque(antenna)));
    }
    goals.gust_demand = io::largest_demand(antenna);
  }
  return goals;
}

design::SoftGoal make_soft_goal(const io::Case& antenna) {
  design::SoftGoal soft;
  soft.quantile = antenna.goals.quantile;
  switch (antenna.goals.soft_goal) {
    case io::SoftGoalKind::nominal:
      break;
    case io::SoftGoalKind::expected:
      soft.kind = design::SoftGoalKind::expected;
      break;
    case io::SoftGoalKind::worst_case:
      soft.kind = design::SoftGoalKind::worst_case;
      break;
    case io::SoftGoalKind::quantile:
      soft.kind = design::SoftGoalKind::quantile;
      break;
  }
  return soft;
}

std::vector<design::WeightedWind> make_climate(const io::Case& antenna) {
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

identification::DriveEvidence make_evidence(const io::Case& antenna) {
  identification::DriveEvidence evidence;
  evidence.stages = io::gear_stages(antenna);
  for (const auto& assembly : antenna.gear_train.assemblies) {
    evidence.assemblies.push_back({assembly.name, assembly_inertia(antenna, assembly),
                                   static_cast<double>(assembly.count), assembly.stages});
  }
  const io::Quantity& own = antenna.antenna.inertia;
  evidence.antenna.push_back(
      {own.source.empty() ? "the case" : own.source, reflected(antenna, own)});
  for (const auto& alternative : antenna.antenna.alternatives) {
    if (alternative.keeps_springs) continue;  // of another attitude
    evidence.antenna.push_back({alternative.name, reflected(antenna, alternative)});
  }
  for (const auto& stated : antenna.stated) {
    if (stated.quantity != "load_inertia" || evidence.printed_load) continue;
    evidence.printed_load = {stated.value.source, stated.value.value};
  }
  const io::MotorEntry& motor = antenna.motor;
  evidence.motor_count = static_cast<double>(motor.count);
  evidence.motor_inertia = uncertain(motor.inertia);
  evidence.displacement = uncertain(motor.displacement);
  evidence.torque_efficiency = uncertain(motor.torque_efficiency);
  evidence.volumetric_efficiency = uncertain(motor.volumetric_efficiency);
  const io::OilEntry& oil = antenna.oil;
  if (oil.density) evidence.oil_density = uncertain(*oil.density);
  for (const auto& line : oil.lines) {
    evidence.lines.push_back({line.name, uncertain(line.length), uncertain(line.slosh_frequency)});
  }
  if (oil.bulk_modulus) evidence.bulk_modulus = uncertain(*oil.bulk_modulus);
  evidence.volume_1 = uncertain(oil.volume_1);
  evidence.volume_2 = uncertain(oil.volume_2);
  evidence.efficiency_in_stiffness = oil.efficiency_in_stiffness
                                         ? plant::EfficiencyInStiffness::both
                                         : plant::EfficiencyInStiffness::none;
  if (antenna.resonance_frequency && rings_as_rigid(antenna)) {
    evidence.resonance_frequency = uncertain(*antenna.resonance_frequency);
  }
  for (const auto& impulse : antenna.impulse_results) {
    evidence.impulse.push_back({impulse.name + " friction", uncertain(impulse.reflected_inertia)});
  }
  return evidence;
}

std::vector<PointingBand> make_bands(const io::Case& antenna) {
  std::vector<PointingBand> bands;
  bands.reserve(antenna.bands.size());
  for (const auto& band : antenna.bands) {
    bands.push_back({band.name, band.frequency.value,
                     design::half_power_beamwidth(band.beamwidth_factor.value, band.frequency.value,
                                                  antenna.antenna.dish_diameter.value),
                     band.illumination});
  }
  return bands;
}

std::vector<PointingBudget> make_budgets(const io::Case& antenna) {
  std::vector<PointingBudget> budgets;
  const auto bands = make_bands(antenna);
  for (const auto& entry : antenna.budgets) {
    PointingBudget budget;
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

double tightest_budget(const io::Case& antenna) {
  const auto budgets = make_budgets(antenna);
  const auto tightest = std::ranges::min_element(budgets, {}, &PointingBudget::rms);
  return tightest != budgets.end() ? tightest->rms : 1e-3 * std::numbers::pi / 180.0;
}

std::optional<double> disks_at_unit_ratio(const io::Case& antenna, double load_inertia) {
  const io::MotorEntry& motor = antenna.motor;
  const double each = load_inertia / static_cast<double>(motor.count);
  const double disks =
      motor.flywheel_disks + (each - motor.inertia.value) / motor.disk_inertia.value;
  return disks >= 0.0 ? std::optional(disks) : std::nullopt;
}

}  // namespace boresight::app
