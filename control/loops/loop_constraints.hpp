#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::control {

/// A quantity of a loop at one frequency, with its derivatives with respect to the gains.
struct LoopQuantity {
  double frequency = 0.0;  // rad/s
  double value = 0.0;
  /// d ln(value) / d ln(gain), in the order of the gain vector, including the shift of the
  /// frequency.
  std::array<double, max_gains> log_gradient{};
};

/// The loop gain at a break, as loop_gain(), and d ln L / d ln(gain).
struct LoopGainPoint {
  std::complex<double> value;
  std::array<std::complex<double>, max_gains> by_gain{};
};
LoopGainPoint loop_gain_with_gradient(const plant::ResponsePoint& response, double frequency,
                                      const Controller& controller, double delay,
                                      LoopBreak loop_break);

/// Gain margins at the crossings of L with the negative real axis between the channels' grid
/// points, located on their exact response. `delay` (s) acts on the valve command. The value is the
/// factor, up or down and so at least 1, by which the gain may change until the loop is at -1.
/// Returns the smallest `maximum` of them, smallest first; none if L does not cross. Pairs of
/// crossings between two grid points are not found; margins() finds them.
/// @throws InvalidInput as control::validate.
std::vector<LoopQuantity> smallest_gain_margins(const LoopChannels& channels, double delay,
                                                const Controller& controller, LoopBreak loop_break,
                                                std::size_t maximum = 3);

/// The same for the crossings of L with the unit circle: the angle to -1, lag or lead (rad, 0 to
/// pi).
std::vector<LoopQuantity> smallest_phase_margins(const LoopChannels& channels, double delay,
                                                 const Controller& controller, LoopBreak loop_break,
                                                 std::size_t maximum = 3);

/// The bandwidth: the lowest frequency (value, rad/s) at which the position loop's |S| rises
/// through 1/sqrt(2). Below it disturbances of the command's path are at least halved in power.
/// Nothing if |S| stays on one side over the grid.
/// @throws InvalidInput as control::validate.
std::optional<LoopQuantity> position_bandwidth(const LoopChannels& channels, double delay,
                                               const Controller& controller);

}  // namespace boresight::control
