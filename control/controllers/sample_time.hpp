#pragma once

namespace boresight::control {

/// The time between the controller's samples (s) that a dead time speaks of, and back: one sample
/// of computing and half of one of holding.
inline double sample_time_of(double dead_time) {
  return dead_time / 1.5;
}
inline double dead_time_of(double sample_time) {
  return 1.5 * sample_time;
}

}  // namespace boresight::control
