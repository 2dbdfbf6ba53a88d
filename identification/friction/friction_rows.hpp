#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/identification/friction/friction_curve_fit.hpp>

namespace boresight::identification {

/// One equation a window: mean torque = J rate change/duration - structure + mean friction +
/// offset.
struct FrictionRows {
  std::vector<IntegratedMotion> motion;
  std::vector<std::size_t> record;  // of the campaign
  std::vector<double> time;         // s, the window's middle
  Eigen::VectorXd torque;           // N m, means over the windows, as recorded
  Eigen::VectorXd structure;        // N m, C jerk/duration
  /// Standard uncertainty of C relative to C.
  double structure_uncertainty = 0.0;
  Eigen::VectorXd common_pressure;    // Pa, mean of all channels less its mean over the rows
  double mean_common_pressure = 0.0;  // Pa
  double tachometer_zero = 0.0;       // rad/s, standard deviation expected
  double slowest = 0.0;               // rad/s: five of noise and two of zero
  double highest_rate = 0.0;          // rad/s, largest size over the rows
  Eigen::Index size() const { return static_cast<Eigen::Index>(motion.size()); }
};

/// Windows of the tests that the options choose, in the order of the records.
/// @throws InvalidInput for options out of their range; NumericalFailure where fewer than 20
/// windows move or all move one way.
FrictionRows friction_rows(const Campaign& campaign, const FrictionCurveOptions& options);

/// Start of the curve's fit in the order of FrictionCurveFit::estimate: each pair of the rates ws
/// and wh on a logarithmic grid, with linear least squares in the other parameters, those of
/// friction not negative. `deviation`: N m, one a row.
Eigen::VectorXd friction_start(const FrictionRows& rows, const numerics::Uncertain& inertia,
                               const Eigen::VectorXd& deviation);

/// Length of a window (s) by the options.
double window_time(const DriveKnowledge& knowledge, const FrictionCurveOptions& options);

}  // namespace boresight::identification
