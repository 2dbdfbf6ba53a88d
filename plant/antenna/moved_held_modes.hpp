#pragma once

#include <optional>
#include <vector>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::plant {

/// The antenna with its frequencies changed to those that a test found with the motors locked, the
/// lowest first (Hz; nothing: not found). All frequencies are scaled by the ratio of the lowest
/// one. Then mode j + 1 is changed, one after the other, until the j-th frequency with the motors
/// locked is the stated one. That frequency lies below the mode and close to it
/// (motors_held_modes.hpp). The lowest mode follows from the rest. So does the highest frequency
/// with the motors locked, which is mostly that of the bull gear on the gear spring. Inertias,
/// damping ratios, wind fractions and beam weights stay.
/// @return nothing if the lowest frequency is not stated or no antenna was reached.
std::optional<StructureSpecification> with_motors_held_frequencies(
    StructureSpecification antenna, const std::vector<std::optional<double>>& frequencies);

}  // namespace boresight::plant
