#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/campaign/identified_case.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::io {

/// The antenna that a study works on, and its perturbed models.
struct DesignedAntenna {
  /// The case as stated; with records that show a drive, the case with that one.
  Case antenna;
  design::Mission mission;  // of that case
  /// As many members as the reference ensemble: samples of the distribution that the records leave,
  /// else design::plant_members. If the records determine the friction slope, the last member is
  /// the antenna with its slope at the slew rate instead.
  design::PlantEnsemble ensemble;
  design::PlantDistribution distribution;
  /// Inputs of the stated case that the records replace; empty without records.
  std::vector<SupersededInput> superseded;
  bool from_records = false;  // else the case as stated
};

/// The first samples of a distribution, named "draw 1" and so on. The ensemble of an antenna with
/// records begins with the same samples.
/// @throws InvalidInput as plant::changed and plant::linear_plant.
std::vector<design::EnsembleMember> drawn_members(const design::Mission& mission,
                                                  const design::PlantDistribution& distribution,
                                                  std::uint64_t seed, std::size_t count);

/// What a case's identification makes of it; none: the case as stated. @throws as with_identified.
DesignedAntenna designed_antenna(const Case& stated, const std::optional<CampaignSection>& campaign,
                                 std::uint64_t seed);

/// Identifies a case's records, if it has any. The result does not depend on the number of threads.
/// @throws Interrupted once `interrupted` (may be empty) returned true, as identify_campaign and
/// with_identified.
DesignedAntenna designed_antenna(const Case& stated, std::uint64_t seed, unsigned threads,
                                 const std::function<bool()>& interrupted);

}  // namespace boresight::io
