#pragma once

#include <vector>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Figures of a score sheet: compliance against frequency; boresight error after a torque step and
/// a torque impulse; rms against wind speed per wind model, with the budgets; rms by yaw and
/// elevation where the case has a table. The curves of a compared sheet are drawn beside them.
/// Empty for an unstable loop.
std::vector<Figure> benchmark_figures(const BenchmarkReport& report);

}  // namespace boresight::app
