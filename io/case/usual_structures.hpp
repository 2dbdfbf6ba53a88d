#pragma once

#include <string>
#include <vector>

namespace boresight::io {

/// Short names of the loop structures that are usual, as control::LoopStructure::named takes them.
const std::vector<std::string>& usual_structures();

}  // namespace boresight::io
