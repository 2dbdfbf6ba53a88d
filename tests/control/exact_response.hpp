#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <boresight/plant/linear/state_space.hpp>

/// Loop gains in extended precision by elimination, and zeros and extrema by bisection: an
/// independent way to crossovers and margins.
namespace boresight::reference {

using Long = long double;
using LongComplex = std::complex<long double>;
using LongLoop = std::function<LongComplex(Long)>;

inline constexpr Long long_pi = std::numbers::pi_v<Long>;

/// C (s I - A)^-1 B + D of a single-input, single-output system at s = j w or z = e^(j w T).
inline LongLoop long_loop(const plant::StateSpace& system) {
  return [system](Long w) {
    const Long time = system.sample_time;
    const LongComplex s = time > 0.0L ? std::polar(1.0L, w * time) : LongComplex{0.0L, w};
    const auto n = static_cast<std::size_t>(system.a.rows());
    std::vector<std::vector<LongComplex>> rows(n, std::vector<LongComplex>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      for (std::size_t j = 0; j < n; ++j) rows[i][j] = -system.a(row, static_cast<Eigen::Index>(j));
      rows[i][i] += s;
      rows[i][n] = system.b(row, 0);
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n; ++i) {
        if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
      }
      std::swap(rows[k], rows[pivot]);
      for (std::size_t i = k + 1; i < n; ++i) {
        const LongComplex factor = rows[i][k] / rows[k][k];
        for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
      }
    }
    LongComplex result = system.d(0, 0);
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t j = k + 1; j < n; ++j) rows[k][n] -= rows[k][j] * rows[j][n];
      rows[k][n] /= rows[k][k];
      result += static_cast<Long>(system.c(0, static_cast<Eigen::Index>(k))) * rows[k][n];
    }
    return result;
  };
}

/// gain (s - z1).../((s - p1)...), exact but for rounding of the products.
inline LongLoop long_loop(std::vector<std::complex<double>> zeros,
                          std::vector<std::complex<double>> poles, double gain) {
  return [=](Long w) {
    LongComplex value = gain;
    for (const auto pole : poles) value /= LongComplex{0.0L, w} - LongComplex(pole);
    for (const auto zero : zeros) value *= LongComplex{0.0L, w} - LongComplex(zero);
    return value;
  };
}

/// Zero of a function between two places of different sign.
inline Long bisected(const std::function<Long(Long)>& function, Long low, Long high) {
  const bool rises = function(low) < 0.0L;
  for (int i = 0; i < 90; ++i) {
    const Long middle = 0.5L * (low + high);
    ((function(middle) < 0.0L) == rises ? low : high) = middle;
  }
  return 0.5L * (low + high);
}

/// Crossovers next to the frequency given, which must be nearer to them than 1e-4.
inline Long gain_crossover_near(const LongLoop& loop, double w) {
  return bisected([&](Long x) { return std::log(std::abs(loop(x))); }, w * (1.0L - 1e-4L),
                  w * (1.0L + 1e-4L));
}
inline Long phase_crossover_near(const LongLoop& loop, double w) {
  return bisected([&](Long x) { return loop(x).imag() / std::abs(loop(x)); }, w * (1.0L - 1e-4L),
                  w * (1.0L + 1e-4L));
}

/// Extremum next to the frequency given: where the derivative (four-point, in ln w) is zero.
inline Long extremum_near(const std::function<Long(Long)>& function, double w) {
  const auto slope = [&](Long x) {
    constexpr Long h = 1e-4L;
    const auto at = [&](Long part) { return function(x * std::exp(part * h)); };
    return 8.0L * (at(1.0L) - at(-1.0L)) - (at(2.0L) - at(-2.0L));
  };
  return bisected(slope, w * (1.0L - 1e-3L), w * (1.0L + 1e-3L));
}

}  // namespace boresight::reference
