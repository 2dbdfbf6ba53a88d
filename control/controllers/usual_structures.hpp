#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>

namespace boresight::control {

/// Short names of the loop structures that are usual, as LoopStructure::named takes them.
const std::vector<std::string>& usual_structures();

/// The name that --structure takes of a structure: a usual one's short name, else its own.
std::string short_name(const LoopStructure& structure);

}  // namespace boresight::control
