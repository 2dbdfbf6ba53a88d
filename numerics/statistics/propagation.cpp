#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>
#include <boresight/numerics/statistics/propagation.hpp>

namespace boresight::numerics {
namespace {

// Standard normal numbers by Box and Muller's transform: the same on every standard library.
class StandardNormals {
 public:
  explicit StandardNormals(std::uint64_t seed) : generator_(seed) {}
  double next() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(two_pi * uniform());
  }

 private:
  double uniform() { return (static_cast<double>(generator_() >> 11) + 0.5) * 0x1p-53; }
  std::mt19937_64 generator_;
};

void first_order(const std::vector<UncertainInput>& inputs, const PropagationTarget& target,
                 PropagatedResult& result) {
  std::vector<double> point(inputs.size());
  std::transform(inputs.begin(), inputs.end(), point.begin(),
                 [](const UncertainInput& input) { return input.value; });
  const double centre = target.evaluate(point);
  result.value = target.reciprocal ? 1.0 / centre : centre;
  double variance = 0.0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].standard_uncertainty == 0.0) continue;
    const double step = 1e-5 * inputs[i].value;
    point[i] = inputs[i].value + step;
    const double up = target.evaluate(point);
    point[i] = inputs[i].value - step;
    const double down = target.evaluate(point);
    point[i] = inputs[i].value;
    const double part = (up - down) / (2.0 * step) * inputs[i].standard_uncertainty;
    result.contributions.push_back({inputs[i].name, part * part});
    variance += part * part;
  }
  // d(1/g) = dg/g^2
  result.standard_uncertainty =
      std::sqrt(variance) * (target.reciprocal ? result.value * result.value : 1.0);
  for (auto& contribution : result.contributions) contribution.fraction /= variance;
  std::erase_if(result.contributions, [](const Contribution& c) { return !(c.fraction >= 0.01); });
  std::stable_sort(
      result.contributions.begin(), result.contributions.end(),
      [](const Contribution& x, const Contribution& y) { return x.fraction > y.fraction; });
}

}  // namespace

std::vector<PropagatedResult> propagate(const std::vector<UncertainInput>& inputs,
                                        const std::vector<PropagationTarget>& targets,
                                        const PropagationOptions& options) {
  if (options.random_samples < 100) {
    throw InvalidInput(
        fmt::format("propagate: expected at least 100 samples, found {}", options.random_samples));
  }
  for (const auto& input : inputs) {
    if (!(input.value > 0.0) || !(input.standard_uncertainty >= 0.0) ||
        !std::isfinite(input.value) || !std::isfinite(input.standard_uncertainty)) {
      throw InvalidInput(fmt::format(
          "propagate: expected a positive value and an uncertainty of at least 0 for '{}', found "
          "{} and {}",
          input.name, input.value, input.standard_uncertainty));
    }
  }
  StandardNormals normal(options.seed);
  const auto random_samples = static_cast<std::size_t>(options.random_samples);
  std::vector<std::vector<double>> samples(targets.size(), std::vector<double>(random_samples));
  std::vector<double> point(inputs.size());
  for (std::size_t draw = 0; draw < random_samples; ++draw) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const double spread = inputs[i].standard_uncertainty / inputs[i].value;
      point[i] = inputs[i].value * std::exp(spread * normal.next());
    }
    for (std::size_t t = 0; t < targets.size(); ++t) {
      samples[t][draw] = targets[t].evaluate(point);
    }
  }
  std::vector<PropagatedResult> results;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    PropagatedResult result;
    result.name = targets[t].name;
    first_order(inputs, targets[t], result);
    auto& sorted = samples[t];
    std::sort(sorted.begin(), sorted.end());
    result.lower = quantile(sorted, 0.025);
    result.upper = quantile(sorted, 0.975);
    if (targets[t].reciprocal) {
      const auto positive = std::upper_bound(sorted.begin(), sorted.end(), 0.0);
      result.beyond_pole =
          static_cast<double>(positive - sorted.begin()) / static_cast<double>(random_samples);
      const double low = result.lower, high = result.upper;
      constexpr double infinity = std::numeric_limits<double>::infinity();
      result.lower = high > 0.0 ? 1.0 / high : infinity;
      result.upper = low > 0.0 ? 1.0 / low : infinity;
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace boresight::numerics
