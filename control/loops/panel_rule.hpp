#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <boresight/numerics/complex_packs.hpp>

namespace boresight::control {

/// The last four coefficients of a function's Legendre series: of degree 4 to 7.
using TailCoefficients = numerics::RealLanes<4>;

/// Gauss's rule of eight points on [-1, 1], one pack of frequencies per panel, and the estimate of
/// the function between the points.
struct PanelRule {
  std::array<double, numerics::pack_size> node{};
  std::array<double, numerics::pack_size> weight{};
  /// Weights of the barycentric formula for the polynomial through the eight values.
  std::array<double, numerics::pack_size> barycentric{};
  /// By node: Legendre polynomials of degree 4, 5, 6, 7 at the node, times (2 k + 1)/2. They
  /// transform weighted values to the last four coefficients of their Legendre series.
  std::array<TailCoefficients, numerics::pack_size> tail;
};

/// The rule, computed once.
const PanelRule& panel_rule();

/// The sum over the nodes of `value` times the rule's tail or another such array. It gives the last
/// coefficients of the function with these values, in registers of `width` numbers.
template <std::size_t width>
[[gnu::always_inline]] inline void set_tail(
    TailCoefficients& tail, const std::array<TailCoefficients, numerics::pack_size>& by_node,
    const numerics::RealPack& value) {
  constexpr std::size_t size = 4, lanes = width < size ? width : size;
#pragma GCC unroll 2
  for (std::size_t k = 0; k < size / lanes; ++k) {
    numerics::RealLanes<lanes> sum{};
#pragma GCC unroll 8
    for (std::size_t node = 0; node < numerics::pack_size; ++node) {
      sum += numerics::part<lanes>(by_node[node], k) * numerics::RealLanes<lanes>(value[node]);
    }
    numerics::set_part(tail, k, sum);
  }
}

/// For each value of the k-th part, the value that follows it; the last of all eight is followed by
/// itself.
template <std::size_t width, std::size_t... lane>
[[gnu::always_inline]] inline numerics::RealLanes<width> following(const numerics::RealPack& x,
                                                                   std::size_t k,
                                                                   std::index_sequence<lane...>) {
  const auto here = numerics::part<width>(x, k);
  numerics::RealLanes<width> result;
  if (k + 1 < numerics::pack_size / width) {
    const auto after = numerics::part<width>(x, k + 1);
    result.lanes = __builtin_shufflevector(here.lanes, after.lanes, static_cast<int>(lane + 1)...);
  } else {
    result.lanes = __builtin_shufflevector(here.lanes, here.lanes,
                                           static_cast<int>(std::min(lane + 1, width - 1))...);
  }
  return result;
}

/// The cosine, times the magnitudes, of the angle from each value to the next; meaningless for the
/// last.
template <std::size_t width>
[[gnu::always_inline]] inline numerics::RealLanes<width> onward(const numerics::ComplexPack& x,
                                                                std::size_t k) {
  constexpr std::make_index_sequence<width> lanes;
  return numerics::part<width>(x.re, k) * following<width>(x.re, k, lanes) +
         numerics::part<width>(x.im, k) * following<width>(x.im, k, lanes);
}

/// Below 0 where one of two functions turns by more than a right angle to the next point.
template <std::size_t width>
[[gnu::always_inline]] inline void set_turn(numerics::RealPack& turn,
                                            const numerics::ComplexPack& x,
                                            const numerics::ComplexPack& y) {
#pragma GCC unroll 4
  for (std::size_t k = 0; k < numerics::pack_size / width; ++k) {
    const numerics::RealLanes<width> of_x = onward<width>(x, k), of_y = onward<width>(y, k);
    numerics::RealLanes<width> smaller;
    smaller.lanes = of_x.lanes < of_y.lanes ? of_x.lanes : of_y.lanes;
    numerics::set_part(turn, k, smaller);
  }
}

inline bool any_negative(const numerics::RealPack& x) {
  bool any = false;
  for (std::size_t j = 0; j < numerics::pack_size; ++j) any |= x[j] < 0.0;
  return any;
}

/// The squared magnitudes of these coefficients, summed in pairs. Poles of the function make the
/// coefficients fall by rho per degree, with rho the sum of the half axes of the ellipse through
/// the nearest pole. The rule's own error then falls by rho^16.
struct PanelTail {
  double four_five = 0.0;
  double six_seven = 0.0;

  explicit PanelTail(const TailCoefficients& x)
      : four_five(x[0] * x[0] + x[1] * x[1]), six_seven(x[2] * x[2] + x[3] * x[3]) {}

  /// Estimate of the square of the rule's error, from the last coefficients and their rate of
  /// decrease.
  double error_square() const {
    if (!(six_seven > 0.0)) return 0.0;
    if (six_seven >= four_five) return six_seven;
    const double fall = six_seven / four_five;  // rho^-4
    return six_seven * (fall * fall) * (fall * fall);
  }
};

}  // namespace boresight::control
