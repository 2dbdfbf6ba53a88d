#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <boresight/control/analysis/modal_margins.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// Poles of core and modes; of a dead time the frequency at which it turns by one rad.
Eigen::VectorXcd features(const plant::ModalResponse& loop) {
  const auto& reduction = loop.reduction();
  std::vector<Complex> found(loop.core().poles.begin(), loop.core().poles.end());
  for (Eigen::Index i = 0; i < reduction.mode_frequency.size(); ++i) {
    const double w = reduction.mode_frequency[i];
    const double zeta = std::min(1.0, reduction.mode_damping_ratio[i]);
    found.push_back(w * Complex(-zeta, std::sqrt(1.0 - zeta * zeta)));
  }
  for (const auto& back : reduction.returns) {
    if (back.is_dead_time && back.delay > 0.0) found.emplace_back(-1.0 / back.delay, 0.0);
  }
  if (found.empty()) found.emplace_back(-1.0, 0.0);
  return Eigen::Map<const Eigen::VectorXcd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

void check(const ModalMarginOptions& options) {
  if (!(options.largest_turn >= 0.01) || options.largest_turn > 1.0) {
    throw InvalidInput(fmt::format("margins: expected a largest turn of 0.01 to 1 rad, found {}",
                                   options.largest_turn));
  }
}

void check_values(const Eigen::ArrayXd& frequency, const Eigen::ArrayXcd& value) {
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    if (std::isfinite(value[i].real()) && std::isfinite(value[i].imag())) continue;
    throw NumericalFailure(
        fmt::format("margins: the loop gain is not finite at {} rad/s; move the limits of the "
                    "frequencies off the pole on the axis",
                    frequency[i]));
  }
}

bool turns(Complex from, Complex to, double largest) {
  const Complex ratio = to / from;
  return std::abs(std::arg(ratio)) > largest || std::abs(std::log(std::abs(ratio))) > largest;
}

}  // namespace

Margins margins(const plant::ModalResponse& loop, const ModalMarginOptions& options) {
  check(options);
  plant::ResponseGridOptions grid;
  grid.lowest = options.lowest;
  grid.highest = options.highest;
  grid.points_per_decade = options.points_per_decade;
  LoopOnGrid on_grid;
  on_grid.gain = [&loop](double w) { return loop.at(w); };
  on_grid.frequency = plant::response_grid(features(loop), 0.0, grid);
  loop.evaluate(on_grid.frequency, on_grid.value);
  check_values(on_grid.frequency, on_grid.value);

  // Generation by generation between points where L turns too far.
  Eigen::ArrayXcd between_value;
  while (true) {
    std::vector<double> between;
    const Eigen::ArrayXd& w = on_grid.frequency;
    for (Eigen::Index i = 1; i < w.size(); ++i) {
      if (w[i] - w[i - 1] > 1e-9 * w[i] &&
          turns(on_grid.value[i - 1], on_grid.value[i], options.largest_turn)) {
        between.push_back(std::sqrt(w[i] * w[i - 1]));
      }
    }
    if (between.empty()) break;
    if (between.size() + static_cast<std::size_t>(w.size()) > options.max_points) {
      throw NumericalFailure(fmt::format(
          "margins: following the loop gain takes more than {} frequencies; narrow their limits",
          options.max_points));
    }
    const auto more = static_cast<Eigen::Index>(between.size());
    const Eigen::ArrayXd added = Eigen::Map<const Eigen::ArrayXd>(between.data(), more);
    loop.evaluate(added, between_value);
    check_values(added, between_value);
    LoopOnGrid merged;
    merged.frequency.resize(w.size() + more);
    merged.value.resize(w.size() + more);
    for (Eigen::Index i = 0, a = 0, k = 0; k < merged.frequency.size(); ++k) {
      const bool old = a == more || (i < w.size() && w[i] < added[a]);
      merged.frequency[k] = old ? w[i] : added[a];
      merged.value[k] = old ? on_grid.value[i] : between_value[a];
      ++(old ? i : a);
    }
    on_grid.frequency = std::move(merged.frequency);
    on_grid.value = std::move(merged.value);
  }
  const double rounding = 1e-15 * std::max(10.0, loop.core().condition);
  on_grid.largest_turn = options.largest_turn;
  on_grid.uncertainty = Eigen::ArrayXd::Constant(on_grid.frequency.size(), rounding);
  return margins(on_grid, options.crossovers);
}

}  // namespace boresight::control
