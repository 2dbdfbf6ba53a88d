#pragma once

#include <complex>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::control {

/// Loop gain at the input of a controller's conditional integral at one frequency (rad/s), all
/// other loops closed: L of absolute_stability, with exact dead time. With the integral off and its
/// return D, L = corner/s times the position loop's gain over D.
/// @throws InvalidInput for a controller without a conditional integral.
std::complex<double> conditional_loop_gain(const plant::ResponsePoint& response, double frequency,
                                           const Controller& controller, double delay);

}  // namespace boresight::control
