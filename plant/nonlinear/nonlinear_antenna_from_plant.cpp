#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::plant {
namespace {

constexpr double atmosphere = 101325.0;  // Pa

OilCircuit make_oil(const Drive& linear, const HydraulicDrive& drive, const DriveDetails& details) {
  const double torque = torque_per_pressure(drive);
  const double stiffness = linear.oil_stiffness;
  OilCircuit oil;
  oil.stiffness_1 = stiffness * drive.volume_2 / (drive.volume_1 + drive.volume_2);
  oil.stiffness_2 = stiffness * drive.volume_1 / (drive.volume_1 + drive.volume_2);
  // A flow between the sides works on both stiffnesses, one out of a side on that side's half.
  const double null = details.null_leakage_share;
  const double case_fraction = details.case_leakage_share;
  oil.cross_leakage = linear.leakage_rate * std::max(0.0, 1.0 - null - case_fraction) / stiffness;
  oil.null_leakage = linear.leakage_rate * null / stiffness;
  oil.case_leakage = 2.0 * linear.leakage_rate * case_fraction / stiffness;
  oil.supply_torque = details.supply_pressure * torque;
  oil.return_torque = details.return_pressure * torque;
  oil.supply_droop = details.supply_droop * torque;
  oil.laminar_torque = details.laminar_pressure * torque;
  oil.makeup_torque = details.makeup_pressure * torque;
  oil.makeup_conductance = 2.0 * details.makeup_rate / stiffness;
  oil.air_fraction = details.air_fraction;
  oil.bulk_modulus_torque = drive.bulk_modulus * torque;
  oil.atmosphere_torque = atmosphere * torque;
  oil.torque_per_pressure = torque;
  for (const double length : details.line_lengths) {
    oil.lines.push_back({length, slosh_frequency(length, drive.bulk_modulus, details.oil_density),
                         details.line_damping_ratio});
  }
  oil.modes_per_line = details.modes_per_line;
  return oil;
}

}  // namespace

NonlinearAntenna make_nonlinear_antenna(const AntennaPlant& plant, const HydraulicDrive& drive,
                                        const DriveDetails& details) {
  const double null = details.null_leakage_share;
  const double case_fraction = details.case_leakage_share;
  if (std::isnan(null + case_fraction) || null < 0.0 || case_fraction < 0.0 ||
      null + case_fraction > 1.0) {
    throw InvalidInput(fmt::format(
        "make_nonlinear_antenna: expected leakage fractions of at least 0 that sum to at "
        "most 1, found "
        "{} through the valve and {} to the case",
        null, case_fraction));
  }
  NonlinearAntenna antenna;
  antenna.valve = {plant.drive.valve_corner, plant.drive.valve_damping, details.stroke_limit,
                   details.slew_limit,       details.overlap,           details.null_offset};
  antenna.oil = make_oil(plant.drive, drive, details);
  antenna.friction = details.friction;
  antenna.offset = details.offset;
  antenna.gear = {plant.structure.gear_stiffness, plant.structure.gear_damping,
                  details.preload_torque, details.backlash};
  antenna.motor_inertia = plant.drive.motor_inertia;
  antenna.tachometer_corner = plant.drive.tachometer_corner;
  antenna.structure = plant.structure;
  return antenna;
}

}  // namespace boresight::plant
