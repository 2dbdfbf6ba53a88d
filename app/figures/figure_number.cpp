#include <cmath>

#include <fmt/format.h>

#include <boresight/app/figures/figure_number.hpp>

namespace boresight::app {

std::string figure_number(double value) {
  if (!std::isfinite(value)) return {};
  return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value);
}

}  // namespace boresight::app
