#pragma once

#include <cstddef>

namespace boresight::numerics {

/// Numbers that a processor works on side by side: eight, whatever the width of its registers, and
/// the same operations in the same order as one by one. Everything here is inlined into functions
/// that are compiled for wider registers (vector_clones.hpp).
inline constexpr std::size_t pack_size = 8;

// A function of its own would be compiled for the narrowest registers.
#define BORESIGHT_INLINE [[gnu::always_inline]] inline

// The alignment is stated: left to the compiler it would differ between the clones.
struct alignas(pack_size * sizeof(double)) RealPack {
  using Lanes = double __attribute__((vector_size(pack_size * sizeof(double))));
  Lanes lanes{};

  RealPack() = default;
  BORESIGHT_INLINE RealPack(double all) : lanes(Lanes{} + all) {}
  BORESIGHT_INLINE double operator[](std::size_t i) const { return lanes[i]; }
  BORESIGHT_INLINE void set(std::size_t i, double value) { lanes[i] = value; }
  BORESIGHT_INLINE RealPack& operator+=(const RealPack& x) {
    lanes += x.lanes;
    return *this;
  }
  BORESIGHT_INLINE RealPack& operator*=(const RealPack& x) {
    lanes *= x.lanes;
    return *this;
  }
  BORESIGHT_INLINE friend RealPack operator+(RealPack x, const RealPack& y) { return x += y; }
  BORESIGHT_INLINE friend RealPack operator-(RealPack x, const RealPack& y) {
    x.lanes -= y.lanes;
    return x;
  }
  BORESIGHT_INLINE friend RealPack operator-(RealPack x) {
    x.lanes = -x.lanes;
    return x;
  }
  BORESIGHT_INLINE friend RealPack operator*(RealPack x, const RealPack& y) { return x *= y; }
  BORESIGHT_INLINE friend RealPack operator/(RealPack x, const RealPack& y) {
    x.lanes /= y.lanes;
    return x;
  }
};

/// Eight complex numbers.
struct ComplexPack {
  RealPack re, im;

  BORESIGHT_INLINE friend ComplexPack operator+(const ComplexPack& x, const ComplexPack& y) {
    return {x.re + y.re, x.im + y.im};
  }
  BORESIGHT_INLINE friend ComplexPack operator-(const ComplexPack& x, const ComplexPack& y) {
    return {x.re - y.re, x.im - y.im};
  }
  BORESIGHT_INLINE friend ComplexPack operator-(const ComplexPack& x) { return {-x.re, -x.im}; }
  BORESIGHT_INLINE friend ComplexPack operator*(const ComplexPack& x, const ComplexPack& y) {
    return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
  }
  BORESIGHT_INLINE friend ComplexPack operator*(const ComplexPack& x, const RealPack& y) {
    return {x.re * y, x.im * y};
  }
};

BORESIGHT_INLINE ComplexPack conjugate(const ComplexPack& x) {
  return {x.re, -x.im};
}
BORESIGHT_INLINE RealPack square(const ComplexPack& x) {
  return x.re * x.re + x.im * x.im;
}
/// Re(x y)
BORESIGHT_INLINE RealPack real_product(const ComplexPack& x, const ComplexPack& y) {
  return x.re * y.re - x.im * y.im;
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
