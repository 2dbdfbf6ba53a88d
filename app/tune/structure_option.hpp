#pragma once

#include <string>
#include <vector>

#include <boresight/design/problem/mission.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// io::asked_structures of what --structure names.
/// @throws InvalidInput that names --structure, as io::asked_structures.
design::CandidateStructures structure_option(const io::Case& antenna,
                                             const std::vector<std::string>& asked);

}  // namespace boresight::app
