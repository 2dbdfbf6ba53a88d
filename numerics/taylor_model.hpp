#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace boresight::numerics {

/// An interval of the frequency axis: w = centre + x with |x| <= half_width, or, towards infinite
/// frequency, w = 1/(centre + x). rad/s, or s/rad where it is reciprocal.
struct FrequencyInterval {
  double centre = 0.0;
  double half_width = 0.0;
  bool reciprocal = false;

  double frequency() const { return reciprocal ? 1.0 / centre : centre; }
};

/// A function on an interval as a parabola with a bound of the remainder:
///   |f(x) - (value + slope x + curvature x^2)| <= rest   for |x| <= half_width
/// (K. Makino, M. Berz, Taylor models and other validated functional inclusion methods,
/// International Journal of Pure and Applied Mathematics 4, 2003; truncation is enclosed, rounding
/// estimated). A rest that is infinite or not a number means that no bound is known.
struct TaylorModel {
  std::complex<double> value;
  std::complex<double> slope;
  std::complex<double> curvature;
  double rest = 0.0;

  static TaylorModel constant(std::complex<double> value) { return {value, 0.0, 0.0, 0.0}; }
};

/// |z| without the detour of std::abs around overflow: here an overflow is an infinite rest.
inline double magnitude(std::complex<double> z) {
  return std::sqrt(std::norm(z));
}

/// Largest magnitude that the parabola can have on the interval (not its maximum, but no less).
inline double magnitude_bound(const TaylorModel& model, double half_width) {
  return magnitude(model.value) +
         half_width * (magnitude(model.slope) + half_width * magnitude(model.curvature));
}

inline TaylorModel operator+(const TaylorModel& a, const TaylorModel& b) {
  return {a.value + b.value, a.slope + b.slope, a.curvature + b.curvature, a.rest + b.rest};
}

inline TaylorModel operator-(const TaylorModel& a, const TaylorModel& b) {
  return {a.value - b.value, a.slope - b.slope, a.curvature - b.curvature, a.rest + b.rest};
}

inline TaylorModel product(const TaylorModel& a, const TaylorModel& b, double half_width) {
  const double h = half_width;
  const double cubic = magnitude(a.slope * b.curvature + a.curvature * b.slope);
  const double quartic = magnitude(a.curvature * b.curvature);
  TaylorModel result{a.value * b.value, a.value * b.slope + a.slope * b.value,
                     a.value * b.curvature + a.slope * b.slope + a.curvature * b.value,
                     h * h * h * (cubic + h * quartic)};
  // A rest that is not a number (nothing known times 0) stays so.
  if (a.rest != 0.0) result.rest += a.rest * magnitude_bound(b, h);
  if (b.rest != 0.0) result.rest += b.rest * (magnitude_bound(a, h) + a.rest);
  return result;
}

/// 1/a; with an infinite rest where a might be 0 in the interval. `minimum`: a lower bound of |a|
/// on the interval known otherwise.
inline TaylorModel inverse(const TaylorModel& a, double half_width, double minimum = 0.0) {
  const double h = half_width;
  const double floor = std::max(
      minimum, magnitude(a.value) - h * (magnitude(a.slope) + h * magnitude(a.curvature)) - a.rest);
  if (!(floor > 0.0)) return {0.0, 0.0, 0.0, std::numeric_limits<double>::infinity()};
  const std::complex<double> value = 1.0 / a.value;
  const std::complex<double> square = value * value;
  TaylorModel result{value, -a.slope * square, (a.slope * a.slope * value - a.curvature) * square,
                     0.0};
  // a (value + slope x + curvature x^2) = 1 + d, so 1/a differs by |d|/|a|.
  const double defect = h * h * h *
                            (magnitude(a.slope * result.curvature + a.curvature * result.slope) +
                             h * magnitude(a.curvature * result.curvature)) +
                        (a.rest != 0.0 ? a.rest * magnitude_bound(result, h) : 0.0);
  result.rest = defect / floor;
  return result;
}

/// An upper bound of |f| on the interval, sharp to third order in its width.
inline double magnitude_upper_bound(const TaylorModel& model, double half_width) {
  if (!(model.rest < std::numeric_limits<double>::infinity())) {
    return std::numeric_limits<double>::infinity();
  }
  const double h = half_width;
  // |f|^2 = p0 + p1 x + p2 x^2 + p3 x^3 + p4 x^4
  const auto real_product = [](std::complex<double> a, std::complex<double> b) {
    return a.real() * b.real() + a.imag() * b.imag();
  };
  const double p0 = std::norm(model.value);
  const double p1 = 2.0 * real_product(model.value, model.slope);
  const double p2 = std::norm(model.slope) + 2.0 * real_product(model.value, model.curvature);
  const double p3 = 2.0 * real_product(model.slope, model.curvature);
  const double p4 = std::norm(model.curvature);
  double quadratic = p0 + std::abs(p1) * h + p2 * h * h;
  if (p2 < 0.0 && std::abs(p1) < -2.0 * p2 * h) quadratic = p0 - p1 * p1 / (4.0 * p2);
  const double square = quadratic + h * h * h * (std::abs(p3) + h * p4);
  return std::sqrt(std::max(square, 0.0)) + model.rest;
}

}  // namespace boresight::numerics
