#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_objective.hpp>
#include <boresight/numerics/statistics/least_squares.hpp>

namespace boresight::identification {

/// Least squares of an objective's prediction errors and of the priors, from a point, scales as
/// they are. The data's rows are compressed to those with the same products.
numerics::LeastSquaresResult search(const GreyBoxObjective& objective, const Eigen::VectorXd& start,
                                    const numerics::LeastSquaresOptions& options);

/// Alternates the search and the update of the objective's scales until the scales converge.
numerics::LeastSquaresResult search_with_scales(GreyBoxObjective& objective,
                                                const Eigen::VectorXd& start);

/// A start with the guessed parameters sampled from their priors and the others at their priors.
Eigen::VectorXd drawn_start(const GreyBoxParameters& parameters, std::uint64_t seed,
                            std::uint64_t number);

}  // namespace boresight::identification
