#include <set>

#include <boresight/app/io/case_sections.hpp>

namespace boresight::app {
namespace {

// Both of two keys, or neither. @throws InvalidInput at the one that is missing
void need_together(const TableReader& table, const char* one, const char* other) {
  if (table.has(one) == table.has(other)) return;
  table.refuse(table.has(one) ? other : one, std::string("expected ") + one + " and " + other +
                                                 " together, found " +
                                                 (table.has(one) ? one : other) + " alone");
}

void read_tachometer(TableReader& table, Case& antenna) {
  RecordedTachometerEntry entry;
  entry.voltage = table.optional_quantity("voltage", Kind::voltage, Range::positive());
  entry.shaft_speed = table.optional_quantity("shaft_speed", Kind::angular_rate, Range::positive());
  entry.motor_teeth = table.optional_quantity("motor_teeth", Kind::number, Range::positive());
  entry.tachometer_teeth =
      table.optional_quantity("tachometer_teeth", Kind::number, Range::positive());
  entry.recorder_limit = table.optional_quantity(
      "recorder_limit", entry.voltage ? Kind::voltage : Kind::angular_rate, Range::positive());
  entry.shaft = "tachometer";
  if (table.has("shaft") || table.optional_text("shaft")) {
    entry.shaft = table.choice("shaft", {"tachometer", "motor", "antenna"});
  }
  table.finish();
  need_together(table, "voltage", "shaft_speed");
  need_together(table, "motor_teeth", "tachometer_teeth");
  if (entry.shaft == "tachometer" && !entry.motor_teeth) {
    table.refuse("motor_teeth",
                 "expected motor_teeth and tachometer_teeth, or another shaft than 'tachometer', "
                 "found neither");
  }
  if (entry.shaft != "tachometer" && entry.motor_teeth) {
    table.refuse("motor_teeth",
                 "expected no motor_teeth beside shaft, which says what turns, found them");
  }
  if (entry.voltage && entry.shaft_speed && entry.motor_teeth && entry.tachometer_teeth &&
      entry.recorder_limit) {
    antenna.tachometer = {*entry.voltage, *entry.shaft_speed, *entry.motor_teeth,
                          *entry.tachometer_teeth, *entry.recorder_limit};
  }
  antenna.campaign.tachometer = std::move(entry);
}

}  // namespace

void read_oil(TableReader& file, Case& antenna) {
  TableReader table = file.table("oil");
  OilEntry& oil = antenna.oil;
  oil.density = table.quantity("density", Kind::density, Range::between(500.0, 2000.0));
  oil.bulk_modulus =
      table.optional_quantity("bulk_modulus", Kind::pressure, Range::between(1e7, 1e10));
  oil.volume_1 = table.quantity("volume_1", Kind::volume, Range::positive(100.0));
  oil.volume_2 = table.quantity("volume_2", Kind::volume, Range::positive(100.0));
  oil.efficiency_in_stiffness = table.optional_boolean("efficiency_in_stiffness").value_or(true);
  std::set<std::string> names;
  for (auto& entry : table.tables("line")) {
    const std::string name = read_name(entry, names);
    const Quantity length = entry.quantity("length", Kind::length, Range::positive(1000.0));
    const auto slosh_frequency =
        entry.optional_quantity("slosh_frequency", Kind::frequency, Range::positive(10000.0));
    entry.finish();
    antenna.campaign.lines.push_back({name, length});
    if (slosh_frequency) oil.lines.push_back({name, length, *slosh_frequency});
  }
  table.finish();
  if (!oil.bulk_modulus && oil.lines.empty()) {
    table.refuse("bulk_modulus",
                 "expected a bulk modulus, or lines with slosh frequencies, found neither");
  }
}

void read_tests(TableReader& file, Case& antenna) {
  if (auto table = file.optional_table("resonance")) {
    antenna.resonance_frequency =
        table->quantity("frequency", Kind::frequency, Range::positive(1000.0));
    table->finish();
  }
  if (auto table = file.optional_table("tachometer")) read_tachometer(*table, antenna);
  if (auto table = file.optional_table("friction_tests")) {
    FrictionTestsEntry& tests = antenna.friction_tests;
    const Range torque = Range::positive();
    tests.constant_speed_coulomb =
        table->optional_quantity("constant_speed_coulomb", Kind::torque, torque);
    tests.constant_speed_slope =
        table->optional_quantity("constant_speed_slope", Kind::viscous_friction);
    tests.slow_ramp_up = table->optional_quantity("slow_ramp_up", Kind::torque, torque);
    tests.slow_ramp_down = table->optional_quantity("slow_ramp_down", Kind::torque, torque);
    table->finish();
  }
  std::set<std::string> names;
  for (auto& entry : file.tables("impulse")) {
    ImpulseResult result;
    result.name = read_name(entry, names);
    result.friction = entry.choice("friction", {"constant_speed", "slow_ramp"});
    result.reflected_inertia =
        entry.quantity("reflected_inertia", Kind::inertia, Range::positive());
    entry.finish();
    antenna.impulse_results.push_back(std::move(result));
  }
}

void read_drive(TableReader& file, Case& antenna) {
  TableReader table = file.table("drive");
  DriveEntry& drive = antenna.drive;
  drive.leakage_rate = table.quantity("leakage_rate", Kind::rate_constant, Range::positive(1000.0));
  drive.viscous_friction =
      table.quantity("viscous_friction", Kind::viscous_friction, Range::not_negative());
  drive.valve_frequency =
      table.quantity("valve_frequency", Kind::frequency, Range::positive(10000.0));
  drive.valve_damping = table.quantity("valve_damping", Kind::number, Range::positive(10.0));
  drive.supply_pressure =
      table.quantity("supply_pressure", Kind::pressure, Range::between(1e4, 1e9));
  antenna.campaign.return_pressure =
      table.optional_quantity("return_pressure", Kind::pressure, Range::not_negative(1e8));
  drive.slew_rate = table.quantity("slew_rate", Kind::angular_rate, Range::positive(10.0));
  drive.tracking_rate = table.quantity("tracking_rate", Kind::angular_rate, Range::positive(1.0));
  table.finish();

  TableReader curve = file.table("friction_curve");
  FrictionCurveEntry& friction = antenna.friction_curve;
  friction.coulomb = curve.quantity("coulomb", Kind::torque, Range::not_negative());
  friction.breakaway = curve.quantity("breakaway", Kind::torque, Range::not_negative());
  friction.stribeck_rate = curve.quantity("stribeck_rate", Kind::angular_rate, Range::positive());
  friction.saturating = curve.quantity("saturating", Kind::torque, Range::not_negative());
  friction.saturating_rate =
      curve.quantity("saturating_rate", Kind::angular_rate, Range::positive());
  friction.viscous = curve.quantity("viscous", Kind::viscous_friction, Range::not_negative());
  curve.finish();
  if (friction.breakaway.value < friction.coulomb.value) {
    curve.refuse("breakaway", "expected at least the Coulomb torque, found less");
  }
}

void read_sensors(TableReader& file, Case& antenna) {
  TableReader table = file.table("sensors");
  SensorsEntry& sensors = antenna.sensors;
  sensors.encoder_noise = table.quantity("encoder_noise", Kind::angle, Range::not_negative(0.1));
  sensors.tachometer_noise =
      table.quantity("tachometer_noise", Kind::angular_rate, Range::not_negative());
  sensors.torque_noise =
      table.optional_quantity("torque_noise", Kind::torque, Range::not_negative());
  sensors.noise_bandwidth =
      table.quantity("noise_bandwidth", Kind::frequency, Range::positive(1e6));
  sensors.tachometer_frequency =
      table.quantity("tachometer_frequency", Kind::frequency, Range::positive(1e6));
  table.finish();

  TableReader controller = file.table("controller");
  antenna.controller_delay = controller.quantity("delay", Kind::time, Range::positive(10.0));
  controller.finish();
}

}  // namespace boresight::app
