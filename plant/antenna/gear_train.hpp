#pragma once

#include <vector>

namespace boresight::plant {

/// One reduction: the driven gear turns driving/driven times as fast as the pinion.
struct GearStage {
  double driven_teeth = 1.0;
  double driving_teeth = 1.0;
};

/// Moment of inertia of a solid disk or shaft about its axis, J = 1/2 rho pi R^4 H (kg m2), with
/// radius R (m), length H (m) and density rho (kg/m3): Sommerville eqs. 4-6. A gear is taken as
/// a full disk to its outer radius, which overestimates it: teeth and web holes are cut out.
/// @throws InvalidInput unless all three are positive and finite.
double disk_inertia(double radius, double length, double density);

/// Motor revolutions per revolution of the shaft behind the first `stage_count` reductions,
/// the product of driven/driving teeth. Zero stages give 1.
/// @throws InvalidInput for a tooth count that is not positive, or more stages than there are.
double gear_ratio(const std::vector<GearStage>& stages, std::size_t stage_count);

/// The ratio of the whole train.
double gear_ratio(const std::vector<GearStage>& stages);

/// Inertia felt at the motor shaft of `count` equal bodies (kg m2) that turn `ratio` times slower:
/// count J / ratio^2 (one term of Sommerville eq. 3 with the multiplicity of its Tables 2 and 3).
double reflected_inertia(double inertia, double ratio, double count = 1.0);

/// Motor-to-load inertia ratio R = Jm / (J - Jm) of Sommerville eq. 27, from the motor inertia Jm
/// and the whole reflected inertia J (both of all motors, kg m2). Infinite at J = Jm; negative
/// where J < Jm, which no real load gives. See load_to_motor_ratio for a quantity without a pole.
double motor_to_load_ratio(double motor_inertia, double reflected_inertia);

/// (J - Jm) / Jm, the inverse of the motor-to-load ratio: finite everywhere and monotone in J, the
/// right quantity to put an interval on.
double load_to_motor_ratio(double motor_inertia, double reflected_inertia);

}  // namespace boresight::plant
