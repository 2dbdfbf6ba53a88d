#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::app {

std::string mast_in_words(const plant::WindMast& mast) {
  return fmt::format(
      "Wind speeds are at the dish centre, {:g} m above ground: the case's at its {:g} m mast "
      "times {:.4g}, by a power law of exponent {:g}.",
      mast.dish_height, mast.height, mast.speed_ratio, mast.shear_exponent);
}

std::string dish_and_mast(const std::optional<plant::WindMast>& mast, double speed) {
  if (!mast || !std::isfinite(speed)) return "";
  return fmt::format(" at the dish, {:.3g} at the mast", speed / mast->speed_ratio);
}

std::string speed_at_mast(const std::optional<plant::WindMast>& mast, double speed) {
  if (!mast || !std::isfinite(speed)) return "";
  return fmt::format(" ({:.3g})", speed / mast->speed_ratio);
}

std::string mast_column(const std::optional<plant::WindMast>& mast) {
  return mast ? " (at the mast)" : "";
}

std::string conclude_mast(const plant::WindMast& mast) {
  return fmt::format(
      "Wind speeds are at the dish centre, {:g} m above ground, unless stated otherwise: divide by "
      "{:.4g} for the case's {:g} m mast.",
      mast.dish_height, mast.speed_ratio, mast.height);
}

}  // namespace boresight::app
