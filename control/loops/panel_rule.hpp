#pragma once

#include <array>
#include <cstddef>

#include <boresight/numerics/complex_packs.hpp>

namespace boresight::control {

/// Gauss's rule of eight points on [-1, 1], one pack of frequencies a panel, and what the values at
/// its points say of the function between them.
struct PanelRule {
  std::array<double, numerics::pack_size> node{};
  std::array<double, numerics::pack_size> weight{};
  /// Weights of the barycentric formula for the polynomial through the eight values.
  std::array<double, numerics::pack_size> barycentric{};
  /// By node: Legendre polynomials of degree 4, 5, 6, 7 there, times (2 k + 1)/2, in the first four
  /// lanes or in the last four: they take weighted values to the last four coefficients of their
  /// Legendre series, those of two functions side by side.
  std::array<numerics::RealPack, numerics::pack_size> first_tail, second_tail;
};

/// The rule; made once.
const PanelRule& panel_rule();

/// The Legendre coefficients of degree 4 to 7 of a function, as squares of their magnitudes in
/// pairs. Poles of the function make them fall by rho a degree, rho the sum of the half axes of the
/// ellipse through the nearest pole, and then the rule's own error falls by rho^16.
struct PanelTail {
  double four_five = 0.0;
  double six_seven = 0.0;

  /// Estimate of the square of the rule's error, from the last coefficients and how fast they fall.
  double error_square() const {
    if (!(six_seven > 0.0)) return 0.0;
    if (six_seven >= four_five) return six_seven;
    const double fall = six_seven / four_five;  // rho^-4
    return six_seven * (fall * fall) * (fall * fall);
  }
};

}  // namespace boresight::control
