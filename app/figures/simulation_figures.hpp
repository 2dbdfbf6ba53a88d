#pragma once

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/simulated_tests.hpp>

namespace boresight::app {

/// A drive test as its recorder would show it: tachometer with rate command, the first motor's port
/// pressures, torque of all motors from them, valve command; first starts of sliding and clipped
/// channels marked. `torque_per_pressure`: N m per Pa of every motor's pressure difference.
/// To be made while the record still has its channels.
Figure drive_test_figure(const DriveTestSection& record, double torque_per_pressure);

/// A run of the position loop: encoder and boresight errors with the limit of a slew, motor torque
/// with the wind torque, motor rate, valve command.
Figure position_test_figure(const PositionTestSection& record);

}  // namespace boresight::app
