#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::io {

void describe(Visitor& v, const plant::WindMast& mast) {
  const KeyUnit metre{.suffix = "m"};
  const NumberForm positive{.above = 0.0, .finite = true};
  v.defined_as("wind_mast",
               "The mast that the case's wind speeds are from; wind speeds of the report are those "
               "at the dish's centre. Missing where the case names none.");
  v.number("height", mast.height, metre, "Above ground.", positive);
  v.number("dish_height", mast.dish_height, metre, "Of the dish's centre, above ground.", positive);
  v.number("shear_exponent", mast.shear_exponent, key_units::ratio,
           "Of the power law between the two.", {.minimum = 0.0, .finite = true});
  v.number("speed_ratio", mast.speed_ratio, key_units::ratio,
           "Mean speed at the dish's centre over that at the mast.", positive);
}

}  // namespace boresight::io
