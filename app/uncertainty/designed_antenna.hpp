#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <boresight/app/identify/campaign_section.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>

namespace boresight::app {

/// The antenna that a study works on, and the plants that may be the true one.
struct DesignedAntenna {
  /// The case as stated; with records that show a drive, the case with that one.
  io::Case antenna;
  design::Mission mission;  // of that case
  /// As many as the reference ensemble has: draws of the distribution where records leave it open,
  /// else design::plant_members.
  design::PlantEnsemble ensemble;
  design::PlantDistribution distribution;
  bool from_records = false;
  /// Of the antenna as stated; none where records show the drive.
  std::optional<ResonanceVerdict> resonance = std::nullopt;
};

/// What a case's identification makes of it; none: the case as stated. @throws as with_identified.
DesignedAntenna designed_antenna(const io::Case& stated,
                                 const std::optional<CampaignSection>& campaign,
                                 std::uint64_t seed);

/// Identifies a case's records, if it has any. The same for any number of threads.
/// @throws Interrupted once `interrupted` (may be empty) said yes, as identify_campaign and
/// with_identified.
DesignedAntenna designed_antenna(const io::Case& stated, std::uint64_t seed, unsigned threads,
                                 const std::function<bool()>& interrupted);

}  // namespace boresight::app
