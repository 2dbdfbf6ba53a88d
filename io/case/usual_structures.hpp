#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>

namespace boresight::io {

/// Short names of the loop structures that are usual, as control::LoopStructure::named takes them.
const std::vector<std::string>& usual_structures();

/// The name that --structure takes of a structure: a usual one's short name, else its own.
std::string short_name(const control::LoopStructure& structure);

}  // namespace boresight::io
