#pragma once

#include <vector>

#include <boresight/identification/records/channel_consistency.hpp>

namespace boresight::identification {

/// Of channel_consistency the rows of the tachometer; none where no record has an encoder or the
/// gear ratio is not known.
std::vector<ChannelCheck> tachometer_consistency(const std::vector<EvaluatedRecord>& records,
                                                 const DriveKnowledge& knowledge,
                                                 const Instruments& instruments,
                                                 const ChannelConsistencyOptions& options);

}  // namespace boresight::identification
