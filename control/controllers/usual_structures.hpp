#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>

namespace boresight::control {

/// Short names of the usual loop structures, as accepted by LoopStructure::named.
const std::vector<std::string>& usual_structures();

/// The name of a structure for --structure: the short name of a usual structure, otherwise its own
/// name.
std::string short_name(const LoopStructure& structure);

}  // namespace boresight::control
