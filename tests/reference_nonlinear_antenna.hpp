#pragma once

#include "reference_antenna.hpp"
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

/// The 70-m antenna with what its paper leaves open assumed (physics of the reference antenna,
/// section 2): friction, lines between the shortest and the longest of the paper.
namespace boresight::reference {

inline plant::DriveDetails drive_details() {
  plant::DriveDetails details;
  details.supply_pressure = 2000 * 6894.757293168;
  details.stroke_limit = 150.0;
  details.friction = {{10.33, 16.83, 0.15, 63.29, 1.5, 2.075}, 2500.0, 5.0, 0.01};
  details.oil_density = 850.0;
  details.line_lengths = {13.11, 13.87, 14.73, 15.60};
  details.line_damping_ratio = 0.01;
  details.offset.gear_ratio = gear_ratio();
  return details;
}

inline plant::NonlinearAntenna nonlinear_antenna(
    const plant::DriveDetails& details = drive_details()) {
  return plant::make_nonlinear_antenna(antenna(), hydraulic_drive(), details);
}

/// Nothing that dissipates: valve closed, no leakage, no friction, no damping.
inline plant::NonlinearAntenna lossless_antenna(plant::DriveDetails details = drive_details()) {
  details.friction = {{}, 0.0, 0.0, 0.01};
  details.friction.curve.stribeck_rate = details.friction.curve.saturating_rate = 1.0;
  details.line_damping_ratio = 0.0;
  auto linear = antenna();
  linear.drive.leakage_rate = 0.0;
  linear.structure.gear_damping = 0.0;
  for (auto& mode : linear.structure.modes) mode.damping = 0.0;
  return plant::make_nonlinear_antenna(linear, hydraulic_drive(), details);
}

}  // namespace boresight::reference
