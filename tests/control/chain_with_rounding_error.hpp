#pragma once

#include <cmath>
#include <tuple>

#include <Eigen/Core>

namespace boresight::control {

// A chain of lags into an oscillator with a rounding error back within the chain, which balancing
// takes for a coupling: A and B.
inline std::tuple<Eigen::MatrixXd, Eigen::MatrixXd> chain_with_rounding_error() {
  constexpr Eigen::Index stages = 6, n = stages + 2;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b = Eigen::MatrixXd::Zero(n, 1);
  for (Eigen::Index i = 0; i < stages; ++i) {
    a(i, i) = -0.01 * std::pow(5.0, static_cast<double>(i));
    for (Eigen::Index j = 0; j < i; ++j) {
      a(i, j) = -0.2 * a(i, i) / (1.0 + static_cast<double>(i - j));
    }
  }
  a(0, 1) = 1e-18;
  a(stages, stages - 1) = 70.0;
  a(stages, stages) = a(stages + 1, stages + 1) = -0.5;
  a(stages, stages + 1) = 3.0;
  a(stages + 1, stages) = -3.0;
  b(0, 0) = 1.0;
  return {a, b};
}

}  // namespace boresight::control
