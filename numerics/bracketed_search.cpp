#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/numerics/golden_section.hpp>

namespace boresight::numerics {

double bracketed_root(const std::function<double(double)>& function, double low, double high,
                      double at_low, double at_high) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  // best: the smaller value; other: across the zero; before: the last best.
  double best = high, at_best = at_high, other = low, at_other = at_low, before = low,
         at_before = at_low, step = high - low, last_step = step;
  constexpr int max_steps = 200;
  for (int i = 0; i < max_steps && at_best != 0.0; ++i) {
    if ((at_best > 0.0) == (at_other > 0.0)) {
      other = before;
      at_other = at_before;
      step = last_step = best - before;
    }
    if (std::abs(at_other) < std::abs(at_best)) {
      before = best;
      at_before = at_best;
      std::swap(best, other);
      std::swap(at_best, at_other);
    }
    const double tolerance = 2.0 * epsilon * std::max(std::abs(best), 0.25);
    const double half = 0.5 * (other - best);
    if (std::abs(half) <= tolerance) break;
    if (std::abs(last_step) < tolerance || std::abs(at_before) <= std::abs(at_best)) {
      step = last_step = half;
    } else {
      const double ratio = at_best / at_before;
      double numerator = 2.0 * half * ratio, denominator = 1.0 - ratio;
      if (before != other) {
        const double q = at_before / at_other, r = at_best / at_other;
        numerator = ratio * (2.0 * half * q * (q - r) - (best - before) * (r - 1.0));
        denominator = (q - 1.0) * (r - 1.0) * (ratio - 1.0);
      }
      if (numerator > 0.0) {
        denominator = -denominator;
      } else {
        numerator = -numerator;
      }
      const bool good =
          2.0 * numerator < std::min(3.0 * half * denominator - std::abs(tolerance * denominator),
                                     std::abs(last_step * denominator));
      last_step = good ? step : half;
      step = good ? numerator / denominator : half;
    }
    before = best;
    at_before = at_best;
    best += std::abs(step) > tolerance ? step : std::copysign(tolerance, half);
    at_best = function(best);
  }
  return best;
}

double bracketed_maximum(const std::function<double(double)>& function, double low, double high) {
  const double width = high - low;
  // Golden sections end well above the spacing of numbers there.
  const double finest = 16.0 * std::numeric_limits<double>::epsilon() *
                        std::max({std::abs(low), std::abs(high), 0.25});
  if (width < 4.0 * finest) return 0.5 * (low + high);
  const double coarse = std::max(1e-3 * width, finest), fine = std::max(1e-9 * width, finest);
  const double start = golden_section_maximum(function, low, high, coarse);
  if (start - low < 2e-3 * width || high - start < 2e-3 * width) {
    // Perhaps at the end itself.
    const double end = start - low < high - start ? low : high;
    const double place = golden_section_maximum(function, low, high, fine);
    return function(end) >= function(place) ? end : place;
  }
  const double at_start = function(start);
  double place = start;
  double h = 1e-2 * width;
  constexpr int max_steps = 12;
  for (int i = 0; i < max_steps; ++i) {
    const double here = function(place);
    const double back2 = function(place - 2.0 * h), back = function(place - h);
    const double ahead = function(place + h), ahead2 = function(place + 2.0 * h);
    const double slope = (back2 - 8.0 * back + 8.0 * ahead - ahead2) / (12.0 * h);
    const double curvature =
        (16.0 * (back + ahead) - back2 - ahead2 - 30.0 * here) / (12.0 * h * h);
    if (!(curvature < 0.0) || !std::isfinite(slope)) {
      h *= 0.1;
      continue;
    }
    const double newton = std::clamp(-slope / curvature, -2.0 * h, 2.0 * h);
    place = std::clamp(place + newton, low + 2.0 * h, high - 2.0 * h);
    // Truncation falls with h^4, rounding grows with 1/h: a small part of the maximum's own width.
    const double next =
        std::clamp(2e-3 / std::sqrt(-curvature), std::min(finest, 1e-2 * width), 1e-2 * width);
    if (std::abs(newton) < 1e-6 * next && next >= 0.5 * h) break;
    h = next;
  }
  return function(place) >= at_start ? place : golden_section_maximum(function, low, high, fine);
}

}  // namespace boresight::numerics
