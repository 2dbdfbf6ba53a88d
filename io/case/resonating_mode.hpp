#pragma once

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// The mode of a plant that the measured resonance of a case is compared with:
/// plant::hydraulic_mode, or plant::mode_of_oil where resonance.mode is "oil".
/// @throws NumericalFailure as these and plant::plant_modes.
plant::PlantMode resonating_mode(const Case& antenna, const plant::AntennaPlant& plant);

/// True if the measured resonance may be read as the whole rigid antenna on the oil spring. It must
/// be that of the hydraulic mode of the case's plant, with at least half of that mode's elastic
/// energy in the oil.
/// @throws InvalidInput as make_plant, NumericalFailure as resonating_mode.
bool rings_as_rigid(const Case& antenna);

/// True if less than half of a mode's elastic energy is in the oil and the mode_of_oil has more
/// there: the mode then carries little information on the oil. Always false for an overdamped mode,
/// for which energy fractions have no meaning.
bool little_of_oil(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil);

}  // namespace boresight::io
