#pragma once

#include <boresight/app/redesign/sections.hpp>

namespace boresight::app {

/// Everything that the records of a case say of its drive: bulk modulus from slosh tests, hydraulic
/// resonance, impulse and momentum, friction, the grey box that reconciles them, and what further
/// tests would add. A method that the campaign does not allow is listed with its reason. The result
/// depends on the seed, not on the number of threads; progress is told in hundredths.
/// @throws InvalidInput as make_campaign; NumericalFailure if not one method beside the mass
/// properties gives an inertia; what options.progress throws (Interrupted).
CampaignSection identify_campaign(const io::Case& antenna, const StudyOptions& options);

}  // namespace boresight::app
