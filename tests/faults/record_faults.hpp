#pragma once

#include <vector>

#include "recorder_fault.hpp"

namespace boresight::faults {

/// Exchanged columns, time bases, gaps, headers of records, and numbers of the case.
void add_record_faults(std::vector<RecorderFault>& faults);

}  // namespace boresight::faults
