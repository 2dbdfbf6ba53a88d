#pragma once

#include <cstddef>
#include <vector>

#include <boresight/identification/records/channel_consistency.hpp>

namespace boresight::identification {

/// True for a gain and for a sign, which is a gain below 0.
bool is_gain(const ChannelCheck& check);

/// Whether no value from records with this row can be recommended: a suspect quantity of a channel
/// whose values are used. Not the tachometer's sign, which is the encoder's, as a reversed
/// tachometer is refused by the torque, nor its zero and delay, which the grey box fits.
bool contradicts(const ChannelCheck& check);

/// Places of the suspect rows of channel_consistency, in its order, but those that another suspect
/// row explains: the torque of a motor by one of its pressures, a zero or delay by the gain of the
/// same channel. A row of one record explains rows of that record only.
std::vector<std::size_t> unexplained_suspects(const std::vector<ChannelCheck>& checks);

/// Whether two rows are one fault: the same quantity of one motor in the same records, with the
/// same likely factor among those with a name.
bool is_one_fault(const ChannelCheck& one, const ChannelCheck& other);

}  // namespace boresight::identification
