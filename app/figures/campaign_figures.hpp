#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// What the records of a campaign show, each under its heading of the text report: reflected
/// inertia and ratio by method with the reconciled one, estimates that go together, ringing lines
/// with their fits, torque spectra with peaks and harmonics, rings after valve steps, torque over
/// rate, the friction curve with its data and band, numbers of the case against the records, and a
/// record foretold. What the campaign does not have is left out.
std::vector<Figure> campaign_figures(const io::CampaignSection& section);

}  // namespace boresight::app
