#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/complex_packs.hpp>

namespace boresight::control {

/// Counts the right-half-plane zeros of 1 + L by its phase change along rising frequencies. This is
/// a fast filter on a grid that resolves L; the stability verdict is that of the eigenvalues.
class EncirclementCount {
 public:
  /// L starts as c/s^integrators with c > 0.
  explicit EncirclementCount(int integrators) : start_(-integrators * std::numbers::pi / 2.0) {}
  void add(std::complex<double> value) {
    if (first_) {
      first_value_ = value;
      first_ = false;
    } else if ((last_.imag() < 0.0) != (value.imag() < 0.0)) {
      // The chord meets the real axis here; the phase jumps by a full turn only left of the origin.
      const double real = last_.real() - last_.imag() * (value.real() - last_.real()) /
                                             (value.imag() - last_.imag());
      if (real < 0.0) turns_ += value.imag() < 0.0 ? 1 : -1;
    }
    last_ = value;
  }
  /// Adds the first `count` of eight values.
  void add(const numerics::ComplexPack& values, std::size_t count) {
    // No crossing left of the origin is possible if no value lies left of it.
    bool left = first_ || last_.real() < 0.0;
    for (std::size_t i = 0; i < numerics::pack_size; ++i) left |= values.re[i] < 0.0;
    for (std::size_t i = left ? 0 : count - 1; i < count; ++i) add({values.re[i], values.im[i]});
  }
  int unstable() const {
    const double from_start = std::remainder(std::arg(first_value_) - start_, two_pi);
    const double along = std::arg(last_) - std::arg(first_value_) + two_pi * turns_;
    const double to_end = -std::arg(last_);
    // A stable loop turns by -start from 0 to infinity, where 1 + L is 1. Each zero in the right
    // half plane reduces the turn by pi.
    return static_cast<int>(
        std::lround((-start_ - from_start - along - to_end) / std::numbers::pi));
  }

 private:
  double start_;
  std::complex<double> first_value_, last_;
  int turns_ = 0;
  bool first_ = true;
};

}  // namespace boresight::control
