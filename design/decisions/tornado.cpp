#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/design/decisions/tornado.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {

Tornado tornado(std::size_t inputs,
                const std::function<double(const std::vector<double>& fractions)>& function,
                double low, double high) {
  const bool in_order = low > 0.0 && low < 0.5 && high > 0.5 && high < 1.0;
  if (inputs < 1 || !in_order) {
    throw InvalidInput(
        fmt::format("tornado: expected at least one input and fractions 0 < low < 0.5 "
                    "< high < 1, found {} inputs, low {}, high {}",
                    inputs, low, high));
  }
  std::vector<double> fractions(inputs, 0.5);
  const auto value = [&](std::size_t input, double fraction) {
    fractions[input] = fraction;
    const double result = function(fractions);
    fractions[input] = 0.5;
    if (!std::isfinite(result)) {
      throw NumericalFailure(
          fmt::format("tornado: the function is not finite with input {} at its "
                      "fraction {}, the others at their medians",
                      input, fraction));
    }
    return result;
  };
  Tornado result;
  result.at_median = value(0, 0.5);
  for (std::size_t i = 0; i < inputs; ++i) {
    TornadoBar bar{i, value(i, low), value(i, high)};
    const auto [minimum, largest] = std::minmax({bar.at_low, bar.at_high, result.at_median});
    bar.swing = largest - minimum;
    result.bars.push_back(bar);
  }
  std::stable_sort(result.bars.begin(), result.bars.end(),
                   [](const TornadoBar& a, const TornadoBar& b) { return a.swing > b.swing; });
  return result;
}

}  // namespace boresight::design
