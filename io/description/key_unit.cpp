#include <cmath>

#include <fmt/format.h>

#include <boresight/io/description/key_unit.hpp>

namespace boresight::io {

double in_unit(double value, const KeyUnit& unit) {
  return unit.decibel ? 20.0 * std::log10(value) : value * unit.multiplier / unit.divisor;
}

KeyUnit without_suffix(const KeyUnit& unit) {
  KeyUnit unnamed = unit;
  unnamed.suffix = {};
  return unnamed;
}

std::string key_with_unit(std::string_view key, const KeyUnit& unit) {
  return unit.suffix.empty() ? std::string(key) : fmt::format("{}_{}", key, unit.suffix);
}

}  // namespace boresight::io
