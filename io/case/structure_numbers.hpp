#pragma once

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// What a case states of its structure as the plant takes it, every mode by its frequency with the
/// bull gear held: as stated, or solved for (plant/antenna/motors_held_modes.hpp) where the case
/// states frequencies with the motors held; then by the effective fractions where it states them,
/// else of several antennas the one with the softest gear spring. Inertia 1. @throws InvalidInput
/// as hold_bull_gear_of and antenna_of_effective_fractions.
plant::StructureSpecification structure_specification(const StructureEntry& structure);

/// The same of every antenna that has the stated frequencies, the softest gear spring first; one
/// where the modes are stated with the bull gear held or by effective fractions.
std::vector<plant::StructureSpecification> structure_specifications(
    const StructureEntry& structure);

/// The locked-rotor frequency (Hz) at which the antenna has this gear stiffness (N m/rad at the
/// shaft of antenna_inertia, per antenna inertia where that is 1). Its modes with the bull gear
/// locked, and all else, are unchanged. The antenna's own locked_rotor_frequency is not used.
/// @throws InvalidInput if no frequency distinguishable by rounding from the lowest mode has it,
/// and as plant::make_structure.
double locked_rotor_frequency_for(plant::StructureSpecification antenna, double gear_stiffness);

}  // namespace boresight::io
