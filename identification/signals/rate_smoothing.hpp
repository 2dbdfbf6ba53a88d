#pragma once

#include <Eigen/Core>

namespace boresight::identification {

/// Mean of the samples within `half` of each, fewer at the ends. O(n).
Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& series, Eigen::Index half);

}  // namespace boresight::identification
