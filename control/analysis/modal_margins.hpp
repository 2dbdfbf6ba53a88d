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
  /// The grid is halved until L turns by less than this from point to point (rad) and changes by
  /// less than as much in ln|L|: lightly damped zeros, which no list of poles gives, are found so.
  double largest_turn = 0.35;
  std::size_t most_points = 1000000;
};

/// Margins of an open loop L given as a modal system's response, exact dead times within it, at
/// O(modes) a frequency: all crossovers between two frequencies, found on a grid that follows L
/// wherever it turns and refined on L itself. Nothing is said of other frequencies.
/// @throws InvalidInput for limits that are not positive and rising, or a turn outside 0.01..1;
/// NumericalFailure if L is not finite at a frequency (a pole on the axis) or the points do not
/// suffice.
Margins margins(const plant::ModalResponse& loop, const ModalMarginOptions& options = {});

}  // namespace boresight::control
