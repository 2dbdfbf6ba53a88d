#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/figures/axis_ticks.hpp>

namespace boresight::app {
namespace {

double round_step(double minimum, bool angle) {
  if (angle && minimum > 10.0) {
    for (const double step : {15.0, 30.0, 45.0, 90.0, 180.0, 360.0}) {
      if (minimum <= step * 1.000001) return step;
    }
    return 360.0 * std::ceil(minimum / 360.0);
  }
  const double power = std::pow(10.0, std::floor(std::log10(minimum)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (minimum <= factor * power * 1.000001) return factor * power;
  }
  return 10.0 * power;
}

std::string with_minus_sign(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

std::string power_of_ten(int exponent) {
  static constexpr std::array<const char*, 10> digits{"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                                      "\u2074", "\u2075", "\u2076", "\u2077",
                                                      "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "10\u207b" : "10";
  for (const char c : fmt::format("{}", std::abs(exponent))) {
    text += digits.at(static_cast<std::size_t>(c - '0'));
  }
  return text;
}

std::string linear_label(double value, double step, double largest) {
  if (value == 0.0) return "0";
  if (largest >= 1e6 || largest < 1e-4) {
    const int exponent = static_cast<int>(std::floor(std::log10(largest)));
    const double factor = std::pow(10.0, exponent);
    const int decimals =
        std::max(0, static_cast<int>(-std::floor(std::log10(step / factor) + 1e-9)));
    return with_minus_sign(fmt::format("{:.{}f}", value / factor, decimals)) + "\u00d7" +
           power_of_ten(exponent);
  }
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return with_minus_sign(fmt::format("{:.{}f}", value, decimals));
}

AxisTicks linear_ticks(double from, double to, int wanted, bool angle) {
  AxisTicks ticks;
  const double step = round_step((to - from) / (1.4 * std::max(wanted, 1)), angle);
  const double slack = 1e-6 * step;
  const double largest = std::max(std::abs(from), std::abs(to));
  const auto first = std::ceil((from - slack) / step);
  for (int i = 0; (first + i) * step <= to + slack; ++i) {
    const double value = (first + i) * step;
    ticks.major.push_back(value);
    ticks.labels.push_back(linear_label(value, step, largest));
  }
  return ticks;
}

std::string logarithmic_label(double value, bool powers) {
  const double exponent = std::log10(value);
  if (powers) return power_of_ten(static_cast<int>(std::lround(exponent)));
  return fmt::format("{:.6g}", value);
}

AxisTicks logarithmic_ticks(double from, double to, int wanted) {
  AxisTicks ticks;
  const double decades = std::log10(to / from);
  constexpr double slack = 1.0 + 1e-9;
  const int lowest = static_cast<int>(std::floor(std::log10(from)));
  const int highest = static_cast<int>(std::ceil(std::log10(to)));
  // Numbers as they are spoken between 0.001 and 10000, powers of ten where an axis goes beyond.
  const bool powers = from < 0.99e-3 || to > 1.01e4;
  const int skip = std::max(1, static_cast<int>(std::ceil(decades / (1.5 * wanted))));
  const bool few = decades * 3.0 <= 1.5 * wanted && !powers;
  for (int decade = lowest; decade <= highest; ++decade) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      if (value * slack < from || value > to * slack) continue;
      const bool named = digit == 1 ? decade % skip == 0 : few && (digit == 2 || digit == 5);
      if (!named) {
        if (skip == 1 || digit == 1) ticks.minor.push_back(value);
        continue;
      }
      ticks.major.push_back(value);
      ticks.labels.push_back(logarithmic_label(value, powers));
    }
  }
  if (ticks.major.size() >= 3) return ticks;
  // Within a decade round numbers tell more than powers.
  AxisTicks even = linear_ticks(from, to, wanted, false);
  const auto positive =
      std::find_if(even.major.begin(), even.major.end(), [&](double value) { return value > 0.0; });
  const auto dropped = positive - even.major.begin();
  even.major.erase(even.major.begin(), positive);
  even.labels.erase(even.labels.begin(), even.labels.begin() + dropped);
  return even.major.size() > ticks.major.size() && decades < 1.0 ? even : ticks;
}

}  // namespace

AxisTicks axis_ticks(const FigureAxis& axis, double from, double to, int wanted) {
  if (!axis.categories.empty()) {
    AxisTicks ticks;
    for (std::size_t i = 0; i < axis.categories.size(); ++i) {
      ticks.major.push_back(static_cast<double>(i));
      ticks.labels.push_back(axis.categories[i]);
    }
    return ticks;
  }
  if (axis.scale == AxisScale::logarithmic) return logarithmic_ticks(from, to, wanted);
  return linear_ticks(from, to, wanted, axis.unit == "deg");
}

}  // namespace boresight::app
