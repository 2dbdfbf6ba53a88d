// 60 s of the peers' rate loop with its valve and friction, and a long record of a larger one.
#include <array>
#include <cmath>
#include <numbers>

#include <benchmark/benchmark.h>

#include "../tests/peer_drive.hpp"
#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/integration/feedback_ode.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>

namespace {

using namespace boresight;
using reference::DriveFriction;

constexpr double step = 0.01;
constexpr Eigen::Index samples = 6000;

Eigen::VectorXd triangle() {
  return Eigen::VectorXd::NullaryExpr(samples + 1, [](Eigen::Index k) {
    return reference::peer_rate_command(step * static_cast<double>(k));
  });
}

// v, th, T at the samples.
Eigen::MatrixXd by_fast_integrator(const plant::FeedbackSystem& system, double tolerance) {
  plant::FastIntegratorOptions options;
  options.interval = step;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 0.01 * tolerance);
  plant::FastIntegrator integrator(system, options);
  Eigen::MatrixXd output(samples, 3);
  integrator.simulate(triangle(), output, plant::Interpolation::first_order_hold);
  return output;
}

Eigen::MatrixXd by_cvodes(const plant::FeedbackSystem& system, double tolerance) {
  const Eigen::VectorXd command = triangle();
  plant::FeedbackOde ode(system);
  plant::OdeOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 0.01 * tolerance);
  plant::OdeIntegrator integrator(ode, 0.0, Eigen::VectorXd::Zero(ode.states()), options);
  Eigen::MatrixXd output(samples, 3);
  for (Eigen::Index k = 0; k < samples; ++k) {
    if (k % 500 == 0) {
      const double start = step * static_cast<double>(k);
      ode.drive(start, command.segment(k, 1), start + 5.0, command.segment(k + 500, 1));
      integrator.restart();
    }
    integrator.advance(step * static_cast<double>(k + 1), k % 500 == 499
                                                              ? plant::Approach::stop_exactly
                                                              : plant::Approach::interpolate);
    output.row(k) = ode.outputs(integrator.time(), integrator.state());
  }
  return output;
}

template <class Route>
void drive(benchmark::State& state, DriveFriction friction, const Route& route) {
  const auto system = reference::peer_drive(friction, state.range(0));
  Eigen::MatrixXd output;
  for (auto _ : state) output = route(system, 1e-6);
  state.counters["value0"] = output(samples - 1, 1);
  state.counters["value1"] = output(samples - 1, 0);
  state.counters["value2"] = output(samples - 1, 2);
  state.counters["value3"] = std::sqrt(output.col(0).squaredNorm() / (samples + 1.0));
  state.counters["value4"] = output.col(0).cwiseAbs().maxCoeff();
  // Largest error of v, by the same system at tolerances where the routes agree to 1e-8.
  state.counters["error"] =
      (output - by_fast_integrator(system, 1e-10)).col(0).cwiseAbs().maxCoeff();
}

void peer_nl_none_fast_integrator(benchmark::State& state) {
  drive(state, DriveFriction::none, by_fast_integrator);
}
void peer_nl_tanh_fast_integrator(benchmark::State& state) {
  drive(state, DriveFriction::tanh, by_fast_integrator);
}
void peer_nl_lugre_fast_integrator(benchmark::State& state) {
  drive(state, DriveFriction::lugre, by_fast_integrator);
}
void peer_nl_none_cvodes(benchmark::State& state) {
  drive(state, DriveFriction::none, by_cvodes);
}
void peer_nl_tanh_cvodes(benchmark::State& state) {
  drive(state, DriveFriction::tanh, by_cvodes);
}
void peer_nl_lugre_cvodes(benchmark::State& state) {
  drive(state, DriveFriction::lugre, by_cvodes);
}
BENCHMARK(peer_nl_none_fast_integrator)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(peer_nl_tanh_fast_integrator)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(peer_nl_lugre_fast_integrator)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(peer_nl_none_cvodes)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(peer_nl_tanh_cvodes)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(peer_nl_lugre_cvodes)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);

// 600 s of rate commands held for 20 ms each, through reversals.
void sampled_drive_600_s(benchmark::State& state) {
  const auto system = reference::peer_drive(DriveFriction::lugre, state.range(0));
  const Eigen::Index intervals = 30'000;
  const Eigen::MatrixXd command = Eigen::VectorXd::NullaryExpr(intervals, [](Eigen::Index k) {
    return 0.3 * std::sin(2.0 * std::numbers::pi * 0.05 * 0.02 * static_cast<double>(k));
  });
  plant::FastIntegratorOptions options;
  options.interval = 0.02;
  Eigen::MatrixXd output(intervals, 3);
  long long steps = 0;
  for (auto _ : state) {
    plant::FastIntegrator integrator(system, options);
    integrator.simulate(command, output);
    steps = integrator.statistics().steps;
  }
  state.counters["steps"] = static_cast<double>(steps);
}
BENCHMARK(sampled_drive_600_s)->Arg(5)->Arg(20)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
