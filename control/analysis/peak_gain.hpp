#pragma once

#include <cstddef>
#include <string_view>

#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::control {

/// The largest gain over all frequencies from 0 to infinity, between two bounds.
struct PeakGain {
  /// rad/s, where `lower` is reached; infinite where the gain rises towards infinite frequency.
  double frequency = 0.0;
  double lower = 0.0;  // the gain at `frequency`, less what rounding may have added
  double upper = 0.0;  // no frequency has more
  /// Whether the bounds are within the tolerance asked for. They are not where rounding errors of
  /// poles next to the axis leave more open, or the intervals were used up.
  bool closed = false;
  std::size_t intervals = 0;
};

struct PeakGainOptions {
  double relative_tolerance = 1e-9;  // of upper - lower
  std::size_t most_intervals = 200000;
};

/// sup |H(j w)| from one input to one output of a modal system with exact dead times. The response
/// is enclosed over intervals of frequency from its modes (plant::ModalEnclosure), the interval
/// that may hold the most is halved until nothing exceeds the best gain found: O(modes) an
/// interval, no grid, and no peak between two points is missed. Rounding errors of sums and poles
/// are estimated to first order and widen the bounds. The H-infinity norm if the system is stable,
/// which is not tested here.
/// @throws InvalidInput as plant::reduce(), or for a tolerance below 1e-14 or no intervals.
PeakGain peak_gain(const plant::ModalSystem& system, std::string_view input,
                   std::string_view output, const PeakGainOptions& options = {});

/// sup of the largest singular value of the response, all inputs to all outputs, continuous or
/// sampled (through the bilinear map z = (1 + s)/(1 - s), which keeps the values; the frequency is
/// that of the sampled system): the H-infinity norm of a stable system, the L-infinity norm of any
/// other. Infinite (lower and upper) if a pole that matters lies on the stability boundary to
/// working precision.
/// @throws InvalidInput as validate(system); NumericalFailure if a sampled system has a pole at -1.
PeakGain peak_gain(const plant::StateSpace& system, const PeakGainOptions& options = {});

}  // namespace boresight::control
