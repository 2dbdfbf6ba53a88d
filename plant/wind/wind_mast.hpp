#pragma once

namespace boresight::plant {

/// The mast that measured mean speeds are from. They grow with the height above ground as
/// height^shear_exponent; computations use them at the height of the dish's centre.
struct WindMast {
  double height = 0.0;       // m
  double dish_height = 0.0;  // m
  double shear_exponent = 0.0;
  double speed_ratio = 1.0;  // mean speed at the dish's centre over that at the mast
};

}  // namespace boresight::plant
