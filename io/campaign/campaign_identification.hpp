#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/campaign/loaded_campaign.hpp>

namespace boresight::io {

struct IdentificationOptions {
  std::uint64_t seed = 1;
  unsigned threads = 2;
  /// Called with tasks done and all tasks; may be empty. What it throws ends the work.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// Everything that the records of a case say of its drive: bulk modulus from slosh tests, hydraulic
/// resonance, impulse and momentum, friction, the grey box that reconciles them, and what further
/// tests would add. A method that the campaign does not allow is listed with its reason. The result
/// depends on the seed, not on the number of threads; progress is told in hundredths.
/// @throws InvalidInput as make_campaign; NumericalFailure if not one method beside the mass
/// properties gives an inertia; what options.progress throws (Interrupted).
CampaignSection identify_campaign(const Case& antenna, const IdentificationOptions& options);

/// The same of records that are read already, of the same case (load_campaign). Given away, their
/// raw samples are freed before the methods run. @throws as above.
CampaignSection identify_campaign(const Case& antenna, LoadedCampaign loaded,
                                  const IdentificationOptions& options);

}  // namespace boresight::io
