#pragma once

namespace boresight::design {

/// A relative change of the rms below this is negligible: assumed inputs, the wind model and
/// effects that the linear plant neglects change it by more.
inline constexpr double negligible_change = 0.02;

}  // namespace boresight::design
