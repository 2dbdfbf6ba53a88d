#include <cmath>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::plant {

OffsetTorque offset_torque(const Antenna& antenna) {
  if (!antenna.nonlinear) return {};
  const NonlinearDrive& drive = *antenna.nonlinear;
  return {drive.offset_torque, drive.offset_cosine, drive.offset_sine, antenna.elevation,
          gear_ratio(antenna)};
}

NonlinearAntenna nonlinear_antenna(const Antenna& antenna) {
  if (!antenna.nonlinear) {
    throw InvalidInput(
        "nonlinear_antenna: expected the numbers that the linear plant leaves out "
        "(Antenna::nonlinear), found none");
  }
  const NonlinearDrive& drive = *antenna.nonlinear;
  DriveDetails details;
  details.supply_pressure = antenna.drive.supply_pressure;
  details.return_pressure = drive.return_pressure;
  details.null_leakage_share = drive.null_leakage_share;
  details.case_leakage_share = drive.case_leakage_share;
  details.stroke_limit = drive.valve_stroke;
  details.slew_limit = drive.valve_stroke / drive.valve_stroke_time;
  details.overlap = drive.valve_overlap * drive.valve_stroke;
  details.makeup_pressure = drive.makeup_pressure;
  details.air_fraction = drive.air_fraction;
  details.oil_density = drive.oil_density;
  details.line_lengths = drive.line_lengths;
  details.line_damping_ratio = drive.line_damping_ratio;
  details.friction = {antenna.friction_curve, drive.bristle_stiffness, drive.bristle_damping, 0.0};
  details.offset = offset_torque(antenna);
  if (std::isfinite(drive.backlash)) {
    details.backlash = drive.backlash;
    details.preload_torque = drive.preload_torque;
  }
  return make_nonlinear_antenna(linear_plant(antenna), antenna.hydraulics, details);
}

}  // namespace boresight::plant
