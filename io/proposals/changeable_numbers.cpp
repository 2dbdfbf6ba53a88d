#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/proposals/changeable_numbers.hpp>

namespace boresight::io {

const std::vector<ChangeableNumber>& changeable_numbers() {
  const Range positive = Range::positive();
  const Range not_negative = Range::not_negative();
  static const std::vector<ChangeableNumber> numbers{
      {"antenna", "inertia", Kind::inertia, positive, [](Case& c) { return &c.antenna->inertia; }},
      {"motor", "inertia", Kind::inertia, positive, [](Case& c) { return &c.motor->inertia; }},
      {"motor", "rotor_inertia", Kind::inertia, positive,
       [](Case& c) { return &c.motor->rotor_inertia; }},
      {"motor", "disk_inertia", Kind::inertia, positive,
       [](Case& c) { return &c.motor->disk_inertia; }},
      {"motor", "displacement", Kind::displacement, Range::positive(1.0),
       [](Case& c) { return &c.motor->displacement; }},
      {"oil", "density", Kind::density, Range::between(500.0, 2000.0),
       [](Case& c) { return c.oil->density ? &*c.oil->density : nullptr; }},
      {"oil", "volume_1", Kind::volume, Range::positive(100.0),
       [](Case& c) { return &c.oil->volume_1; }},
      {"oil", "volume_2", Kind::volume, Range::positive(100.0),
       [](Case& c) { return &c.oil->volume_2; }},
      {"drive", "leakage_rate", Kind::rate_constant, Range::positive(1000.0),
       [](Case& c) { return &c.drive->leakage_rate; }},
      {"drive", "viscous_friction", Kind::viscous_friction, not_negative,
       [](Case& c) { return &c.drive->viscous_friction; }},
      {"drive", "valve_frequency", Kind::frequency, Range::positive(10000.0),
       [](Case& c) { return &c.drive->valve_frequency; }},
      {"drive", "valve_damping", Kind::number, Range::positive(10.0),
       [](Case& c) { return &c.drive->valve_damping; }},
      {"drive", "valve_rated_flow", Kind::flow, Range::positive(10.0),
       [](Case& c) { return c.drive->valve_rated_flow ? &*c.drive->valve_rated_flow : nullptr; }},
      {"drive", "supply_pressure", Kind::pressure, Range::between(1e4, 1e9),
       [](Case& c) { return &c.drive->supply_pressure; }},
      {"drive", "slew_rate", Kind::angular_rate, Range::positive(10.0),
       [](Case& c) { return &c.drive->slew_rate; }},
      {"simulation", "valve_stroke", Kind::angular_rate, positive,
       [](Case& c) { return c.simulation ? &c.simulation->valve_stroke : nullptr; }},
      {"friction_curve", "coulomb", Kind::torque, not_negative,
       [](Case& c) { return &c.friction_curve->coulomb; }},
      {"friction_curve", "breakaway", Kind::torque, not_negative,
       [](Case& c) { return &c.friction_curve->breakaway; }},
      {"friction_curve", "saturating", Kind::torque, not_negative,
       [](Case& c) { return &c.friction_curve->saturating; }},
      {"friction_curve", "viscous", Kind::viscous_friction, not_negative,
       [](Case& c) { return &c.friction_curve->viscous; }},
      {"structure", "locked_rotor_frequency", Kind::frequency, Range::positive(1000.0),
       [](Case& c) { return &c.structure->locked_rotor_frequency; }},
      {"structure", "gear_damping_ratio", Kind::number, Range::between(0.0, 1.0),
       [](Case& c) { return &c.structure->gear_damping_ratio; }},
      {"sensors", "encoder_noise", Kind::angle, Range::not_negative(0.1),
       [](Case& c) { return &c.sensors->encoder_noise; }},
      {"sensors", "tachometer_noise", Kind::angular_rate, not_negative,
       [](Case& c) { return &c.sensors->tachometer_noise; }},
      {"sensors", "torque_noise", Kind::torque, not_negative,
       [](Case& c) { return c.sensors->torque_noise ? &*c.sensors->torque_noise : nullptr; }},
      {"sensors", "noise_bandwidth", Kind::frequency, Range::positive(1e6),
       [](Case& c) { return &c.sensors->noise_bandwidth; }},
      {"sensors", "tachometer_frequency", Kind::frequency, Range::positive(1e6),
       [](Case& c) { return &c.sensors->tachometer_frequency; }},
      {"controller", "delay", Kind::time, Range::positive(10.0),
       [](Case& c) { return &c.controller->delay; }},
  };
  return numbers;
}

}  // namespace boresight::io
