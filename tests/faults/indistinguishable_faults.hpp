#pragma once

#include <vector>

#include "recorder_fault.hpp"

namespace boresight::faults {

/// States for each fault that no analysis of the records can tell why (docs/identification.md,
/// "What the comparison cannot tell").
void add_proofs(std::vector<RecorderFault>& faults);

}  // namespace boresight::faults
