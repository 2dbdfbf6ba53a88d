#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// The antenna in its wind with one number moved to its lower and to its upper value.
struct MovedNumber {
  /// Called from any thread. @throws InvalidInput if the moved number gives no valid antenna.
  std::function<TrackingProblem()> lower, upper;
};

/// The effect of one number on a controller's rms.
struct NumberEffect {
  std::size_t number = 0;  // its index in the input
  /// Boresight rms (rad, per axis at the sky) with the number lower and higher, gains fixed. NaN
  /// where the loop is unstable.
  double low_rms = 0.0, high_rms = 0.0;

  /// The larger change from `rms`, relative to `rms`; infinite where the loop is unstable.
  double change(double rms) const;
};

/// Range of an rms (rad) over several independent numbers.
struct RmsRange {
  double lower = 0.0, upper = 0.0;
};

/// Combines effects to first order: on either side of `rms` the root sum of squares of each
/// number's largest change to that side (GUM 5.1.2, one standard uncertainty if the numbers were
/// moved by theirs). The upper end is infinite where a number makes the loop unstable, the lower at
/// least 0.
RmsRange combined_range(const std::vector<NumberEffect>& effects, double rms);

/// Moves one number at a time with all gains fixed. Returns the `maximum` numbers that change the
/// rms (rad) most, the largest change first. It omits changes below a thousandth, and numbers that
/// give no valid antenna on either side. The result does not depend on the number of threads.
/// @throws what MovedNumber throws except InvalidInput.
std::vector<NumberEffect> number_effects(const std::vector<MovedNumber>& numbers,
                                         const control::Controller& controller,
                                         const Constraints& goals, double rms, std::size_t maximum,
                                         unsigned threads);

}  // namespace boresight::design
