#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/report/wind_mast.hpp>

namespace boresight::app {

std::string mast_in_words(const WindMast& mast) {
  return fmt::format(
      "Wind speeds are those at the dish's centre, {:g} m above ground: the case's, on a mast of "
      "{:g} m, times {:.4g} by a power law with the exponent {:g}.",
      mast.dish_height, mast.height, mast.speed_ratio, mast.shear_exponent);
}

nlohmann::ordered_json mast_json(const WindMast& mast) {
  return {{"height_m", mast.height},
          {"dish_height_m", mast.dish_height},
          {"shear_exponent_1", mast.shear_exponent},
          {"speed_ratio_1", mast.speed_ratio}};
}

}  // namespace boresight::app
