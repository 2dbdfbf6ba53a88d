#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::io {

double gear_train_inertia(const Case& antenna) {
  return plant::gear_train_inertia(drive_of(antenna));
}

double motor_inertia(const Case& antenna, double disks) {
  return plant::motor_inertia(
      changed(drive_of(antenna), {plant::set_to("motor.flywheel_disks", disks)}));
}

double antenna_inertia(const Case& antenna) {
  return plant::reflected_inertia(antenna.antenna->inertia.value, gear_ratio(antenna));
}

double antenna_inertia(const Case& antenna, const AntennaAlternative& alternative) {
  if (alternative.reflected_inertia) return alternative.reflected_inertia->value;
  if (!alternative.inertia) {
    throw InvalidInput(fmt::format("antenna alternative '{}' has no inertia", alternative.name));
  }
  return plant::reflected_inertia(alternative.inertia->value, gear_ratio(antenna));
}

std::vector<plant::AntennaChange> changes_of(const Case& antenna,
                                             const AntennaAlternative& alternative) {
  const double inertia = antenna_inertia(antenna, alternative);
  std::vector changes{plant::set_to("at_shaft.antenna_inertia", inertia)};
  if (alternative.keeps_springs) {
    changes.push_back(
        plant::scaled_by("structure.frequencies", std::sqrt(antenna_inertia(antenna) / inertia)));
  }
  return changes;
}

double bulk_modulus(const Case& antenna) {
  return bulk_modulus_of(*antenna.oil).value;
}

double oil_stiffness(const Case& antenna, plant::EfficiencyInStiffness efficiency) {
  plant::HydraulicDrive drive = hydraulic_drive(antenna);
  drive.efficiency_in_stiffness = efficiency;
  return plant::oil_stiffness(drive);
}

double oil_stiffness(const Case& antenna) {
  return plant::oil_stiffness(hydraulic_drive(antenna));
}

std::vector<plant::AntennaChange> bulk_modulus_times(const Case& antenna, double factor) {
  std::vector changes{plant::scaled_by("at_shaft.oil_stiffness", factor)};
  if (antenna.drive->leakage_by_flow) {
    changes.push_back(plant::scaled_by("drive.leakage_rate", factor));
  }
  return changes;
}

double largest_viscous_friction(const Case& antenna) {
  return std::max(tracking_friction(antenna), antenna.drive->viscous_friction.value);
}

std::optional<double> disks_at_unit_ratio(const Case& antenna, double load_inertia) {
  return plant::disks_at_unit_ratio(drive_of(antenna), load_inertia);
}

double available_wind_torque(const Case& antenna) {
  return plant::available_wind_torque(drive_of(antenna));
}

double largest_demand(const Case& antenna) {
  return plant::largest_demand(drive_of(antenna));
}

std::string demand_assumption(const Case& antenna) {
  if (antenna.simulation) {
    const Quantity& stroke = antenna.simulation->valve_stroke;
    if (stroke.basis != Basis::assumed) return "";
    return fmt::format("a valve stroke of {} that is assumed{}", stroke.text,
                       stroke.source.empty() ? "" : fmt::format(" ({})", stroke.source));
  }
  if (rated_stroke(antenna)) return "";
  return fmt::format("a valve stroke of {:.4g} rad/s that is assumed (what the slew rate takes)",
                     largest_demand(antenna));
}

}  // namespace boresight::io
