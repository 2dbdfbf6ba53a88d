#pragma once

#include <cstddef>
#include <string_view>

#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::control {

/// Bounds of the largest gain over all frequencies from 0 to infinity.
struct PeakGain {
  /// rad/s, where `lower` is reached; infinite where the gain rises towards infinite frequency.
  double frequency = 0.0;
  double lower = 0.0;  // the gain at `frequency`, less possible rounding errors
  double upper = 0.0;  // not exceeded at any frequency
  /// True if the bounds are within the requested tolerance. False if rounding errors of poles next
  /// to the axis leave a wider interval, or if the intervals are used up.
  bool closed = false;
  std::size_t intervals = 0;
};

struct PeakGainOptions {
  double relative_tolerance = 1e-9;  // of upper - lower
  std::size_t max_intervals = 200000;
};

/// sup |H(j w)| from one input to one output of a modal system with exact dead times. The response
/// is enclosed over intervals of frequency from its modes (plant::ModalEnclosure). The interval
/// with the largest bound is halved until no bound exceeds the best gain found. This takes O(modes)
/// per interval and no grid, and misses no peak between points. Rounding errors of sums and poles
/// are estimated to first order and widen the bounds. The result is the H-infinity norm if the
/// system is stable, which is not tested here.
/// @throws InvalidInput as plant::reduce(), or for a tolerance below 1e-14 or no intervals.
PeakGain peak_gain(const plant::ModalSystem& system, std::string_view input,
                   std::string_view output, const PeakGainOptions& options = {});

/// sup of the largest singular value of the response, all inputs to all outputs, continuous or
/// sampled. A sampled system is evaluated through the bilinear map z = (1 + s)/(1 - s), which
/// preserves the values; the frequency is that of the sampled system. The result is the H-infinity
/// norm of a stable system and the L-infinity norm of any other. It is infinite (lower and upper)
/// if a relevant pole lies on the stability boundary to working precision.
/// @throws InvalidInput as validate(system); NumericalFailure if a sampled system has a pole at -1.
PeakGain peak_gain(const plant::StateSpace& system, const PeakGainOptions& options = {});

}  // namespace boresight::control
