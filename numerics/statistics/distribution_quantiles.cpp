#include <algorithm>
#include <cmath>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::numerics {
namespace {

void check(const char* function, double fraction, double first, double second) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  const bool within = fraction > 0.0 && fraction < 1.0;
  if (!within) {
    throw InvalidInput(
        fmt::format("{}: expected a fraction within (0, 1), found {}: a probability is "
                    "meant, not per cent",
                    function, fraction));
  }
  if (!positive(first) || !positive(second)) {
    throw InvalidInput(fmt::format("{}: expected positive, finite parameters, found {} and {}",
                                   function, first, second));
  }
}

}  // namespace

double beta_quantile(double fraction, double a, double b) {
  check("beta_quantile", fraction, a, b);
  return boost::math::ibeta_inv(a, b, fraction);
}

double student_quantile(double fraction, double freedom) {
  check("student_quantile", fraction, freedom, 1.0);
  if (fraction == 0.5) return 0.0;
  // t^2/(freedom + t^2) has distribution beta(1/2, freedom/2); from the tail that is the smaller.
  const double tail = 2.0 * std::min(fraction, 1.0 - fraction);
  double rest = 0.0;  // 1 less the quantile, without cancellation
  const double part = boost::math::ibetac_inv(0.5, 0.5 * freedom, tail, &rest);
  const double t = std::sqrt(freedom * part / rest);
  return fraction < 0.5 ? -t : t;
}

double f_quantile(double fraction, double numerator, double denominator) {
  check("f_quantile", fraction, numerator, denominator);
  double rest = 0.0;
  const double part = boost::math::ibeta_inv(0.5 * numerator, 0.5 * denominator, fraction, &rest);
  return denominator * part / (numerator * rest);
}

double chi_squared_quantile(double fraction, double freedom) {
  check("chi_squared_quantile", fraction, freedom, 1.0);
  return 2.0 * boost::math::gamma_p_inv(0.5 * freedom, fraction);
}

}  // namespace boresight::numerics
