#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// An array of the figures with every point plotted: the `figures` of each report's JSON, and what
/// a page shows where the pointer is. Numbers of six digits; null stands for a gap.
nlohmann::ordered_json figures_json(const std::vector<Figure>& figures);

}  // namespace boresight::app
