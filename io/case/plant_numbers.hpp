#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::io {

/// Gear train and counter-torque motors at the motor shaft (kg m2).
double gear_train_inertia(const Case& antenna);
/// All motors with `disks` flywheel disks each (kg m2).
double motor_inertia(const Case& antenna, double disks);
/// The antenna inertia of the case, and of an alternative, at the motor shaft (kg m2).
double antenna_inertia(const Case& antenna);
double antenna_inertia(const Case& antenna, const AntennaAlternative& alternative);
/// What makes the case's antenna that of an alternative: with the case's frequencies, or with the
/// case's springs and inertia fractions, which scales all frequencies alike.
std::vector<plant::AntennaChange> changes_of(const Case& antenna,
                                             const AntennaAlternative& alternative);
/// That of the case, or the mean over its lines (Pa).
double bulk_modulus(const Case& antenna);
/// Oil spring by the case's bulk modulus, or the mean of its lines (N m/rad).
double oil_stiffness(const Case& antenna, plant::EfficiencyInStiffness efficiency);
double oil_stiffness(const Case& antenna);
/// What a bulk modulus so many times the case's does: oil spring, and leakage rate where the case
/// states a flow, whose conductance stays; a rate is as measured.
std::vector<plant::AntennaChange> bulk_modulus_times(const Case& antenna, double factor);
/// The most viscous friction that a linear plant may have (N m s/rad): tracking_friction, or what
/// the case states for it.
double largest_viscous_friction(const Case& antenna);
/// Number of flywheel disks at which motors and load (gear train and antenna) have one inertia;
/// nothing if that would need fewer than none.
std::optional<double> disks_at_unit_ratio(const Case& antenna, double load_inertia);

/// What is left of the supply torque against wind (N m): the supply's less the friction at the
/// tracking rate and the magnitude of the offset torque at antenna.elevation, since the wind may
/// blow the way that both resist; 0 where they take all of it.
double available_wind_torque(const Case& antenna);

/// The largest rate (rad/s of motor) that may be asked of the valve: simulation.valve_stroke; else
/// by its rated flow; else what the slew rate takes.
double largest_demand(const Case& antenna);
/// Assumption behind largest_demand, in words, if the case states no number of its valve for it;
/// else empty.
std::string demand_assumption(const Case& antenna);

}  // namespace boresight::io
