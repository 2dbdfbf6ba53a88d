#pragma once

#include <boresight/plant/antenna/antenna.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::plant {

/// The torque of gravity about the axis that the motors hold; none without Antenna::nonlinear.
OffsetTorque offset_torque(const Antenna& antenna);

/// The nonlinear antenna whose small motion is that of linear_plant(antenna); see
/// make_nonlinear_antenna(AntennaPlant, HydraulicDrive, DriveDetails).
/// @throws InvalidInput without Antenna::nonlinear, and as linear_plant and make_nonlinear_antenna.
NonlinearAntenna nonlinear_antenna(const Antenna& antenna);

}  // namespace boresight::plant
