#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/covariance_propagation.hpp>

namespace boresight::plant {
namespace {

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

PropagatedCovariance propagate_covariance(const Eigen::MatrixXd& a,
                                          const Eigen::MatrixXd& intensity,
                                          const Eigen::MatrixXd& start, double t) {
  const Eigen::Index n = a.rows();
  const auto fits = [n](const Eigen::MatrixXd& matrix) {
    return matrix.rows() == n && matrix.cols() == n && matrix.allFinite();
  };
  if (!fits(a) || !fits(intensity) || !fits(start)) {
    throw InvalidInput(
        fmt::format("propagate_covariance: expected finite square matrices of one size, found "
                    "{} x {}, {} x {} and {} x {}",
                    n, a.cols(), intensity.rows(), intensity.cols(), start.rows(), start.cols()));
  }
  if (!(t > 0.0) || !std::isfinite(t)) {
    throw InvalidInput(fmt::format("propagate_covariance: expected a time above 0, found {} s", t));
  }
  if (n == 0) return {start, start};
  const Eigen::VectorXd scale = numerics::balancing_scale(a);
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const auto even = [&](const Eigen::MatrixXd& matrix) {
    return Eigen::MatrixXd(inverse.asDiagonal() * matrix * inverse.asDiagonal());
  };
  const Eigen::MatrixXd balanced_a = inverse.asDiagonal() * a * scale.asDiagonal();
  const Eigen::MatrixXd w = even(intensity), first = even(start);
  const double size = t * balanced_a.cwiseAbs().colwise().sum().maxCoeff();
  const int doublings = size > 0.5 ? static_cast<int>(std::ceil(std::log2(2.0 * size))) : 0;
  double time = std::ldexp(t, -doublings);

  // exp of [-A I 0; 0 -A Q; 0 0 A'] h has G = exp(-A h) integral(exp(A s) Q exp(A' s)) in the
  // middle of its last column and the integral of that over h at the top.
  const auto blocks = [&](const Eigen::MatrixXd& q) {
    Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    joint.topLeftCorner(n, n) = -time * balanced_a;
    joint.block(0, n, n, n) = time * Eigen::MatrixXd::Identity(n, n);
    joint.block(n, n, n, n) = -time * balanced_a;
    joint.block(n, 2 * n, n, n) = time * q;
    joint.bottomRightCorner(n, n) = time * balanced_a.transpose();
    return numerics::matrix_exponential(joint);
  };
  const Eigen::MatrixXd of_noise = blocks(w), of_start = blocks(first);
  Eigen::MatrixXd transition = of_noise.bottomRightCorner(n, n).transpose();
  Eigen::MatrixXd noise = symmetric(transition * of_noise.block(n, 2 * n, n, n));
  Eigen::MatrixXd noise_integral = symmetric(transition * of_noise.topRightCorner(n, n));
  Eigen::MatrixXd start_integral = symmetric(transition * of_start.block(n, 2 * n, n, n));
  for (int i = 0; i < doublings; ++i) {
    const auto later = [&](const Eigen::MatrixXd& matrix) {
      return symmetric(transition * matrix * transition.transpose());
    };
    noise_integral += time * noise + later(noise_integral);
    start_integral += later(start_integral);
    noise += later(noise);
    transition = (transition * transition).eval();
    time *= 2.0;
  }
  const auto given = [&](const Eigen::MatrixXd& matrix) {
    return Eigen::MatrixXd(scale.asDiagonal() * matrix * scale.asDiagonal());
  };
  PropagatedCovariance result{given(symmetric(transition * first * transition.transpose()) + noise),
                              given((start_integral + noise_integral) / t)};
  if (!result.end.allFinite() || !result.mean.allFinite()) {
    throw NumericalFailure(fmt::format(
        "propagate_covariance: the covariance of an unstable system overflows within {} s", t));
  }
  return result;
}

}  // namespace boresight::plant
