#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/studies/number_effects.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

// Not a number where the loop is unstable; nothing where there is no such antenna.
std::optional<double> held_rms(const std::function<TrackingProblem()>& moved,
                               const control::Controller& controller, const Constraints& goals) {
  try {
    const TrackingProblem problem = moved();
    return evaluate(problem, {{"moved", problem.plant}}, controller, goals, 1)
        .members.front()
        .boresight_rms;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

}  // namespace

double NumberEffect::change(double rms) const {
  if (!std::isfinite(low_rms) || !std::isfinite(high_rms)) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(std::abs(low_rms - rms), std::abs(high_rms - rms)) / rms;
}

RmsRange combined_range(const std::vector<NumberEffect>& effects, double rms) {
  double below = 0.0, above = 0.0;
  for (const auto& effect : effects) {
    const double infinite = std::numeric_limits<double>::infinity();
    const double low = std::isfinite(effect.low_rms) ? effect.low_rms : infinite;
    const double high = std::isfinite(effect.high_rms) ? effect.high_rms : infinite;
    below = std::hypot(below, std::max(0.0, rms - std::min(low, high)));
    above = std::hypot(above, std::max(0.0, std::max(low, high) - rms));
  }
  return {std::max(0.0, rms - below), rms + above};
}

std::vector<NumberEffect> number_effects(const std::vector<MovedNumber>& numbers,
                                         const control::Controller& controller,
                                         const Constraints& goals, double rms, std::size_t maximum,
                                         unsigned threads) {
  std::vector<std::optional<double>> held(2 * numbers.size());
  numerics::for_each_index(held.size(), threads, [&](std::size_t job) {
    const MovedNumber& number = numbers[job / 2];
    held[job] = held_rms(job % 2 == 0 ? number.lower : number.upper, controller, goals);
  });
  std::vector<NumberEffect> effects;
  constexpr double worth_a_row = 1e-3;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto &low = held[2 * i], &high = held[2 * i + 1];
    if (!low || !high) continue;
    const NumberEffect effect{i, *low, *high};
    if (effect.change(rms) >= worth_a_row) effects.push_back(effect);
  }
  std::ranges::stable_sort(effects, [&](const NumberEffect& x, const NumberEffect& y) {
    return x.change(rms) > y.change(rms);
  });
  if (effects.size() > maximum) effects.resize(maximum);
  return effects;
}

}  // namespace boresight::design
