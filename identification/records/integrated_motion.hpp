#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// A stretch of a record, weighted by phi(t): 1 in the middle, and at either end a flank of `taper`
/// samples on which phi rises from 0 to 1 as 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7 (three continuous
/// derivatives). Taper 0: phi = 1, a plain integral from the first to the last sample.
struct MotionWindow {
  Eigen::Index first = 0;
  Eigen::Index last = 0;  // included
  Eigen::Index taper = 0;
};

/// A window's terms of the equation of motion J dw/dt - C d3w/dt3 + F(w) + T_off = T, multiplied by
/// phi and integrated by parts (modulating functions, M. Shinbrot, Trans. ASME 79, 1957), so that
/// no measured rate is differentiated. C is what a structure on springs adds, see
/// `structural_jerk_inertia`.
struct IntegratedMotion {
  MotionWindow window;
  /// Integral of phi times each pressure, Pa s: all inlets, then all outlets.
  Eigen::VectorXd pressure_impulse;
  double duration = 0.0;     // integral of phi, s
  double rate_change = 0.0;  // integral of phi dw/dt, rad/s
  double jerk = 0.0;         // integral of phi d3w/dt3, rad/s3; 0 without taper
  double mean_rate = 0.0;    // rad/s, weighted by phi
  /// Integral of phi F(w) = sum of rate_weight F(rate): means of the rate over groups of samples.
  Eigen::VectorXd rate;
  Eigen::VectorXd rate_weight;  // s
};

/// Integrates a record over a window; the friction's points are means over `group_time` (s).
/// @throws InvalidInput for a window outside the record, shorter than two samples, with flanks that
/// overlap, or a record whose channels have different lengths.
IntegratedMotion integrate_motion(const DriveRecord& record, const MotionWindow& window,
                                  double group_time = 0.05);

/// Samples that a window of integrate_over_speed has at least: twice the smoothing time.
Eigen::Index shortest_speed_window(double sample_time, double smoothing_time);

/// The same with phi = dw/dt of the rate smoothed over `smoothing_time` (s, torque alike), between
/// two rates (rad/s) that the window passes: integrals over speed. Then `duration` is the change of
/// speed (rad/s), `rate_change` the integral of (dw/dt)^2, and friction's integral over speed, F
/// dw, depends on the two rates alone: over a path that returns to its first speed friction and
/// offset cancel, however fast each speed is passed. The window's taper is not used.
/// @throws InvalidInput as integrate_motion, or for a smoothing that is not positive or a window
/// shorter than shortest_speed_window.
IntegratedMotion integrate_over_speed(const DriveRecord& record, const MotionWindow& window,
                                      double from_rate, double to_rate, double smoothing_time);

/// One a sample: rate and every pressure are valid there and within `guard_time` (s) about it, and
/// the rate stays below the recorder's limit.
std::vector<bool> usable_samples(const DriveRecord& record, double guard_time);

/// Longest stretches of true, as windows without taper.
std::vector<MotionWindow> stretches(const std::vector<bool>& usable);

/// Standard deviation of a signal's white noise (its unit), from its second differences' median
/// size: neither slow motion nor a few outliers enter. 0 for fewer than five samples, and where
/// more than half of them repeat a straight line (a coarse resolution).
double noise_level(const Eigen::VectorXd& signal);

/// C = sum of J_i/w_i^2 (kg m2 s2) of a load coupled to the rotor by springs. Below its modes, J
/// s^2 of the whole grows by the factor 1 + C w^2/J. The lowest locked-rotor mode is assumed to
/// carry between 60 % and all of the antenna's inertia; all of it would make C = J_antenna/w1^2.
/// Returns the middle with that uniform distribution's standard deviation. 0 if no frequency is
/// known.
numerics::Uncertain structural_jerk_inertia(const DriveKnowledge& knowledge);

}  // namespace boresight::identification
