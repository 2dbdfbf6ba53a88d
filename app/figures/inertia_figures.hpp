#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// Reflected inertia and motor-to-load ratio by each method of a campaign with 95 % intervals, the
/// combined estimate first. Values far beyond the others, and open intervals, are cut off at the
/// scale.
std::vector<Figure> inertia_figures(const io::CampaignSection& section);

/// The same for the methods based on the case's stated numbers, with the values printed in the
/// case. (The section's own heading is theirs.)
std::vector<Figure> inertia_figures(const IdentificationSection& section);

}  // namespace boresight::app
