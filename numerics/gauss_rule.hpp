#pragma once

#include <vector>

namespace boresight::numerics {

/// Gauss-Legendre rule on [-1, 1]: the sum of weight[i] f(node[i]) is the exact integral of every
/// polynomial of degree up to 2 n - 1.
struct GaussRule {
  std::vector<double> node;  // ascending, symmetric about 0
  std::vector<double> weight;
  /// (-1)^i sqrt((1 - node^2) weight): weights of the barycentric formula for the polynomial
  /// through values at the nodes (H. Wang, S. Xiang, Math. Comp. 81, 2012).
  std::vector<double> barycentric;
};

/// The rule of `count` points; the nodes are zeros of Legendre's polynomial to rounding. Weights to
/// 1e-13 up to 64 points, 1e-12 up to 500.
/// @throws InvalidInput unless count is 1 to 500.
GaussRule gauss_rule(int count);

}  // namespace boresight::numerics
