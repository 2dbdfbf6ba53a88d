#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_objective.hpp>

namespace boresight::identification {

/// How a record's prediction errors look.
struct GreyBoxResidual {
  std::string record;
  bool pressures = false;  // of both sides' pressures as torque (N m); else of the rate (rad/s)
  Eigen::Index counted = 0;
  Eigen::Index outliers = 0;  // beyond eight rms, left out
  double rms = 0.0;           // N m or rad/s
  /// Autocorrelation at one sample; of both sides' pressures the larger in size.
  double neighbours = 0.0;
  /// Independent errors that would say as much: counted over the correlation's length.
  double effective = 0.0;
  /// Whether the autocorrelations of the first 20 samples are those of white noise (G. M. Ljung and
  /// G. E. P. Box, Biometrika 65(2), 1978, at 5 %).
  bool white = false;
};

/// Statistics of every channel's prediction errors at a point.
std::vector<GreyBoxResidual> residual_statistics(const GreyBoxObjective& objective,
                                                 const std::vector<GreyBoxRecord>& records,
                                                 const Eigen::VectorXd& point);

/// Autocorrelations at lags 1..lags of a series whose mean is taken as 0; 0 where it is too short.
Eigen::VectorXd autocorrelations(const Eigen::VectorXd& series, Eigen::Index lags);

}  // namespace boresight::identification
