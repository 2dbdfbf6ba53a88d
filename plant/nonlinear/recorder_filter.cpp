#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/nonlinear/recorder_filter.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

// Sections of second order, one behind the other, and one of first order if the order is odd.
StateSpace butterworth(const LowPass& filter) {
  const double corner = two_pi * filter.corner;
  StateSpace system;
  system.a = Eigen::MatrixXd::Zero(filter.order, filter.order);
  system.b = Eigen::MatrixXd::Zero(filter.order, 1);
  system.c = Eigen::MatrixXd::Zero(1, filter.order);
  system.d = Eigen::MatrixXd::Zero(1, 1);
  system.inputs = {"signal"};
  system.outputs = {"filtered"};
  for (int i = 0; i < filter.order; ++i) system.states.push_back(fmt::format("section_{}", i));
  system.b(0, 0) = corner;
  Index state = 0;
  Index before = -1;  // where the last section's output stands
  for (int k = 0; k < filter.order / 2; ++k) {
    const double damping = std::sin(std::numbers::pi * (2.0 * k + 1.0) / (2.0 * filter.order));
    // x1' = w (in - x2 - 2 zeta x1), x2' = w x1: out = x2
    system.a(state, state) = -2.0 * damping * corner;
    system.a(state, state + 1) = -corner;
    system.a(state + 1, state) = corner;
    if (before >= 0) system.a(state, before) = corner;
    before = state + 1;
    state += 2;
  }
  if (filter.order % 2 == 1) {
    system.a(state, state) = -corner;
    if (before >= 0) system.a(state, before) = corner;
    before = state;
  }
  system.c(0, before) = 1.0;
  return system;
}

}  // namespace

Index steps_per_sample(const LowPass& filter, double sample_time, double highest) {
  if (filter.order == 0) return 1;
  const double steps = std::ceil(sample_time * std::max(20.0 * filter.corner, 10.0 * highest));
  constexpr double maximum = 256.0;
  if (!(steps <= maximum)) {
    throw InvalidInput(fmt::format(
        "recorder: expected a filter_frequency and lines that {:g} steps a sample follow, found "
        "{:g} Hz and {:.4g} Hz, which take {:g}",
        maximum, filter.corner, highest, steps));
  }
  return std::max<Index>(1, static_cast<Index>(steps));
}

Eigen::VectorXd filtered(const LowPass& filter, const Eigen::VectorXd& signal, double interval,
                         Index stride) {
  Eigen::VectorXd smooth = signal;
  if (filter.order > 0 && signal.size() > 0) {
    LinearSimulation low_pass(butterworth(filter), interval,
                              {.interpolation = Interpolation::first_order_hold});
    const Eigen::MatrixXd about_start = signal.array() - signal[0];
    smooth = low_pass.simulate(about_start).col(0).array() + signal[0];
  }
  Eigen::VectorXd samples((signal.size() + stride - 1) / stride);
  for (Index i = 0; i < samples.size(); ++i) samples[i] = smooth[i * stride];
  return samples;
}

}  // namespace boresight::plant
