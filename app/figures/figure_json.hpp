#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// An array of the figures with every point plotted: the `figures` of each report's JSON, and the
/// values shown at the pointer on a page. Numbers of six digits; null marks a gap.
nlohmann::ordered_json figures_json(const std::vector<Figure>& figures);

}  // namespace boresight::app
