#pragma once

namespace boresight::control {

/// Converts a dead time to the sample time (s) of the controller, and back. The dead time consists
/// of one sample of computation and half a sample of hold.
inline double sample_time_of(double dead_time) {
  return dead_time / 1.5;
}
inline double dead_time_of(double sample_time) {
  return 1.5 * sample_time;
}

}  // namespace boresight::control
