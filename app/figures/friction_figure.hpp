#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// Friction against speed: windows of all tests in both directions, the curve fitted to them, the
/// combined estimate of the curve with its 95 % band, constant-speed tests with their intervals,
/// the tracking rate. Empty for a campaign without friction.
std::vector<Figure> friction_figure(const io::CampaignSection& section);

}  // namespace boresight::app
