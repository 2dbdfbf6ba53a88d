#pragma once

#include <boresight/design/simulation/drive_tests.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::reference {

/// The demo antenna with a usual recorder: 200 samples a second, tachometer of 157 V at 600 rpm
/// behind gears of 130 and 23 teeth, transducers of 3000 psi.
inline design::TestedDrive tested_drive() {
  constexpr double psi = 6894.757293168361;  // Pa
  const plant::Antenna antenna = plant::demo_antenna();
  design::TestedDrive drive;
  drive.antenna = plant::nonlinear_antenna(antenna);
  drive.slew_rate = plant::sky_to_motor(antenna, antenna.drive.slew_rate);
  drive.rate_loop = {1.0, 0.3};
  drive.recorder.sample_rate = 200.0;
  drive.recorder.pressure = {0.007, 3.0 * psi, 0.8 * psi, 0.05 * psi, 3000.0 * psi};
  drive.recorder.tachometer = {10.0 * two_pi / 157.0 * 130.0 / 23.0, 10.0, 0.003, 8e-3, 5e-3};
  return drive;
}

}  // namespace boresight::reference
