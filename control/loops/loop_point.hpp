#pragma once

#include <complex>

#include <boresight/control/loops/loop_evaluator.hpp>

namespace boresight::control {

/// The loop at one frequency.
struct LoopPoint {
  CompensatorResponse compensator;
  std::complex<double> dead_time;
  std::complex<double> angle;  // response of the position path's angle: encoder less compliance
  std::complex<double> rate_return;  // 1 + L, position loop open
  std::complex<double> both_return;  // 1 + L, both closed
};

LoopPoint loop_point(const plant::ResponsePoint& response, const Controller& controller,
                     double frequency, double delay);

}  // namespace boresight::control
