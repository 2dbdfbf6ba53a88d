#include <boresight/app/evaluate/changeable_numbers.hpp>

namespace boresight::app {

const std::vector<ChangeableNumber>& changeable_numbers() {
  const io::Range positive = io::Range::positive();
  const io::Range not_negative = io::Range::not_negative();
  static const std::vector<ChangeableNumber> numbers{
      {"antenna", "inertia", io::Kind::inertia, positive,
       [](io::Case& c) { return &c.antenna.inertia; }},
      {"motor", "inertia", io::Kind::inertia, positive,
       [](io::Case& c) { return &c.motor.inertia; }},
      {"motor", "rotor_inertia", io::Kind::inertia, positive,
       [](io::Case& c) { return &c.motor.rotor_inertia; }},
      {"motor", "disk_inertia", io::Kind::inertia, positive,
       [](io::Case& c) { return &c.motor.disk_inertia; }},
      {"motor", "displacement", io::Kind::displacement, io::Range::positive(1.0),
       [](io::Case& c) { return &c.motor.displacement; }},
      {"oil", "density", io::Kind::density, io::Range::between(500.0, 2000.0),
       [](io::Case& c) { return c.oil.density ? &*c.oil.density : nullptr; }},
      {"oil", "volume_1", io::Kind::volume, io::Range::positive(100.0),
       [](io::Case& c) { return &c.oil.volume_1; }},
      {"oil", "volume_2", io::Kind::volume, io::Range::positive(100.0),
       [](io::Case& c) { return &c.oil.volume_2; }},
      {"drive", "leakage_rate", io::Kind::rate_constant, io::Range::positive(1000.0),
       [](io::Case& c) { return &c.drive.leakage_rate; }},
      {"drive", "viscous_friction", io::Kind::viscous_friction, not_negative,
       [](io::Case& c) { return &c.drive.viscous_friction; }},
      {"drive", "valve_frequency", io::Kind::frequency, io::Range::positive(10000.0),
       [](io::Case& c) { return &c.drive.valve_frequency; }},
      {"drive", "valve_damping", io::Kind::number, io::Range::positive(10.0),
       [](io::Case& c) { return &c.drive.valve_damping; }},
      {"drive", "valve_rated_flow", io::Kind::flow, io::Range::positive(10.0),
       [](io::Case& c) { return c.drive.valve_rated_flow ? &*c.drive.valve_rated_flow : nullptr; }},
      {"drive", "supply_pressure", io::Kind::pressure, io::Range::between(1e4, 1e9),
       [](io::Case& c) { return &c.drive.supply_pressure; }},
      {"drive", "slew_rate", io::Kind::angular_rate, io::Range::positive(10.0),
       [](io::Case& c) { return &c.drive.slew_rate; }},
      {"simulation", "valve_stroke", io::Kind::angular_rate, positive,
       [](io::Case& c) { return c.simulation ? &c.simulation->valve_stroke : nullptr; }},
      {"friction_curve", "coulomb", io::Kind::torque, not_negative,
       [](io::Case& c) { return &c.friction_curve.coulomb; }},
      {"friction_curve", "breakaway", io::Kind::torque, not_negative,
       [](io::Case& c) { return &c.friction_curve.breakaway; }},
      {"friction_curve", "saturating", io::Kind::torque, not_negative,
       [](io::Case& c) { return &c.friction_curve.saturating; }},
      {"friction_curve", "viscous", io::Kind::viscous_friction, not_negative,
       [](io::Case& c) { return &c.friction_curve.viscous; }},
      {"structure", "locked_rotor_frequency", io::Kind::frequency, io::Range::positive(1000.0),
       [](io::Case& c) { return &c.structure.locked_rotor_frequency; }},
      {"structure", "gear_damping_ratio", io::Kind::number, io::Range::between(0.0, 1.0),
       [](io::Case& c) { return &c.structure.gear_damping_ratio; }},
      {"sensors", "encoder_noise", io::Kind::angle, io::Range::not_negative(0.1),
       [](io::Case& c) { return &c.sensors.encoder_noise; }},
      {"sensors", "tachometer_noise", io::Kind::angular_rate, not_negative,
       [](io::Case& c) { return &c.sensors.tachometer_noise; }},
      {"sensors", "torque_noise", io::Kind::torque, not_negative,
       [](io::Case& c) { return c.sensors.torque_noise ? &*c.sensors.torque_noise : nullptr; }},
      {"sensors", "noise_bandwidth", io::Kind::frequency, io::Range::positive(1e6),
       [](io::Case& c) { return &c.sensors.noise_bandwidth; }},
      {"sensors", "tachometer_frequency", io::Kind::frequency, io::Range::positive(1e6),
       [](io::Case& c) { return &c.sensors.tachometer_frequency; }},
      {"controller", "delay", io::Kind::time, io::Range::positive(10.0),
       [](io::Case& c) { return &c.controller_delay; }},
  };
  return numbers;
}

}  // namespace boresight::app
