#pragma once

#include <functional>

namespace boresight::numerics {

/// Zero of a continuous function between two places where its values (given) have opposite signs,
/// to some 4e-16 of its place or of 1: inverse quadratic interpolation and secants kept safe by
/// bisection (R. P. Brent, Algorithms for Minimization without Derivatives, 1973, ch. 4). Where the
/// function jumps across zero instead, the place of the jump.
double bracketed_root(const std::function<double(double)>& function, double low, double high,
                      double at_low, double at_high);

/// Place of the maximum of a smooth function with one maximum in [low, high], to some 1e-12 of its
/// width where a golden section alone ends at 1e-8: from there Newton's method on five-point
/// derivatives. The function should be of the order of 1, a logarithm for one. A maximum at an end
/// is that end.
double bracketed_maximum(const std::function<double(double)>& function, double low, double high);

}  // namespace boresight::numerics
