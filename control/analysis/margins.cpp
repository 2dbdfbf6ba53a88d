#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/analysis/loop_response.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

enum class ClosedLoop { sensitivity, complementary, disk };

// |S|, |T| or |S - 1/2| of an open loop gain; infinite gains are integrators.
double magnitude(ClosedLoop what, Complex gain) {
  const bool large = std::abs(gain) > 1.0;
  if (!std::isfinite(std::abs(gain))) {
    return what == ClosedLoop::sensitivity ? 0.0 : what == ClosedLoop::complementary ? 1.0 : 0.5;
  }
  const Complex inverse = large ? 1.0 / gain : gain;  // of a gain above 1, as both forms agree
  const double common = std::abs(1.0 + inverse);
  switch (what) {
    case ClosedLoop::sensitivity:
      return (large ? std::abs(inverse) : 1.0) / common;
    case ClosedLoop::complementary:
      return (large ? 1.0 : std::abs(inverse)) / common;
    case ClosedLoop::disk:
      break;
  }
  return 0.5 * std::abs(1.0 - inverse) / common;
}

// Largest value on the grid, the highest local maxima refined between their neighbours.
ResponsePeak peak_on_grid(const LoopOnGrid& loop, ClosedLoop what) {
  const Eigen::Index count = loop.frequency.size();
  Eigen::ArrayXd value(count);
  for (Eigen::Index i = 0; i < count; ++i) value[i] = magnitude(what, loop.value[i]);
  Eigen::Index highest = 0;
  ResponsePeak peak;
  peak.magnitude = value.maxCoeff(&highest);
  peak.frequency = loop.frequency[highest];
  // A local maximum that much lower on the grid is lower between its points too.
  const double threshold = 0.8 * peak.magnitude;
  const auto function = [&](double x) { return std::log(magnitude(what, loop.gain(std::exp(x)))); };
  for (Eigen::Index i = 1; i + 1 < count; ++i) {
    if (value[i] < threshold || value[i] < value[i - 1] || !(value[i] > value[i + 1])) continue;
    const double x = numerics::bracketed_maximum(function, std::log(loop.frequency[i - 1]),
                                                 std::log(loop.frequency[i + 1]));
    const double refined = std::exp(function(x));
    if (refined > peak.magnitude || (i == highest && refined > peak.magnitude * (1.0 - 1e-12))) {
      peak = {std::exp(x), refined};
    }
  }
  return peak;
}

void check_grid(const LoopOnGrid& loop) {
  const Eigen::ArrayXd& w = loop.frequency;
  const Eigen::Index count = w.size();
  if (count == 0) throw InvalidInput("margins: the grid of frequencies is empty");
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!(w[i] > (i == 0 ? 0.0 : w[i - 1])) || !std::isfinite(w[i])) {
      throw InvalidInput(fmt::format(
          "margins: expected positive frequencies that rise, found {} rad/s at position {}", w[i],
          i));
    }
    if (std::isnan(loop.value[i].real()) || std::isnan(loop.value[i].imag())) {
      throw InvalidInput(fmt::format("margins: the loop gain is not a number at {} rad/s", w[i]));
    }
  }
}

// With a dead time: the frequency above which |L| stays below `lowest_gain`.
double end_of_search(LoopResponse& response, const plant::ResponseGridOptions& grid_options,
                     double lowest_gain) {
  const Eigen::ArrayXd frequency =
      plant::response_grid(response.features(), response.sample_time(), grid_options);
  const Eigen::ArrayXcd value = response.at(frequency);
  Eigen::Index last = frequency.size() - 1;
  while (last > 1 && std::abs(value[last - 1]) < lowest_gain) --last;
  return frequency[last];
}

}  // namespace

