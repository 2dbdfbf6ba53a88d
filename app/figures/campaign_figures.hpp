#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// Figures of a campaign's records, each under its heading of the text report. They show reflected
/// inertia and ratio by method with the combined estimate, correlated estimates, and ringing lines
/// with their fits. Further: torque spectra with peaks and harmonics, rings after valve steps,
/// torque over rate, and the friction curve with its data and band. Last: numbers of the case
/// against the records, and a predicted record. Figures without data are left out.
std::vector<Figure> campaign_figures(const io::CampaignSection& section);

}  // namespace boresight::app
