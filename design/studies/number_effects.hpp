#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// The antenna in its wind with a number moved to its lower and upper side.
struct MovedNumber {
  /// Called from any thread. @throws InvalidInput where that leaves no antenna.
  std::function<TrackingProblem()> lower, upper;
};

/// What a controller's rms owes to one number.
struct NumberEffect {
  std::size_t number = 0;  // its place among those asked about
  /// Beam rms (rad, one axis at the sky) with the number lower and higher, gains held. NaN where
  /// the loop is unstable there.
  double low_rms = 0.0, high_rms = 0.0;

  /// The larger change from `rms` as a share of it; infinite where the loop is unstable.
  double change(double rms) const;
};

/// Numbers moved one at a time with all gains held: the `most` that change the rms (rad) most, the
/// largest first. Left out is what changes it by less than a thousandth, and what leaves no antenna
/// on either side. The same for any number of threads.
/// @throws what MovedNumber throws but for InvalidInput.
std::vector<NumberEffect> number_effects(const std::vector<MovedNumber>& numbers,
                                         const control::ControlLaw& law, const HardGoals& goals,
                                         double rms, std::size_t most, unsigned threads);

}  // namespace boresight::design
