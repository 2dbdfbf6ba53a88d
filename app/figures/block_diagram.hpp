#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/control/controllers/controller.hpp>

namespace boresight::app {

/// The cascade of a structure as a block diagram: position and rate compensators with their
/// factors, pressure and compliance path where the structure has them, dead time and antenna, with
/// `gains` (in the structure's order, with units) at their factors. Without gains: symbols alone,
/// for documents. `dead_time`: s.
/// The drawing is the figure's SVG; its panel lists signals and blocks at the same places.
/// @throws InvalidInput where the number of gains is neither 0 nor the structure's.
Figure block_diagram(const std::string& id, const std::string& section,
                     const control::LoopStructure& structure, const std::vector<std::string>& gains,
                     double dead_time);

/// A factor of a compensator with the symbols of its gains: "1 + wi/s".
std::string factor_text(const control::LoopBlock& block);

}  // namespace boresight::app
