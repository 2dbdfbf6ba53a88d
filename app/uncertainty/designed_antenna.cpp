#include <fmt/format.h>

#include <boresight/app/identify/campaign_identification.hpp>
#include <boresight/app/identify/identified_case.hpp>
#include <boresight/app/tune/plant_members.hpp>
#include <boresight/app/uncertainty/designed_antenna.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {

DesignedAntenna designed_antenna(const io::Case& stated,
                                 const std::optional<CampaignSection>& campaign,
                                 std::uint64_t seed) {
  if (!campaign || !campaign->grey_box) {
    return {stated,
            {"drawn from the ranges of the case", plant_members(stated, seed)},
            PlantDistribution::of_ranges(stated),
            false,
            resonance_verdict(stated)};
  }
  // As many as the reference ensemble has.
  constexpr std::size_t members = 30;
  const io::Case identified = with_identified(stated, campaign->grey_box->estimate);
  const auto distribution = PlantDistribution::of_records(identified, campaign->grey_box->draws);
  PlantEnsemble ensemble{"drawn from what the records leave open", {}};
  for (std::size_t i = 0; i < members; ++i) {
    ensemble.members.push_back({fmt::format("draw {}", i + 1),
                                make_plant(identified, changes_of(distribution.draw(seed, i)))});
  }
  return {identified, std::move(ensemble), distribution, true};
}

DesignedAntenna designed_antenna(const io::Case& stated, std::uint64_t seed, unsigned threads,
                                 const std::function<bool()>& interrupted) {
  if (stated.campaign.records.empty()) return designed_antenna(stated, std::nullopt, seed);
  StudyOptions study;
  study.seed = seed;
  study.threads = threads;
  study.progress = [&](std::size_t, std::size_t) {
    if (interrupted && interrupted()) throw Interrupted("interrupted by the user");
  };
  return designed_antenna(stated, identify_campaign(stated, study), seed);
}

}  // namespace boresight::app
