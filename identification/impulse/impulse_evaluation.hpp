#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/identification/friction/friction_curve_fit.hpp>
#include <boresight/identification/impulse/impulse_windows.hpp>
#include <boresight/identification/records/instrument_errors.hpp>

namespace boresight::identification {

/// Friction and offset to subtract from a window's impulse: a straight line, sign(w) (intercept +
/// slope |w|), or the fitted curve with a change of its parameters.
struct ImpulseFriction {
  double intercept = 0.0;  // N m
  double slope = 0.0;      // N m s/rad
  double offset = 0.0;     // N m
  bool curve = false;
  /// With the curve, in the order of FrictionCurveFit::estimate; empty: none.
  Eigen::VectorXd curve_change;
};

/// A window's terms and its weight in a pooled estimate.
struct WindowImpulse {
  ImpulseWindow source;
  IntegratedMotion motion;
  Eigen::Index inlets = 0;
  double weight = 1.0;
  /// Impulse of the fitted curve, offset and common pressure (N m s), and its derivatives by the
  /// fit's estimate.
  double curve_impulse = 0.0;
  Eigen::VectorXd by_curve;
};

/// Sets curve_impulse and by_curve.
void add_curve(const FrictionCurveFit& fit, WindowImpulse& window);

/// How windows are combined.
enum class ImpulsePooling {
  mean_of_quotients,  // each window's impulse over its change of speed, averaged (Sommerville)
  least_squares,      // sum of weight M N over sum of weight M^2, N impulse, M change of speed
  /// For windows integrated over speed. Per direction, the mean of the accelerating ones plus the
  /// mean of the decelerating ones: a closed path of speeds, over which friction and offset cancel.
  closed_path
};

/// Integral of torque less friction, offset and the structure's part (N m s) over a window.
double net_impulse(const WindowImpulse& window, const ImpulseFriction& friction,
                   double torque_per_pressure, double jerk_inertia, const InstrumentErrors& errors);

/// Reflected inertia (kg m2) from windows by a friction and a pooling; NaN where the pooled change
/// of speed is 0.
double pooled_inertia(const std::vector<WindowImpulse>& windows, const ImpulseFriction& friction,
                      ImpulsePooling pooling, double torque_per_pressure, double jerk_inertia,
                      const InstrumentErrors& errors);

}  // namespace boresight::identification
