#pragma once

namespace boresight::design {

/// A change of the rms below this share decides nothing: assumed inputs, the wind model and what
/// the linear plant leaves out move it by more.
inline constexpr double negligible_change = 0.02;

}  // namespace boresight::design
