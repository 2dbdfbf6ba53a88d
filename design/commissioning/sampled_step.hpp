#pragma once

#include <Eigen/Core>

namespace boresight::design {

/// Time (s) from 10 % to 90 % of a response over a unit step, straight between its samples;
/// infinite if it does not reach 90 %. `response`: from the step on, every `sample_time` (s).
double rise_time(const Eigen::VectorXd& response, double sample_time);

/// The first sample from which the response stays within 5 % of the step; their number if the last
/// one is not within.
Eigen::Index settled_from(const Eigen::VectorXd& response);

}  // namespace boresight::design
