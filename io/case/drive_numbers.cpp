#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::io {

std::vector<plant::GearStage> gear_stages(const Case& antenna) {
  std::vector<plant::GearStage> stages;
  stages.reserve(antenna.gear_train->stages.size());
  for (const GearStageEntry& stage : antenna.gear_train->stages) {
    stages.push_back({stage.driven_teeth.value, stage.driving_teeth.value});
  }
  return stages;
}

double gear_ratio(const Case& antenna) {
  return plant::gear_ratio(gear_stages(antenna));
}

control::DrivenLoad driven_load(const Case& antenna) {
  const double ratio = gear_ratio(antenna);
  return {antenna.structure->locked_rotor_frequency.value,
          antenna.antenna->inertia.value / (ratio * ratio)};
}

Quantity solid_disk(const Quantity& radius, const Quantity& length, const Quantity& density) {
  const double value = plant::disk_inertia(radius.value, length.value, density.value);
  Quantity inertia = derived_quantity(radius, Kind::inertia, value, "kg.m2");
  // J scales with R^4, H and rho.
  inertia.standard_uncertainty =
      value * std::hypot(4.0 * relative_uncertainty(radius), relative_uncertainty(length),
                         relative_uncertainty(density));
  return inertia;
}

Quantity bulk_modulus_of(const OilEntry& oil) {
  if (oil.bulk_modulus) return *oil.bulk_modulus;
  if (!oil.density) {
    throw InvalidInput("expected a bulk modulus or a density of the oil, found neither");
  }
  const auto lines = static_cast<double>(oil.lines.size());
  Quantity mean;
  mean.kind = Kind::pressure;
  double variance = 0.0;
  for (const OilLine& line : oil.lines) {
    const double modulus = plant::bulk_modulus_from_slosh(
        line.length.value, line.slosh_frequency.value, oil.density->value);
    mean.value += modulus / lines;
    variance += std::pow(2.0 * modulus / lines *
                             std::hypot(relative_uncertainty(line.length),
                                        relative_uncertainty(line.slosh_frequency)),
                         2);
  }
  mean.standard_uncertainty =
      std::hypot(std::sqrt(variance), mean.value * relative_uncertainty(*oil.density));
  return mean;
}

plant::FrictionCurve friction_curve(const Case& antenna) {
  const FrictionCurveEntry& curve = *antenna.friction_curve;
  return {curve.coulomb.value,    curve.breakaway.value,       curve.stribeck_rate.value,
          curve.saturating.value, curve.saturating_rate.value, curve.viscous.value};
}

double tracking_slope(const Case& antenna) {
  return plant::friction_slope(friction_curve(antenna),
                               antenna.drive->tracking_rate.value * gear_ratio(antenna));
}

double tracking_friction(const Case& antenna) {
  return std::max(0.0, tracking_slope(antenna));
}

plant::HydraulicDrive hydraulic_drive(const Case& antenna) {
  const MotorEntry& motor = *antenna.motor;
  const OilEntry& oil = *antenna.oil;
  return {static_cast<double>(motor.count),
          motor.displacement.value,
          motor.torque_efficiency.value,
          motor.volumetric_efficiency.value,
          bulk_modulus_of(oil).value,
          oil.volume_1.value,
          oil.volume_2.value,
          oil.efficiency_in_stiffness ? plant::EfficiencyInStiffness::both
                                      : plant::EfficiencyInStiffness::none};
}

double supply_torque(const Case& antenna) {
  return antenna.drive->supply_pressure.value *
         plant::torque_per_pressure(hydraulic_drive(antenna));
}

std::optional<Quantity> rated_stroke(const Case& antenna,
                                     const std::optional<Quantity>& return_pressure) {
  const auto& flow = antenna.drive->valve_rated_flow;
  const auto& drop = antenna.drive->valve_rated_pressure_drop;
  if (!flow || !drop) return std::nullopt;
  const Quantity& supply = antenna.drive->supply_pressure;
  const Quantity& displacement = antenna.motor->displacement;
  const double driving = supply.value - (return_pressure ? return_pressure->value : 0.0);
  const double of_driving =
      std::hypot(supply.standard_uncertainty,
                 return_pressure ? return_pressure->standard_uncertainty : 0.0) /
      driving;
  const double rate = flow->value * std::sqrt(driving / drop->value) /
                      (static_cast<double>(antenna.motor->count) * displacement.value);
  Quantity stroke = derived_quantity(*flow, Kind::angular_rate, rate, "rad/s");
  stroke.standard_uncertainty =
      stroke.value *
      std::hypot(std::hypot(relative_uncertainty(*flow), relative_uncertainty(displacement)),
                 0.5 * relative_uncertainty(*drop), 0.5 * of_driving);
  if (drop->basis == Basis::assumed) stroke.basis = Basis::assumed;
  return stroke;
}

std::optional<Quantity> rated_stroke(const Case& antenna) {
  return rated_stroke(antenna, antenna.simulation ? antenna.simulation->return_pressure
                                                  : antenna.campaign->return_pressure);
}

}  // namespace boresight::io
