#pragma once

#include <vector>

#include "recorder_fault.hpp"

namespace boresight::faults {

/// States for each fault that puts one of the fit's stated numbers in error, and that no other
/// channel contradicts directly, which number, by how much, and why only other stated numbers
/// contradict it.
void add_stated_numbers(std::vector<RecorderFault>& faults);

}  // namespace boresight::faults
