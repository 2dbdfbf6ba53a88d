#pragma once

#include <vector>

#include <boresight/control/controllers/controller.hpp>

namespace boresight::control {

/// A first- or second-order factor of a path's compensator: numerator over denominator in s, lowest
/// power first.
struct PathSection {
  BlockKind kind = BlockKind::gain;
  std::string symbol;  // of its first gain
  std::vector<double> numerator, denominator;
};

/// A path as a chain of sections: the path's gain in the first of them, each lead on a lag of its
/// own, which gives the section its kind and symbol. A path of a gain alone is one section of order
/// 0; a path without blocks is none. A dead zone or freeze is left out, as 1. The product of the
/// sections is the path's compensator (LoopPath). Gains as compensator_response.
std::vector<PathSection> path_sections(const Controller& controller, LoopPath path);

/// The product of the path's gain blocks; 1 without any.
double path_gain(const Controller& controller, LoopPath path);

}  // namespace boresight::control
