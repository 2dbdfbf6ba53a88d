#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::control {

/// A quantity of a loop that sits at one frequency, and how it changes with the gains.
struct LoopQuantity {
  double frequency = 0.0;  // rad/s
  double value = 0.0;
  /// d ln(value) / d ln(gain), in the order of the gain vector, the frequency moving along.
  std::array<double, most_gains> log_gradient{};
};

/// The loop gain at a break as loop_gain() has it, and d ln L / d ln(gain).
struct LoopGainPoint {
  std::complex<double> value;
  std::array<std::complex<double>, most_gains> by_gain{};
};
LoopGainPoint loop_gain_with_gradient(const plant::ResponsePoint& response, double frequency,
                                      const ControlLaw& law, double delay, LoopBreak loop_break);

/// Where L crosses the negative real axis between the channels' grid points, located on their exact
/// response; `delay` (s) on the valve command: the factor, up or down and so at least 1, by which
/// the gain may change there before the loop is at -1. The smallest `most` of them, smallest first;
/// none where L does not cross. Crossings that come and go between two grid points are not seen:
/// margins() is the final word.
/// @throws InvalidInput as validate(law).
std::vector<LoopQuantity> smallest_gain_margins(const LoopChannels& channels, double delay,
                                                const ControlLaw& law, LoopBreak loop_break,
                                                std::size_t most = 3);

/// The same where L crosses the unit circle: the angle to -1, lag or lead (rad, 0 to pi).
std::vector<LoopQuantity> smallest_phase_margins(const LoopChannels& channels, double delay,
                                                 const ControlLaw& law, LoopBreak loop_break,
                                                 std::size_t most = 3);

/// The lowest frequency (value, rad/s) at which the position loop's |S| rises through 1/sqrt(2):
/// below it disturbances of the command's path are halved in power. Nothing where |S| stays on one
/// side over the grid.
/// @throws InvalidInput as validate(law).
std::optional<LoopQuantity> position_bandwidth(const LoopChannels& channels, double delay,
                                               const ControlLaw& law);

}  // namespace boresight::control
