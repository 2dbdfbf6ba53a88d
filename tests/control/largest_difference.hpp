#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include <boresight/numerics/hermitian_eigen.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::reference {

/// The largest singular value of the difference of two responses over a fine scan of the axis (the
/// unit circle), refined about the highest point: a lower bound of the norm, exact to rounding
/// where the scan resolves every peak.
inline double largest_difference(const plant::StateSpace& first, const plant::StateSpace& second) {
  const bool sampled = first.sample_time > 0.0;
  // x from 0 to pi: w = tan(x/2), or the angle on the circle.
  const auto gain = [&](double x) {
    const double w = sampled ? x / first.sample_time : std::tan(0.5 * x);
    const Eigen::MatrixXcd error =
        plant::frequency_response(first, w) - plant::frequency_response(second, w);
    return std::sqrt(
        std::max(0.0, numerics::hermitian_eigen(error.adjoint() * error).values.tail<1>()[0]));
  };
  constexpr int points = 1500;
  const double end = sampled ? std::numbers::pi : std::numbers::pi - 1e-6;
  const double step = end / points;
  double best = 0.0, at = 0.0;
  for (int i = 0; i <= points; ++i) {
    const double here = gain(step * i);
    if (here > best) {
      best = here;
      at = step * i;
    }
  }
  double low = std::max(0.0, at - step), high = std::min(end, at + step);
  for (int i = 0; i < 60; ++i) {
    const double left = low + 0.382 * (high - low), right = high - 0.382 * (high - low);
    (gain(left) > gain(right) ? high : low) = gain(left) > gain(right) ? right : left;
  }
  return std::max(best, gain(0.5 * (low + high)));
}

}  // namespace boresight::reference
