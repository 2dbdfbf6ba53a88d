#pragma once

#include <vector>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Of a score sheet: compliance against frequency, beam after a step and an impulse of torque, rms
/// against wind speed by wind model with the budgets, and by yaw and elevation where the case has a
/// table; the compared sheet's curves beside them. None of an unstable loop.
std::vector<Figure> benchmark_figures(const BenchmarkReport& report);

}  // namespace boresight::app
