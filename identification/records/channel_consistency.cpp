#include <iterator>

#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/identification/records/pressure_consistency.hpp>
#include <boresight/identification/records/tachometer_consistency.hpp>

namespace boresight::identification {

std::vector<ChannelCheck> channel_consistency(const std::vector<EvaluatedRecord>& records,
                                              const DriveKnowledge& knowledge,
                                              const Instruments& instruments,
                                              const ChannelConsistencyOptions& options) {
  auto rows = tachometer_consistency(records, knowledge, instruments, options);
  auto pressures = pressure_consistency(records, knowledge, instruments, options);
  rows.insert(rows.end(), std::make_move_iterator(pressures.begin()),
              std::make_move_iterator(pressures.end()));
  return rows;
}

}  // namespace boresight::identification
