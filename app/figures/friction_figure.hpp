#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// Friction against speed: windows of all tests both ways, the curve through them, the reconciled
/// curve with its 95 % band, constant-speed tests with their intervals, the tracking rate. None for
/// a campaign without friction.
std::vector<Figure> friction_figure(const io::CampaignSection& section);

}  // namespace boresight::app
