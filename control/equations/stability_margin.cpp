#include <limits>

#include <fmt/format.h>

#include <boresight/control/equations/stability_margin.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::control {

StabilityMargin stability_margin(const Eigen::MatrixXd& t, double norm, TimeDomain domain) {
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(t.rows());
  if (t.size() == 0) return {std::numeric_limits<double>::infinity(), 0.0};
  const Eigen::VectorXcd values = numerics::schur_eigenvalues(t);
  if (domain == TimeDomain::continuous) return {-values.real().maxCoeff(), rounding * norm};
  return {1.0 - values.cwiseAbs().maxCoeff(), rounding};
}

std::string describe_instability(const StabilityMargin& margin, TimeDomain domain) {
  if (domain == TimeDomain::continuous) {
    return fmt::format(
        "expected the eigenvalues of A left of {:.1g} 1/s (rounding of its norm), found one at "
        "{:.3g}; remove integrators and free angles that nothing uses",
        -margin.rounding, -margin.value);
  }
  return fmt::format(
      "expected the eigenvalues of A within the unit circle, found one of magnitude 1 + {:.3g}; "
      "remove integrators and free angles that nothing uses",
      -margin.value);
}

double require_stable(const char* function, const StabilityMargin& margin, TimeDomain domain) {
  if (!margin.stable()) {
    throw NumericalFailure(fmt::format("{}: {}", function, describe_instability(margin, domain)));
  }
  return margin.value;
}

}  // namespace boresight::control
