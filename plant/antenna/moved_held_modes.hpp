#pragma once

#include <optional>
#include <vector>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::plant {

/// The antenna with its frequencies moved to those of the motors held that a test has found, the
/// lowest first (Hz; nothing: not found). All frequencies are scaled by the lowest one's ratio;
/// then, one after the other, mode j + 1 is moved until the j-th frequency with the motors held is
/// the stated one: it lies below that mode and close to it (motors_held_modes.hpp). The lowest mode
/// and the highest frequency with the motors held, which is mostly the bull gear's on the gear
/// spring, follow from the rest. Inertias, damping ratios, wind and beam fractions stay.
/// @return nothing where the lowest frequency is not stated or no antenna was reached.
std::optional<StructureSpecification> with_motors_held_frequencies(
    StructureSpecification antenna, const std::vector<std::optional<double>>& frequencies);

}  // namespace boresight::plant
