#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <boresight/io/case/case_file.hpp>

namespace boresight::io {

/// A number of a case that linear plant or wind are made of, and how far it may be off.
struct MovableNumber {
  Quantity quantity;
  std::size_t place = 0;  // among the case's such numbers
  /// Of a mode's share of wind or beam the mode.
  std::optional<std::size_t> share_of_mode;
  /// How far it is moved to either side, in its SI unit (Hz for frequencies): by the standard
  /// uncertainty that the case gives, else, where its value is assumed, by a tenth of it, else by
  /// the printed digits' rounding.
  double moved_by = 0.0;
  /// Whether that is a tenth or the range below, for want of an uncertainty.
  bool unstated = false;
  /// Of a share of wind or beam that is guessed so: the values it is moved to, the inertia fraction
  /// of its body (of the bull gear: what the modes leave) and as far to the other side, but not
  /// beyond 0 and 1 if it lies between; a tenth where the fraction is nearer than that. moved_by is
  /// then the larger of the two ways.
  std::optional<std::pair<double, double>> range;
};

/// Those that may be off at all, in the case's order. Left out is what was identified from records:
/// what those leave open is not the case's uncertainty.
std::vector<MovableNumber> movable_numbers(const Case& antenna);

/// The case with one of its numbers moved to its lower or upper side. Of shares that sum to 1
/// (wind, beam) the others give way in proportion; what a share loses goes to their inertias. A
/// leakage rate that a flow makes goes with the oil.
/// @throws InvalidInput where that leaves no structure.
Case moved(const Case& antenna, const MovableNumber& number, bool upwards);

}  // namespace boresight::io
