#pragma once

#include <cstddef>

namespace boresight::numerics {

/// Numbers that are kept side by side: eight, whatever the width of the processor's registers.
inline constexpr std::size_t pack_size = 8;

// A function of its own would be compiled for the narrowest registers.
#define BORESIGHT_INLINE [[gnu::always_inline]] inline

template <std::size_t width>
struct Vector;
template <>
struct Vector<2> {
  using Lanes = double __attribute__((vector_size(2 * sizeof(double))));
};
template <>
struct Vector<4> {
  using Lanes = double __attribute__((vector_size(4 * sizeof(double))));
};
template <>
struct Vector<8> {
  using Lanes = double __attribute__((vector_size(8 * sizeof(double))));
};

/// As many numbers as a processor works on at once, with the same operations in the same order as
/// one by one. Everything here is inlined into functions that are compiled for wider registers
/// (vector_clones.hpp).
// The alignment is stated: left to the compiler it would differ between the clones.
template <std::size_t width>
struct alignas(width * sizeof(double)) RealLanes {
  using Lanes = typename Vector<width>::Lanes;
  Lanes lanes{};

  RealLanes() = default;
  BORESIGHT_INLINE RealLanes(double all) : lanes(Lanes{} + all) {}
  BORESIGHT_INLINE double operator[](std::size_t i) const { return lanes[i]; }
  BORESIGHT_INLINE void set(std::size_t i, double value) { lanes[i] = value; }
  BORESIGHT_INLINE RealLanes& operator+=(const RealLanes& x) {
    lanes += x.lanes;
    return *this;
  }
  BORESIGHT_INLINE RealLanes& operator*=(const RealLanes& x) {
    lanes *= x.lanes;
    return *this;
  }
  BORESIGHT_INLINE friend RealLanes operator+(const RealLanes& x, const RealLanes& y) {
    RealLanes result;
    result.lanes = x.lanes + y.lanes;
    return result;
  }
  BORESIGHT_INLINE friend RealLanes operator-(const RealLanes& x, const RealLanes& y) {
    RealLanes result;
    result.lanes = x.lanes - y.lanes;
    return result;
  }
  BORESIGHT_INLINE friend RealLanes operator-(const RealLanes& x) {
    RealLanes result;
    result.lanes = -x.lanes;
    return result;
  }
  BORESIGHT_INLINE friend RealLanes operator*(const RealLanes& x, const RealLanes& y) {
    RealLanes result;
    result.lanes = x.lanes * y.lanes;
    return result;
  }
  BORESIGHT_INLINE friend RealLanes operator/(const RealLanes& x, const RealLanes& y) {
    RealLanes result;
    result.lanes = x.lanes / y.lanes;
    return result;
  }
};

/// As many complex numbers.
template <std::size_t width>
struct ComplexLanes {
  using Real = RealLanes<width>;
  Real re, im;

  BORESIGHT_INLINE friend ComplexLanes operator+(const ComplexLanes& x, const ComplexLanes& y) {
    return {x.re + y.re, x.im + y.im};
  }
  BORESIGHT_INLINE friend ComplexLanes operator-(const ComplexLanes& x, const ComplexLanes& y) {
    return {x.re - y.re, x.im - y.im};
  }
  BORESIGHT_INLINE friend ComplexLanes operator-(const ComplexLanes& x) { return {-x.re, -x.im}; }
  BORESIGHT_INLINE friend ComplexLanes operator*(const ComplexLanes& x, const ComplexLanes& y) {
    return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
  }
  BORESIGHT_INLINE friend ComplexLanes operator*(const ComplexLanes& x, const Real& y) {
    return {x.re * y, x.im * y};
  }
};

template <std::size_t width>
BORESIGHT_INLINE ComplexLanes<width> conjugate(const ComplexLanes<width>& x) {
  return {x.re, -x.im};
}
template <std::size_t width>
BORESIGHT_INLINE RealLanes<width> square(const ComplexLanes<width>& x) {
  return x.re * x.re + x.im * x.im;
}
/// Re(x y)
template <std::size_t width>
BORESIGHT_INLINE RealLanes<width> real_product(const ComplexLanes<width>& x,
                                               const ComplexLanes<width>& y) {
  return x.re * y.re - x.im * y.im;
}

using RealPack = RealLanes<pack_size>;
using ComplexPack = ComplexLanes<pack_size>;

/// The k-th part, as wide as the registers, of numbers that are kept side by side.
template <std::size_t width, std::size_t size>
BORESIGHT_INLINE RealLanes<width> part(const RealLanes<size>& x, std::size_t k) {
  RealLanes<width> result;
  result.lanes = reinterpret_cast<const typename RealLanes<width>::Lanes*>(&x.lanes)[k];
  return result;
}
template <std::size_t width, std::size_t size>
BORESIGHT_INLINE ComplexLanes<width> part(const ComplexLanes<size>& x, std::size_t k) {
  return {part<width>(x.re, k), part<width>(x.im, k)};
}
template <std::size_t width, std::size_t size>
BORESIGHT_INLINE void set_part(RealLanes<size>& x, std::size_t k, const RealLanes<width>& value) {
  reinterpret_cast<typename RealLanes<width>::Lanes*>(&x.lanes)[k] = value.lanes;
}
template <std::size_t width, std::size_t size>
BORESIGHT_INLINE void set_part(ComplexLanes<size>& x, std::size_t k,
                               const ComplexLanes<width>& value) {
  set_part(x.re, k, value.re);
  set_part(x.im, k, value.im);
}

#undef BORESIGHT_INLINE

/// Sum of the eight, in their order.
inline double sum(const RealPack& x) {
  double total = 0.0;
  for (std::size_t i = 0; i < pack_size; ++i) total += x[i];
  return total;
}

/// Packs that so many numbers fill, the last one perhaps in part.
inline std::size_t pack_count(std::size_t size) {
  return (size + pack_size - 1) / pack_size;
}

}  // namespace boresight::numerics
