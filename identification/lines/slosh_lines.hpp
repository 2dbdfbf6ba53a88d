#pragma once

#include <boresight/identification/lines/slosh.hpp>

namespace boresight::identification {

/// The last step of identify_slosh: gives the result's lines their lengths, and lines and result
/// their wave speeds and bulk moduli. `motors`: of the record.
void add_bulk_moduli(SloshResult& result, const DriveKnowledge& knowledge, std::size_t motors);

}  // namespace boresight::identification
