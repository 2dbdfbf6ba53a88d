#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::design {

/// Two things of which less is better.
struct CostPoint {
  double cost = 0.0, quantity = 0.0;
};

/// Points that no other is better than in one and no worse than in the other, as indices in rising
/// cost (then quantity, then index). Equal points stand or fall together.
/// @throws InvalidInput for a number that is NaN.
std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points);

/// Share of the draws in which each option is on the front of its cost and that draw's quantity
/// (draws x options). @throws InvalidInput as above, and for sizes that differ or no draws.
std::vector<double> front_shares(const std::vector<double>& costs,
                                 const Eigen::MatrixXd& quantities);

}  // namespace boresight::design
