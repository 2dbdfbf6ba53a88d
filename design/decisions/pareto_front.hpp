#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::design {

/// Two criteria to be minimised.
struct CostPoint {
  double cost = 0.0, quantity = 0.0;
};

/// Pareto-optimal points, as indices in rising cost (then quantity, then index). A point is on the
/// front if no other is better in one criterion and no worse in the other. Equal points are either
/// all on the front or all off it.
/// @throws InvalidInput for a number that is NaN.
std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points);

/// Fraction of the samples in which each option is on the Pareto front of its cost and that
/// sample's quantity (samples x options). @throws InvalidInput as above, and for sizes that differ
/// or no samples.
std::vector<double> front_fractions(const std::vector<double>& costs,
                                    const Eigen::MatrixXd& quantities);

}  // namespace boresight::design
