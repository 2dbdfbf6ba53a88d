#pragma once

#include <cstddef>

#include <boresight/control/analysis/margins.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::control {

struct ModalMarginOptions {
  CrossoverOptions crossovers;
  /// rad/s; 0: two decades below the slowest and above the fastest pole of core and modes.
  double lowest = 0.0;
  double highest = 0.0;
  int points_per_decade = 40;
  /// The grid is halved until L changes by less than this in angle (rad) and in ln|L| from point to
  /// point. This also finds lightly damped zeros, which no list of poles contains.
  double largest_turn = 0.35;
  std::size_t max_points = 1000000;
};

/// Margins of an open loop L given as a modal system's response, including exact dead times, at
/// O(modes) per frequency. All crossovers between two frequencies are found on a grid adapted to L
/// and refined on L itself. Other frequencies are not covered.
/// @throws InvalidInput for limits that are not positive and rising, or a turn outside 0.01..1;
/// NumericalFailure if L is not finite at a frequency (a pole on the axis) or the points do not
/// suffice.
Margins margins(const plant::ModalResponse& loop, const ModalMarginOptions& options = {});

}  // namespace boresight::control
