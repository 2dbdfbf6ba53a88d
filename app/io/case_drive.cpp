#include <cmath>
#include <set>

#include <fmt/format.h>

#include <boresight/app/io/case_sections.hpp>
#include <boresight/plant/hydraulics.hpp>

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

double relative(const Quantity& quantity) {
  return quantity.standard_uncertainty / quantity.value;
}

struct Estimate {
  double value = 0.0;
  double relative_uncertainty = 0.0;
};

// As stated, else the mean over the lines, which have the density in common (Pa).
Estimate bulk_modulus_of(const OilEntry& oil) {
  if (oil.bulk_modulus) return {oil.bulk_modulus->value, relative(*oil.bulk_modulus)};
  double sum = 0.0;
  double variance = 0.0;
  for (const OilLine& line : oil.lines) {
    const double modulus = plant::bulk_modulus_from_slosh(
        line.length.value, line.slosh_frequency.value, oil.density.value);
    sum += modulus;
    variance += std::pow(
        2.0 * modulus * std::hypot(relative(line.length), relative(line.slosh_frequency)), 2);
  }
  return {sum / static_cast<double>(oil.lines.size()),
          std::hypot(std::sqrt(variance) / sum, relative(oil.density))};
}

// beta (1/V1 + 1/V2) flow/pressure, with its uncertainty to first order.
Quantity leakage_rate_by_flow(const OilEntry& oil, const Quantity& flow, const Quantity& pressure) {
  const Estimate modulus = bulk_modulus_of(oil);
  const double sides = 1.0 / oil.volume_1.value + 1.0 / oil.volume_2.value;
  const double of_sides = std::hypot(relative(oil.volume_1) / oil.volume_1.value,
                                     relative(oil.volume_2) / oil.volume_2.value) /
                          sides;
  Quantity rate = flow;
  rate.also.clear();
  rate.kind = Kind::rate_constant;
  rate.value = modulus.value * sides * flow.value / pressure.value;
  rate.standard_uncertainty =
      rate.value * std::hypot(std::hypot(relative(flow), relative(pressure)),
                              modulus.relative_uncertainty, of_sides);
  rate.half_unit = 0.0;
  rate.text = fmt::format("{:.4g} 1/s", rate.value);
  if (pressure.basis == Basis::assumed) rate.basis = Basis::assumed;
  return rate;
}

void check_drive(const TableReader& table, const Case& antenna) {
  need_together(table, "valve_rated_flow", "valve_rated_pressure_drop");
  const auto& back = antenna.campaign.return_pressure;
  if (back && back->value >= antenna.drive.supply_pressure.value) {
    table.refuse("return_pressure",
                 "expected a pressure below supply_pressure, found one that is not");
  }
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
  const Range decay = Range::positive(1000.0);
  const auto leakage_rate = table.optional_quantity("leakage_rate", Kind::rate_constant, decay);
  const auto leakage_flow =
      table.optional_quantity("leakage_flow", Kind::flow, Range::positive(10.0));
  const auto leakage_pressure =
      table.optional_quantity("leakage_pressure", Kind::pressure, Range::positive(1e9));
  drive.viscous_friction =
      table.quantity("viscous_friction", Kind::viscous_friction, Range::not_negative());
  drive.valve_frequency =
      table.quantity("valve_frequency", Kind::frequency, Range::positive(10000.0));
  drive.valve_damping = table.quantity("valve_damping", Kind::number, Range::positive(10.0));
  drive.valve_rated_flow =
      table.optional_quantity("valve_rated_flow", Kind::flow, Range::positive(10.0));
  drive.valve_rated_pressure_drop =
      table.optional_quantity("valve_rated_pressure_drop", Kind::pressure, Range::positive(1e9));
  drive.supply_pressure =
      table.quantity("supply_pressure", Kind::pressure, Range::between(1e4, 1e9));
  antenna.campaign.return_pressure =
      table.optional_quantity("return_pressure", Kind::pressure, Range::not_negative(1e8));
  drive.slew_rate = table.quantity("slew_rate", Kind::angular_rate, Range::positive(10.0));
  drive.tracking_rate = table.quantity("tracking_rate", Kind::angular_rate, Range::positive(1.0));
  table.finish();
  need_together(table, "leakage_flow", "leakage_pressure");
  if (leakage_rate.has_value() == leakage_flow.has_value()) {
    table.refuse("leakage_rate",
                 std::string("expected either leakage_rate, or leakage_flow with leakage_pressure, "
                             "found ") +
                     (leakage_rate ? "both" : "neither"));
  }
  if (leakage_rate) drive.leakage_rate = *leakage_rate;
  if (leakage_flow && leakage_pressure) {
    drive.leakage_rate = leakage_rate_by_flow(antenna.oil, *leakage_flow, *leakage_pressure);
    if (drive.leakage_rate.value > decay.maximum) {
      table.refuse("leakage_flow", fmt::format("expected a leakage rate of at most {:g} 1/s, found "
                                               "one of {} by the oil's bulk modulus and volumes",
                                               decay.maximum, drive.leakage_rate.text));
    }
  }
  check_drive(table, antenna);

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
