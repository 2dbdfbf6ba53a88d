#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/numerics/taylor_model.hpp>

namespace boresight::control {

/// Bounds of the largest gain (singular value) of an enclosed response on an interval.
struct GainBound {
  double at_centre = 0.0;
  double upper = 0.0;
  /// Estimated position of the largest gain in the interval, from the centre.
  double best_offset = 0.0;
};

/// For a single element.
GainBound gain_bound(const numerics::TaylorModel& element, double half_width);

/// For a matrix with rows of equal length, stored row by row. `rows`: number of rows. The largest
/// eigenvalue of H^H H is computed by second-order perturbation, with the other eigenvalues bounded
/// away. The bound is accurate to third order if the largest singular value is isolated, and to
/// first order if several are about equal.
GainBound gain_bound(const std::vector<numerics::TaylorModel>& elements, Eigen::Index rows,
                     double half_width);

}  // namespace boresight::control
