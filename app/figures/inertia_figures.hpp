#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// Reflected inertia and motor-to-load ratio by each method of a campaign with 95 % intervals, the
/// reconciled estimate first. What lies far beyond the others, or has
/// no end, goes on beyond the scale.
std::vector<Figure> inertia_figures(const io::CampaignSection& section);

/// The same of the methods that rest on the case's stated numbers, with the values that the case
/// prints beside them. (The section's own heading is theirs.)
std::vector<Figure> inertia_figures(const IdentificationSection& section);

}  // namespace boresight::app
