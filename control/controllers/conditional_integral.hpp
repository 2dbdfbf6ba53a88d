#pragma once

#include <optional>

#include <boresight/control/controllers/controller.hpp>

namespace boresight::control {

/// The integral of a position path with a dead zone or freeze: the path is
/// P(s) (x + corner/s f(x)) of the corrected angle x, with P the path's other blocks and f
/// conditional_input. f lies in the sector 0 to 1: the loop moves between the loop whose integral
/// holds and the linear one.
struct ConditionalIntegral {
  BlockKind condition = BlockKind::dead_zone;  // or freeze
  double width = 0.0;                          // rad of motor: d
  double corner = 0.0;                         // rad/s
};

/// None for a controller without. @throws InvalidInput as control::validate.
std::optional<ConditionalIntegral> conditional_integral(const Controller& controller);

/// f(x): 0 within +-width, beyond it x less the width (dead zone) or x (freeze); odd.
double conditional_input(const ConditionalIntegral& integral, double x);

/// Describing function of f for a sine of this amplitude (rad of motor, 0 or more): with
/// p = asin(width/amplitude), 1 - 2/pi (p + sin p cos p) of a dead zone, 1 - 2/pi (p - sin p cos p)
/// of a freeze; 0 up to the width. Real, as f has no memory.
/// With compliance compensation the corrected angle of a held motor moves by the estimated flexure
/// too, more than the angle alone: a describing function of the angle's amplitude is then too low.
/// Source: A. Gelb, W. E. Vander Velde, Multiple-Input Describing Functions and Nonlinear System
/// Design, 1968, appendix B.
double describing_function(const ConditionalIntegral& integral, double amplitude);

/// Sets `equivalent` to the linear controller that the controller amounts to in a sine of the angle
/// of this amplitude: with the integral's corner times the describing function, at least
/// held_fraction of it. Another controller stays as it is. Does not allocate if `equivalent` is of
/// the same structure.
void set_linear_equivalent(const Controller& controller, double amplitude, Controller& equivalent);
inline constexpr double held_fraction = 1e-6;
/// The same, without the integral where the describing function is 0: it leaves no pole near 0.
Controller linear_equivalent(const Controller& controller, double amplitude);

/// The controller without its conditional integral: the loop while the integral holds.
/// @throws InvalidInput for a controller that has none.
Controller without_conditional_integral(const Controller& controller);

/// The sampled integral by the trapezoidal rule, as sampled_controller has it.
class ConditionalIntegrator {
 public:
  ConditionalIntegrator(const ConditionalIntegral& integral, double sample_time);

  /// x plus the integral at this sample; the state stays.
  double with_integral(double x) const;
  /// To the next sample, from the x of this one.
  void advance(double x);
  void start_from(double state) { state_ = state; }

 private:
  ConditionalIntegral integral_;
  double step_;  // corner times sample time
  double state_ = 0.0;
};

}  // namespace boresight::control
