#include <algorithm>

#include <fmt/format.h>

#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/channel_findings.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::io {

std::vector<design::EnsembleMember> drawn_members(const design::Mission& mission,
                                                  const design::PlantDistribution& distribution,
                                                  std::uint64_t seed, std::size_t count) {
  std::vector<design::EnsembleMember> members;
  members.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    members.push_back(
        {fmt::format("sample {}", i + 1),
         linear_plant(changed(mission.antenna, changes_of(distribution.draw(seed, i))))});
  }
  return members;
}

namespace {

// Records tell the slope at the tracking rate to some per cent; at the slew rate, where the loops
// have to keep their margins too, friction damps far less.
design::EnsembleMember slewing_member(const design::Mission& mission) {
  const plant::Antenna& antenna = mission.antenna;
  const double rate = plant::sky_to_motor(antenna, antenna.drive.slew_rate);
  const double slope = std::max(0.0, plant::friction_slope(antenna.friction_curve, rate));
  return {"friction slope at the slew rate",
          linear_plant(changed(antenna, {plant::set_to("drive.viscous_friction", slope)}))};
}

}  // namespace

DesignedAntenna designed_antenna(const Case& stated, const std::optional<CampaignSection>& campaign,
                                 std::uint64_t seed) {
  if (campaign && rejection(*campaign) == Rejection::channels_contradict) {
    throw NumericalFailure(fmt::format("{}: {}", stated.path, channel_contradiction(*campaign)));
  }
  if (!campaign || !campaign->grey_box) {
    design::Mission mission = mission_of(stated);
    design::PlantEnsemble ensemble{design::EnsembleSource::ranges, plant_members(mission, seed)};
    auto distribution = design::PlantDistribution::of_ranges(mission);
    return {stated, std::move(mission), std::move(ensemble), std::move(distribution), {}, false};
  }
  // As many as the reference ensemble has.
  constexpr std::size_t members = 30;
  const identification::GreyBoxResult& found = *campaign->grey_box;
  const auto parts = taken_parts(stated, found);
  const Case identified = with_identified(stated, found.estimate, found.random_samples, parts);
  design::Mission mission = mission_of(identified);
  const auto distribution =
      design::PlantDistribution::of_records(mission, found.random_samples, parts);
  design::PlantEnsemble ensemble{design::EnsembleSource::records,
                                 drawn_members(mission, distribution, seed, members)};
  if (parts.friction_slope) ensemble.members.back() = slewing_member(mission);
  return {identified,
          std::move(mission),
          std::move(ensemble),
          distribution,
          superseded_inputs(stated, identified),
          true};
}

DesignedAntenna designed_antenna(const Case& stated, std::uint64_t seed, unsigned threads,
                                 const std::function<bool()>& interrupted) {
  if (stated.campaign->records.empty()) return designed_antenna(stated, std::nullopt, seed);
  IdentificationOptions study;
  study.seed = seed;
  study.threads = threads;
  study.progress = [&](std::size_t, std::size_t) {
    if (interrupted && interrupted()) throw Interrupted("interrupted by the user");
  };
  return designed_antenna(stated, identify_campaign(stated, study), seed);
}

}  // namespace boresight::io
