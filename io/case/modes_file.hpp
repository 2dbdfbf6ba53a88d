#pragma once

#include <string>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// The structure of a table file of free vibration modes (docs/case-file.md,
/// `structure.modes_file`) with its bull gear held; inertia about the antenna axis,
/// locked_rotor_frequency 0.
/// @throws InvalidInput as read_unit_table and plant::hold_bull_gear, naming the file.
plant::StructureSpecification read_modes_file(const std::string& path);

}  // namespace boresight::io
