#pragma once

#include <vector>

#include <boresight/identification/records/channel_consistency.hpp>

namespace boresight::identification {

/// Of channel_consistency the rows of inlets, outlets and torques. Drives with one motor have none.
std::vector<ChannelCheck> pressure_consistency(const std::vector<EvaluatedRecord>& records,
                                               const DriveKnowledge& knowledge,
                                               const Instruments& instruments,
                                               const ChannelConsistencyOptions& options);

}  // namespace boresight::identification
