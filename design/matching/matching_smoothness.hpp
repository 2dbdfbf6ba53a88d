#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/design/matching/matching_curves.hpp>

namespace boresight::design {

/// A change of the active constraints along a curve from one point to the next: another constraint,
/// plant, bound or solution branch. The least rms has a kink there.
struct CurveKink {
  std::size_t after = 0;  // index, among the points examined, of the one before
  std::string change;     // in words
};

/// Smoothness of ln rms along evenly spaced points.
struct CurveSmoothness {
  /// Third differences; entry i is of points i to i + 3. NaN where one has no feasible controller.
  std::vector<double> third_differences;
  std::vector<CurveKink> kinks;
  /// Number of stretches of four points without a kink, and the largest magnitude over them. 0
  /// without any.
  std::size_t even_stretches = 0;
  double largest_even = 0.0;
  /// Largest magnitude over the stretches that contain a kink.
  double largest_at_kinks = 0.0;
};

/// `points`: indices of the curve's controllers, rising, evenly spaced in inertia. Two neighbours
/// are on one branch if three conditions hold. The same constraints are active on the same plants
/// at frequencies within 15 %. The same gains are at bounds. No gain differs by more than a factor
/// of 1.5.
/// @throws InvalidInput for indices beyond the curve.
CurveSmoothness smoothness(const MatchingCurve& curve, const std::vector<std::size_t>& points);

}  // namespace boresight::design