void update_smallest(Margins& margins) {
  margins.increasing_gain_margin = margins.delay_margin = infinity;
  margins.decreasing_gain_margin = 0.0;
  margins.phase_margin_deg = 180.0;
  for (const auto& crossover : margins.gain_crossovers) {
    margins.phase_margin_deg =
        std::min(margins.phase_margin_deg, std::abs(crossover.phase_margin_deg));
    margins.delay_margin = std::min(margins.delay_margin, crossover.delay_margin);
  }
  for (const auto& crossover : margins.phase_crossovers) {
    double& margin = crossover.gain_margin > 1.0 ? margins.increasing_gain_margin
                                                 : margins.decreasing_gain_margin;
    margin = crossover.gain_margin > 1.0 ? std::min(margin, crossover.gain_margin)
                                         : std::max(margin, crossover.gain_margin);
  }
}

Margins margins(const LoopOnGrid& loop, const CrossoverOptions& options) {
  check_grid(loop);
  Margins result;
  Crossovers found = crossovers_on_grid(loop, options);
  result.gain_crossovers = std::move(found.gain);
  result.phase_crossovers = std::move(found.phase);
  result.tangencies = std::move(found.tangencies);
  update_smallest(result);
  result.sensitivity = peak_on_grid(loop, ClosedLoop::sensitivity);
  result.complementary = peak_on_grid(loop, ClosedLoop::complementary);
  const ResponsePeak disk = peak_on_grid(loop, ClosedLoop::disk);
  result.disk = disk_margin_of(1.0 / disk.magnitude, disk.frequency);
  result.lowest_frequency = loop.frequency[0];
  result.highest_frequency = loop.frequency[loop.frequency.size() - 1];
  return result;
}

Margins margins(const std::function<Complex(double)>& loop_gain, const Eigen::ArrayXd& frequency,
                const CrossoverOptions& options) {
  constexpr double rounding = 1e-13;
  return margins({loop_gain, frequency, frequency.unaryExpr(loop_gain),
                  Eigen::ArrayXd::Constant(frequency.size(), rounding)},
                 options);
}

Margins margins(const plant::StateSpace& loop, const MarginOptions& options) {
  LoopResponse response("margins", loop, options.dead_time);
  plant::ResponseGridOptions grid;
  grid.points_per_decade = options.points_per_decade;
  grid.decades_beyond = options.decades_beyond;
  const bool sampled = loop.sample_time > 0.0;
  if (options.dead_time > 0.0) {
    if (!sampled && std::abs(loop.d(0, 0)) >= 1.0) {
      throw InvalidInput(fmt::format(
          "margins: expected a feedthrough below 1 in a loop with dead time, found {}: it has no "
          "stability to lose",
          loop.d(0, 0)));
    }
    if (!sampled) grid.highest = end_of_search(response, grid, options.lowest_gain);
    constexpr double longest_turn = 0.25;  // rad
    grid.longest_step = longest_turn / options.dead_time;
  }
  const LoopOnGrid on_grid =
      response.on_grid(plant::response_grid(response.features(), loop.sample_time, grid));
  Margins result = margins(on_grid, options.crossovers);

  response.add_real_ends(result.phase_crossovers);
  update_smallest(result);
  Complex last = response.at_highest();
  if (!sampled && options.dead_time > 0.0) last = -std::abs(last);
  const auto include_end = [&](double frequency, Complex gain) {
    const auto include = [&](ResponsePeak& peak, ClosedLoop what) {
      const double here = magnitude(what, gain);
      if (here > peak.magnitude) peak = {frequency, here};
    };
    include(result.sensitivity, ClosedLoop::sensitivity);
    include(result.complementary, ClosedLoop::complementary);
    const double disk = magnitude(ClosedLoop::disk, gain);
    if (disk > 1.0 / result.disk.alpha) result.disk = disk_margin_of(1.0 / disk, frequency);
  };
  include_end(0.0, response.at_zero());
  if (!sampled) include_end(infinity, last);
  result.lowest_frequency = 0.0;
  if (!sampled && options.dead_time == 0.0) result.highest_frequency = infinity;
  result.closed_loop_stable = response.closed_loop_stable();
  return result;
}

}  // namespace boresight::control
