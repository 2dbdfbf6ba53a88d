#pragma once

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::plant {

/// The response of the same plant with another motor inertia, from that with the drive's own: no
/// structure is needed, so that a measured response will do.
///
/// A change of inertia d adds d s^2 to one place on the diagonal of the dynamic stiffness D, so
/// that
///   1/(D + d s^2 e e') = 1/D - (d s^2/(1 + d s^2 h)) (1/D) e e' (1/D),   h = e' (1/D) e,
/// (J. Sherman, W. J. Morrison, Annals of Mathematical Statistics 21, 1950, p. 124); h, the motor's
/// angle per torque on the motor, follows from the tachometer's response to the valve. Oil, valve
/// and tachometer are the drive's, and must be those of the response. Relative accuracy 1e-10 for
/// factors of 0.01 to 100 on the inertia; O(1) a frequency, whatever the number of modes.
///
/// `motor_inertia`: the new one, kg m2, as Drive::motor_inertia; `frequency`: rad/s, above 0.
/// @throws InvalidInput for an inertia that is not positive and finite.
ResponsePoint with_motor_inertia(const ResponsePoint& response, const Drive& drive,
                                 double motor_inertia, double frequency);
/// The same on a grid.
PlantResponse with_motor_inertia(PlantResponse response, const Drive& drive, double motor_inertia);

}  // namespace boresight::plant
