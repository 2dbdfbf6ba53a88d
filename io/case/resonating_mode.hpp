#pragma once

#include <boresight/io/case/case_file.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// The mode of a plant that the measured resonance of a case is compared with:
/// plant::hydraulic_mode, or plant::mode_of_oil where resonance.mode is "oil".
/// @throws NumericalFailure as these and plant::plant_modes.
plant::PlantMode resonating_mode(const Case& antenna, const plant::AntennaPlant& plant);

/// Whether the measured resonance may be read as the whole antenna, rigid, on the oil spring: it is
/// of the hydraulic mode of the case's plant, and at least half of that mode's elastic energy is in
/// the oil. @throws InvalidInput as make_plant, NumericalFailure as resonating_mode.
bool rings_as_rigid(const Case& antenna);

/// Whether less than half of a mode's elastic energy is in the oil, and the mode_of_oil has more
/// there: it then tells little of the oil. Never of an overdamped mode, whose shares are none of an
/// energy.
bool little_of_oil(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil);

}  // namespace boresight::io
