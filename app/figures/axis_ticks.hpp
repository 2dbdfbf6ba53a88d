#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

struct AxisTicks {
  std::vector<double> major;
  std::vector<std::string> labels;  // one a major tick; UTF-8 minus signs and superscripts
  std::vector<double> minor;
};

/// Round values between `from` and `to`, some `wanted` of them, at most half as many again:
/// multiples of 1, 2 or 5 times a power of ten, of angles (unit deg) of 15, 30, 45, 90, ...
/// Logarithmic axes have powers of ten, with 2 and 5 where there are few; categories one tick each.
AxisTicks axis_ticks(const FigureAxis& axis, double from, double to, int wanted);

}  // namespace boresight::app
