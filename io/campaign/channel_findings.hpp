#pragma once

#include <string>
#include <vector>

#include <boresight/io/campaign/recommended_values.hpp>

namespace boresight::io {

/// Whether a row of the channels contradicts (identification::contradicts).
bool channels_contradict(const CampaignSection& section);

/// The suspect channels and what to do, a sentence; empty if none that is used is suspect.
std::string channel_contradiction(const CampaignSection& section);

/// Suspect channels that no other explains (identification::unexplained_suspects), one a fault.
std::vector<ChannelSuspicion> channel_suspicions(const CampaignSection& section);

/// What a channel shows against what it is compared with: "1.05 times (1.048 to 1.052) the encoder,
/// stated to 0.3 %".
std::string departure_of(const identification::ChannelCheck& check);

}  // namespace boresight::io
