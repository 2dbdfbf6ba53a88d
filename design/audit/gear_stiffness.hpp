#pragma once

#include <cstddef>
#include <optional>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::design {

/// Frequency (Hz) of one mode with the bull gear locked at which its gear spring has the given
/// stiffness, everything else unchanged. Stiffness in N m/rad at the shaft of antenna_inertia, per
/// antenna inertia where that is 1. The stiffness falls as the mode rises (plant::make_structure).
/// None up to 1000 Hz, or if less than 0.1 % above the locked-rotor frequency, which is too close
/// to be intended.
/// @throws InvalidInput as plant::make_structure, std::out_of_range if there is no such mode.
std::optional<double> mode_frequency_for(plant::StructureSpecification antenna, std::size_t mode,
                                         double gear_stiffness);

}  // namespace boresight::design
