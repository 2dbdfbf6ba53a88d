#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A number of a case that enters the linear plant or the wind, with its possible error.
struct MovableNumber {
  Quantity quantity;
  std::size_t place = 0;  // among the case's such numbers
  /// The mode, for a mode's wind fraction or beam weight.
  std::optional<std::size_t> fraction_of_mode;
  /// Step to either side, in the SI unit (Hz for frequencies): the case's standard uncertainty;
  /// else, for an assumed value, a tenth of it; else the rounding of the printed digits.
  double moved_by = 0.0;
  /// True if the step is that tenth or the range below, for lack of an uncertainty.
  bool unstated = false;
  /// For an assumed wind fraction or beam weight: the two values to which it is moved, value -+
  /// step. The step is the distance to the inertia fraction of its body (for the bull gear: 1 less
  /// the modes'), at least half the value. The lower value is at least 0; the upper at most 1, or
  /// the value itself if above 1. moved_by is the larger of the two distances.
  std::optional<std::pair<double, double>> range;
};

/// The uncertain numbers, in the case's order. Numbers identified from records are left out: the
/// uncertainty that records leave is not the case's.
std::vector<MovableNumber> movable_numbers(const Case& antenna);

/// The case with one of its numbers moved to its lower or upper side. Other wind fractions or
/// `beam_weight`s are rescaled to a sum of 1. What a fraction loses is distributed in
/// proportion to inertia. A leakage rate computed from a flow scales with the oil's bulk modulus.
/// @throws InvalidInput if that leaves no structure.
Case moved(const Case& antenna, const MovableNumber& number, bool upwards);

}  // namespace boresight::io
