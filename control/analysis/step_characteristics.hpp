#pragma once

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

struct StepOptions {
  /// Half the width of the band around the final value that counts as settled, as a fraction of it.
  double settling_band = 0.02;
  /// The levels between which the rise is timed, as fractions of the final value.
  double rise_from = 0.1;
  double rise_to = 0.9;
  /// Tolerance of plant::minimal_realisation, which is applied first.
  double minimal_tolerance = 1e-12;
};

/// The response of one output to a unit step of one input, from rest, in the units of the output
/// and s. Fractions are relative to the magnitude of the final value. Undefined values are NaN.
struct StepCharacteristics {
  /// False if a pole at the origin (sampled: at 1) prevents a steady state. All values are then NaN
  /// except the peak, which is infinite.
  bool settles = true;
  double final_value = 0.0;
  double rise_time = 0.0;      // from first reaching rise_from to first reaching rise_to
  double settling_time = 0.0;  // after which the response stays within the band
  /// Smallest and largest value after the end of the rise.
  double settling_min = 0.0;
  double settling_max = 0.0;
  double overshoot = 0.0;   // fraction beyond the final value, on its side; 0 if there is none
  double undershoot = 0.0;  // fraction beyond 0, on the other side; 0 if there is none
  double peak = 0.0;        // largest magnitude
  /// Time of the peak: infinity if the magnitude only approaches its final value from below.
  double peak_time = 0.0;
};

/// Step characteristics of the exact response, without a time grid. Every level and extreme is
/// bracketed by bounds that hold between times (DecayingResponse) and located to about 1e-13 of its
/// time. Cancelling poles and zeros are removed first, so a zero that cancels a pole at the origin
/// is permitted. If the final value is 0, rise, settling, overshoot and undershoot are NaN. Values
/// within 1e-12 of the final value's magnitude count as equal to it. A sampled system is evaluated
/// at its samples: times are multiples of the sample time, the first sample at or beyond a level.
/// @throws InvalidInput unless the system has one input and one output, and for options out of
/// range; NumericalFailure naming the pole if the system is unstable or oscillates for ever, or if
/// its time constants are too many decades apart to be simulated.
StepCharacteristics step_characteristics(const plant::StateSpace& system,
                                         const StepOptions& options = {});

}  // namespace boresight::control
