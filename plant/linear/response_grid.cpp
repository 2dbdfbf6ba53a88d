#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::plant {
namespace {

constexpr double max_points = 4e6;
constexpr double infinity = std::numeric_limits<double>::infinity();

void check(double sample_time, const ResponseGridOptions& options) {
  if (!(sample_time >= 0.0) || !std::isfinite(sample_time)) {
    throw InvalidInput(
        fmt::format("response_grid: expected a sample time of 0 (continuous) or more, found {} s",
                    sample_time));
  }
  const bool limits_hold = options.lowest >= 0.0 && options.highest >= 0.0 &&
                           std::isfinite(options.lowest) && std::isfinite(options.highest);
  if (!limits_hold) {
    throw InvalidInput(
        fmt::format("response_grid: expected limits of 0 (chosen) or more, found {} and {} rad/s",
                    options.lowest, options.highest));
  }
  const bool decades_hold = options.decades_beyond > 0.0 && options.decades_beyond <= 100.0;
  if (options.points_per_decade < 1 || !(options.longest_step > 0.0) || !decades_hold) {
    throw InvalidInput(fmt::format(
        "response_grid: expected at least 1 point a decade, a longest step above 0 and 0 to 100 "
        "decades beyond, found {}, {} rad/s and {}",
        options.points_per_decade, options.longest_step, options.decades_beyond));
  }
}

struct Limits {
  double lowest, highest;
};

Limits choose_limits(const Eigen::VectorXcd& features, double nyquist,
                     const ResponseGridOptions& options) {
  double fastest = 0.0;
  for (const auto feature : features) {
    if (std::isfinite(feature.real())) fastest = std::max(fastest, std::abs(feature));
  }
  // What is slower by fourteen decades is an integrator with rounding errors.
  double slowest = fastest;
  for (const auto feature : features) {
    const double magnitude = std::abs(feature);
    if (magnitude > 1e-14 * fastest) slowest = std::min(slowest, magnitude);
  }
  if (fastest == 0.0) slowest = fastest = std::isfinite(nyquist) ? 0.1 * nyquist : 1.0;
  const double beyond = std::pow(10.0, options.decades_beyond);
  Limits limits{options.lowest, options.highest};
  if (limits.highest == 0.0) {
    limits.highest = std::isfinite(nyquist) ? nyquist : std::max(fastest, options.lowest) * beyond;
  }
  limits.highest = std::min(limits.highest, nyquist);
  if (limits.lowest == 0.0) limits.lowest = std::min(slowest, limits.highest) / beyond;
  if (!(limits.lowest < limits.highest)) {
    throw InvalidInput(fmt::format(
        "response_grid: expected lowest < highest, found {} and {} rad/s{}", limits.lowest,
        limits.highest, std::isfinite(nyquist) ? ", the Nyquist frequency at most" : ""));
  }
  return limits;
}

}  // namespace

Eigen::VectorXcd continuous_equivalent(const Eigen::VectorXcd& poles, double sample_time) {
  Eigen::VectorXcd result(poles.size());
  for (Eigen::Index i = 0; i < poles.size(); ++i) {
    const double magnitude = std::abs(poles[i]);
    result[i] = magnitude > 0.0
                    ? std::complex<double>{std::log(magnitude), std::arg(poles[i])} / sample_time
                    : std::complex<double>{-infinity, 0.0};
  }
  return result;
}

Eigen::ArrayXd response_grid(const Eigen::VectorXcd& given_features, double sample_time,
                             const ResponseGridOptions& options) {
  check(sample_time, options);
  if (!given_features.allFinite()) {
    throw InvalidInput("response_grid: the features have elements that are not finite");
  }
  const bool sampled = sample_time > 0.0;
  const double nyquist = sampled ? std::numbers::pi / sample_time : infinity;
  const Eigen::VectorXcd features =
      sampled ? continuous_equivalent(given_features, sample_time) : given_features;
  const auto [lowest, highest] = choose_limits(features, nyquist, options);

  std::vector<double> points;
  const double width = std::log(highest / lowest);
  const double step = std::numbers::ln10 / options.points_per_decade;
  const double plain = std::ceil(width / step);
  if (!(plain + highest / options.longest_step < max_points)) {
    throw InvalidInput(fmt::format(
        "response_grid: from {} to {} rad/s in steps of at most {} rad/s and {} points a decade "
        "are more than four million points; narrow the limits",
        lowest, highest, options.longest_step, options.points_per_decade));
  }
  const auto intervals = static_cast<int>(plain);
  for (int i = 0; i < intervals; ++i) {
    points.push_back(lowest * std::exp(width * i / intervals));
  }
  points.push_back(highest);
  const auto add = [&](double w) {
    if (w > lowest && w < highest) points.push_back(w);
  };
  for (const auto feature : features) {
    const double center = std::abs(feature.imag());
    // An undamped one is approached to within 1e-7 of itself.
    const double half_width = std::max(std::abs(feature.real()), 1e-7 * center);
    // Where steps that grow by 1.4 become those of the logarithmic grid.
    const double reach = 1.4 / 0.4 * step * center;
    if (feature.imag() < 0.0 || !(half_width < reach)) continue;
    add(center);
    for (double offset = 0.25 * half_width; offset < reach;
         offset = std::max(1.4 * offset, offset < half_width ? offset + 0.25 * half_width : 0.0)) {
      add(center - offset);
      add(center + offset);
    }
  }
  std::sort(points.begin(), points.end());
  std::vector<double> rising{lowest};
  for (const double w : points) {
    const double previous = rising.back();
    if (!(w > previous * (1.0 + 1e-10))) continue;
    const double parts = std::ceil((w - previous) / options.longest_step);
    for (double k = 1.0; k < parts; ++k) rising.push_back(previous + (w - previous) * k / parts);
    rising.push_back(w);
  }
  rising.back() = highest;
  return Eigen::Map<Eigen::ArrayXd>(rising.data(), static_cast<Eigen::Index>(rising.size()));
}

Eigen::ArrayXd response_grid(const StateSpace& system, const ResponseGridOptions& options) {
  return response_grid(numerics::eigenvalues(balanced(system).a), system.sample_time, options);
}

}  // namespace boresight::plant
