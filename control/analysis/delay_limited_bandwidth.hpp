#pragma once

namespace boresight::control {

/// Bandwidth (rad/s, lowest frequency at which |S| = 1/sqrt(2)) of the loop gain k exp(-s delay)/s
/// with the k at which the largest |S| is `sensitivity_peak`: what a delay leaves to a loop of one
/// integrator around a plant without dynamics. Not a bound: a loop with more gain at low
/// frequencies can have a little more. Exact, by the conditions for the peak of |S|:
///   cos(y) sqrt(1 + y^2) = 1/Ms at the peak's y = frequency x delay,  k delay = y (sin y - y cos
///   y), k delay = y (sin y + sqrt(1 + sin^2 y)) at the bandwidth's y.
/// Ms = 1.59 is at k delay = 0.5, the usual choice (S. Skogestad, Simple analytic rules for model
/// reduction and PID controller tuning, J. Process Control 13, 2003).
/// @throws InvalidInput for a delay or a peak - 1 that is not positive and finite.
double delay_limited_bandwidth(double delay, double sensitivity_peak);

}  // namespace boresight::control
