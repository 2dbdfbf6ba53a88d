#include <cmath>

#include <boost/math/special_functions/legendre.hpp>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/gauss_rule.hpp>

namespace boresight::numerics {

GaussRule gauss_rule(int count) {
  if (count < 1 || count > 500) {
    throw InvalidInput(fmt::format("gauss_rule: expected 1 to 500 points, found {}", count));
  }
  // From 0 upwards, the middle one of an odd count first.
  const auto zeros = boost::math::legendre_p_zeros<double>(count);
  const auto n = static_cast<std::size_t>(count);
  GaussRule rule{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const double x = zeros[i];
    const double slope = boost::math::legendre_p_prime(count, x);
    const double weight = 2.0 / ((1.0 - x * x) * slope * slope);
    const std::size_t above = n / 2 + i, below = n - 1 - above;
    rule.node[below] = x == 0.0 ? 0.0 : -x;
    rule.node[above] = x;
    rule.weight[below] = rule.weight[above] = weight;
    const double magnitude = std::sqrt((1.0 - x * x) * weight);
    rule.barycentric[below] = below % 2 == 0 ? magnitude : -magnitude;
    rule.barycentric[above] = above % 2 == 0 ? magnitude : -magnitude;
  }
  return rule;
}

}  // namespace boresight::numerics
