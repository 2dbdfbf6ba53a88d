#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace boresight::app {

/// A curve of few enough points to be drawn.
struct ThinnedSeries {
  std::vector<double> x, y;
};

/// The least and the largest value of each of at most `maximum`/2 stretches of equally many
/// samples, in the order in which they were recorded: what a plot of that many pixels would show,
/// no peak lost. A stretch without a finite value leaves a gap (NaN). Series of at most `maximum`
/// samples come back as they are.
/// @throws InvalidInput for sizes that differ, or `maximum` below 2.
ThinnedSeries thinned(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                      std::size_t maximum = 600);

/// The values times a factor.
std::vector<double> plotted(const Eigen::VectorXd& values, double factor = 1.0);

}  // namespace boresight::app
