#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace boresight::reference {

/// Numbers for random trials, the same on every standard library.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int integer(int low, int high) {
    return low + static_cast<int>(generator_() % static_cast<std::uint64_t>(high - low + 1));
  }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return uniform(-1.0, 1.0); });
  }

 private:
  std::mt19937_64 generator_;
};

inline double relative_error(double found, double expected) {
  return std::abs(found - expected) / std::abs(expected);
}

inline double relative_error(std::complex<double> found, std::complex<double> expected) {
  return std::abs(found - expected) / std::abs(expected);
}

}  // namespace boresight::reference
