#pragma once

#include <cmath>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::reference {

/// The system behind a zero-order hold, by the power series of exp([A B; 0 0] T/2^k) in long
/// double, squared k times: slow, simple, and another route than the library's.
inline plant::StateSpace zero_order_hold(const plant::StateSpace& system, double sample_time) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index n = system.a.rows(), m = system.b.cols();
  Matrix generator = Matrix::Zero(n + m, n + m);
  generator.topLeftCorner(n, n) = system.a.cast<long double>();
  generator.topRightCorner(n, m) = system.b.cast<long double>();
  generator *= static_cast<long double>(sample_time);
  const int squarings =
      std::max(0, static_cast<int>(std::ceil(std::log2(static_cast<double>(generator.norm())))));
  generator *= std::ldexp(1.0L, -squarings);
  Matrix power = Matrix::Identity(n + m, n + m), sum = power;
  for (int k = 1; k <= 40; ++k) {
    power = power * generator / static_cast<long double>(k);
    sum += power;
  }
  for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
  plant::StateSpace sampled = system;
  sampled.a = sum.topLeftCorner(n, n).cast<double>();
  sampled.b = sum.topRightCorner(n, m).cast<double>();
  sampled.sample_time = sample_time;
  return sampled;
}

}  // namespace boresight::reference
