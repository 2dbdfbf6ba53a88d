#pragma once

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {

/// The antenna of to_state_space(plant) as a core of eight states (drive, gear spring, bull gear)
/// with its structural modes around it, in angles relative to the bull gear, driven by the bull
/// gear's acceleration and the wind: the same inputs and outputs at O(modes).
/// @throws InvalidInput as to_state_space(plant).
ModalSystem to_modal_system(const AntennaPlant& plant);

}  // namespace boresight::plant
