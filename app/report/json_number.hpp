#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace boresight::app {

using Json = nlohmann::ordered_json;

/// JSON has neither infinity nor NaN: null.
inline Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// null where there is none; otherwise in a unit, given as its size in SI.
inline Json number(const std::optional<double>& value, double unit = 1.0) {
  return value ? number(*value / unit) : Json(nullptr);
}

/// null for an empty text.
inline Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

}  // namespace boresight::app
