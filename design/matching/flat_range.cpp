#include <cmath>
#include <limits>

#include <boresight/design/matching/flat_range.hpp>

namespace boresight::design {

std::optional<std::size_t> least_of(const std::vector<double>& values) {
  std::optional<std::size_t> minimum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && (!minimum || values[i] < values[*minimum])) minimum = i;
  }
  return minimum;
}

FlatRange flat_range(const std::vector<double>& axis, const std::vector<double>& values,
                     double fraction) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto minimum = least_of(values);
  if (!minimum) return {nan, nan};
  const double level = values[*minimum] * (1.0 + fraction);
  const auto reach = [&](auto next) {
    std::size_t i = *minimum;
    for (auto other = next(i); other; other = next(i)) {
      if (!std::isfinite(values[*other])) break;
      if (values[*other] > level) {
        const double part = (level - values[i]) / (values[*other] - values[i]);
        return axis[i] + part * (axis[*other] - axis[i]);
      }
      i = *other;
    }
    return axis[i];
  };
  using Next = std::optional<std::size_t>;
  return {reach([](std::size_t i) { return i > 0 ? Next(i - 1) : Next(); }),
          reach([&](std::size_t i) { return i + 1 < axis.size() ? Next(i + 1) : Next(); })};
}

}  // namespace boresight::design
