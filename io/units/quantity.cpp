#include <cmath>

#include <fmt/format.h>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

std::string_view to_string(Basis basis) {
  switch (basis) {
    case Basis::measured:
      return "measured";
    case Basis::published:
      return "published";
    case Basis::inferred:
      return "inferred";
    case Basis::assumed:
      return "assumed";
    case Basis::unstated:
      break;
  }
  return "unstated";
}

Quantity derived_quantity(const Quantity& from, Kind kind, double value, std::string_view unit) {
  Quantity quantity = from;
  quantity.also.clear();
  quantity.kind = kind;
  quantity.value = value;
  quantity.half_unit = 0.0;
  quantity.text = fmt::format("{:.4g} {}", value, unit);
  return quantity;
}

double relative_uncertainty(const Quantity& quantity) {
  return quantity.value != 0.0 ? quantity.standard_uncertainty / std::abs(quantity.value) : 0.0;
}

}  // namespace boresight::io
