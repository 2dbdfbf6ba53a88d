#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/numerics/taylor_model.hpp>

namespace boresight::control {

/// What an enclosed response says of its largest gain (singular value) on an interval.
struct GainBound {
  double at_centre = 0.0;
  double upper = 0.0;
  /// Where in the interval the gain seems largest, from the centre.
  double best_offset = 0.0;
};

/// Of a single element.
GainBound gain_bound(const numerics::TaylorModel& element, double half_width);

/// Of a matrix of `rows` elements each, row by row. The largest eigenvalue of H^H H is followed by
/// second-order perturbation with the other eigenvalues bounded away, so that the bound is sharp to
/// third order where the largest singular value stands alone and to first order where several are
/// about equal.
GainBound gain_bound(const std::vector<numerics::TaylorModel>& elements, Eigen::Index rows,
                     double half_width);

}  // namespace boresight::control
