#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/design/matching/matching_curves.hpp>

namespace boresight::design {

/// Where what holds the laws of a curve changes from one point to the next: another goal, another
/// plant, a bound, or another family of laws. The least rms has a kink there, or bends.
struct CurveKink {
  std::size_t after = 0;  // number, among the points looked at, of the one before
  std::string change;     // in words
};

/// How smooth ln rms runs along evenly spaced points.
struct CurveSmoothness {
  /// Third differences; entry i is of points i to i + 3. NaN where one has no feasible law.
  std::vector<double> third_differences;
  std::vector<CurveKink> kinks;
  /// Over the stretches of four points without a kink: how many there are, and the largest
  /// magnitude. 0 without any.
  std::size_t even_stretches = 0;
  double largest_even = 0.0;
  /// Over the stretches that hold a kink.
  double largest_at_kinks = 0.0;
};

/// `points`: numbers of the curve's laws, rising, to be evenly spaced in inertia. Two neighbours
/// are of one family if the same goals are active on the same plants at frequencies within 15 %,
/// the same gains rest on bounds and no gain differs by more than a factor of 1.5.
/// @throws InvalidInput for numbers beyond the curve.
CurveSmoothness smoothness(const MatchingCurve& curve, const std::vector<std::size_t>& points);

}  // namespace boresight::design
