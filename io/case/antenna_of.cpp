#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/units/quantity.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

numerics::Uncertain uncertain(const Quantity& quantity) {
  return {quantity.value, quantity.standard_uncertainty};
}

numerics::Uncertain part_inertia(const Case& stated, const AssemblyPart& part) {
  if (part.inertia) return uncertain(*part.inertia);
  const std::optional<Quantity>& density = stated.gear_train->density;
  if (!part.radius || !part.length || !density) {
    throw InvalidInput(
        fmt::format("part_inertia: '{}' has neither inertia nor dimensions", part.name));
  }
  return uncertain(solid_disk(*part.radius, *part.length, *density));
}

std::vector<double> line_lengths(const Case& stated) {
  std::vector<double> given;
  for (const auto& line : stated.campaign->lines) given.push_back(line.length.value);
  if (given.empty()) return {};
  const auto motors = static_cast<std::size_t>(stated.motor->count);
  std::ranges::sort(given);
  if (given.size() >= motors) return {given.begin(), given.begin() + stated.motor->count};
  if (motors == 1) return {given.front()};
  std::vector<double> lengths;
  for (std::size_t i = 0; i < motors; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(motors - 1);
    lengths.push_back(given.front() + fraction * (given.back() - given.front()));
  }
  return lengths;
}

std::optional<double> value_of(const std::optional<Quantity>& quantity) {
  return quantity ? std::optional(quantity->value) : std::nullopt;
}

double return_pressure_of(const Case& stated) {
  if (stated.simulation) return stated.simulation->return_pressure.value;
  return value_of(stated.campaign->return_pressure).value_or(0.0);
}

plant::GearTrain gear_train_of(const Case& stated) {
  plant::GearTrain train{gear_stages(stated), {}};
  for (const RotatingAssembly& assembly : stated.gear_train->assemblies) {
    train.assemblies.push_back({assembly_inertia(stated, assembly).value,
                                static_cast<double>(assembly.count), assembly.stages});
  }
  return train;
}

plant::NonlinearDrive nonlinear_drive_of(const Case& stated, const SimulationEntry& entry) {
  plant::NonlinearDrive drive;
  drive.return_pressure = entry.return_pressure.value;
  drive.null_leakage_share = entry.null_leakage_share.value;
  drive.case_leakage_share = entry.case_leakage_share.value;
  drive.valve_stroke = entry.valve_stroke.value;
  drive.valve_stroke_time = entry.valve_stroke_time.value;
  drive.valve_overlap = entry.valve_overlap.value;
  drive.makeup_pressure = entry.makeup_pressure.value;
  drive.air_fraction = entry.air_fraction.value;
  if (stated.oil->density) drive.oil_density = stated.oil->density->value;
  drive.line_lengths = line_lengths(stated);
  drive.line_damping_ratio = entry.line_damping_ratio.value;
  drive.bristle_stiffness = entry.bristle_stiffness.value;
  drive.bristle_damping = entry.bristle_damping.value;
  drive.offset_torque = entry.offset_torque.value;
  if (entry.offset_cosine) drive.offset_cosine = entry.offset_cosine->value;
  if (entry.offset_sine) drive.offset_sine = entry.offset_sine->value;
  drive.preload_torque = entry.preload_torque.value;
  if (entry.backlash) drive.backlash = entry.backlash->value;
  return drive;
}

plant::AntennaStructure structure_of(const plant::StructureSpecification& specification) {
  plant::AntennaStructure structure;
  structure.locked_rotor_frequency = specification.locked_rotor_frequency;
  structure.gear_damping_ratio = specification.gear_damping_ratio;
  structure.bull_gear_wind_fraction = specification.bull_gear_wind_fraction;
  structure.bull_gear_beam_weight = specification.bull_gear_beam_weight;
  structure.modes = specification.modes;
  return structure;
}

}  // namespace

numerics::Uncertain assembly_inertia(const Case& stated, const RotatingAssembly& assembly) {
  if (assembly.inertia) return uncertain(*assembly.inertia);
  numerics::Uncertain sum;
  double variance = 0.0;
  for (const AssemblyPart& part : assembly.parts) {
    const auto inertia = part_inertia(stated, part);
    sum.value += inertia.value;
    variance += std::pow(inertia.standard_uncertainty, 2);
  }
  sum.standard_uncertainty = std::sqrt(variance);
  return sum;
}

plant::Antenna drive_of(const Case& stated) {
  plant::Antenna antenna;
  antenna.inertia = stated.antenna->inertia.value;
  if (stated.antenna->elevation) antenna.elevation = stated.antenna->elevation->value;
  antenna.boresight_factor = pointing_axis(stated).boresight_factor;
  antenna.gear_train = gear_train_of(stated);
  antenna.hydraulics = hydraulic_drive(stated);
  const MotorEntry& motor = *stated.motor;
  antenna.flywheels = {motor.inertia.value, motor.flywheel_disks, motor.disk_inertia.value,
                       motor.flywheel_disks};
  const DriveEntry& drive = *stated.drive;
  antenna.drive = {drive.leakage_rate.value,
                   drive.viscous_friction.value,
                   drive.valve_frequency.value,
                   drive.valve_damping.value,
                   drive.supply_pressure.value,
                   drive.tracking_rate.value,
                   drive.slew_rate.value,
                   return_pressure_of(stated),
                   value_of(drive.valve_rated_flow),
                   value_of(drive.valve_rated_pressure_drop)};
  antenna.friction_curve = friction_curve(stated);
  const SensorsEntry& sensors = *stated.sensors;
  antenna.sensors = {sensors.encoder_noise.value, sensors.tachometer_noise.value,
                     sensors.torque_noise ? sensors.torque_noise->value : 0.0,
                     sensors.noise_bandwidth.value, sensors.tachometer_frequency.value};
  antenna.dead_time = stated.controller->delay.value;
  if (stated.simulation) antenna.nonlinear = nonlinear_drive_of(stated, *stated.simulation);
  return antenna;
}

plant::Antenna antenna_of(const Case& stated) {
  plant::Antenna antenna = drive_of(stated);
  antenna.structure = structure_of(structure_specification(*stated.structure));
  return antenna;
}

plant::AntennaPlant make_plant(const Case& stated,
                               const std::vector<plant::AntennaChange>& changes) {
  return linear_plant(changed(antenna_of(stated), changes));
}

std::vector<plant::Antenna> antennas_of(const Case& stated) {
  std::vector<plant::Antenna> antennas;
  for (const auto& specification : structure_specifications(*stated.structure)) {
    antennas.push_back(drive_of(stated));
    antennas.back().structure = structure_of(specification);
  }
  return antennas;
}

}  // namespace boresight::io
