#include <cmath>
#include <set>

#include <fmt/format.h>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

// Both of two keys, or neither. @throws InvalidInput at the one that is missing
void need_together(const TableReader& table, const char* one, const char* other) {
  if (table.has(one) == table.has(other)) return;
  table.refuse(table.has(one) ? other : one, std::string("expected ") + one + " and " + other +
                                                 " together, found " +
                                                 (table.has(one) ? one : other) + " alone");
}

// A first guess of the tachometer's noise (rms) over the motors' rate at slew.
constexpr double usual_tachometer_noise = 0.02 / 125.0;

// Rms of the encoder, stated or of the rounding to its steps.
void read_encoder(TableReader& table, SensorsEntry& sensors) {
  const auto noise =
      table.optional_quantity("encoder_noise", Kind::angle, Range::not_negative(0.1));
  const auto bits = table.optional_integer("encoder_bits", 4, 40);
  if (noise && bits) {
    table.refuse("encoder_bits", "expected either encoder_noise or encoder_bits, found both");
  }
  if (noise) sensors.encoder_noise = *noise;
  if (bits) {
    const double step = two_pi * std::ldexp(1.0, -static_cast<int>(*bits));
    sensors.encoder_noise =
        table.assume("encoder_bits", Kind::angle, step / std::sqrt(12.0),
                     fmt::format("rounding to steps of 1/2^{} of a turn, no other noise", *bits));
  }
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
  antenna.campaign->tachometer = std::move(entry);
}

// beta (1/V1 + 1/V2) flow/pressure, with its uncertainty to first order.
Quantity leakage_rate_by_flow(const OilEntry& oil, const Quantity& flow, const Quantity& pressure) {
  const Quantity modulus = bulk_modulus_of(oil);
  const double sides = 1.0 / oil.volume_1.value + 1.0 / oil.volume_2.value;
  const double of_sides = std::hypot(relative_uncertainty(oil.volume_1) / oil.volume_1.value,
                                     relative_uncertainty(oil.volume_2) / oil.volume_2.value) /
                          sides;
  Quantity rate = derived_quantity(flow, Kind::rate_constant,
                                   modulus.value * sides * flow.value / pressure.value, "1/s");
  rate.standard_uncertainty = rate.value * std::hypot(std::hypot(relative_uncertainty(flow),
                                                                 relative_uncertainty(pressure)),
                                                      relative_uncertainty(modulus), of_sides);
  if (pressure.basis == Basis::assumed) rate.basis = Basis::assumed;
  return rate;
}

void check_drive(const TableReader& table, const Case& antenna) {
  need_together(table, "valve_rated_flow", "valve_rated_pressure_drop");
  const auto& back = antenna.campaign->return_pressure;
  if (back && back->value >= antenna.drive->supply_pressure.value) {
    table.refuse("return_pressure",
                 "expected a pressure below supply_pressure, found one that is not");
  }
}

}  // namespace

void read_oil(TableReader& file, Case& antenna) {
  TableReader table = file.table("oil");
  OilEntry& oil = *antenna.oil;
  oil.density = table.optional_quantity("density", Kind::density, Range::between(500.0, 2000.0));
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
    antenna.campaign->lines.push_back({name, length});
    if (slosh_frequency) oil.lines.push_back({name, length, *slosh_frequency});
  }
  table.finish();
  if (!oil.bulk_modulus && oil.lines.empty()) {
    table.refuse("bulk_modulus",
                 "expected a bulk modulus, or lines with slosh frequencies, found neither");
  }
  if (!oil.density && !antenna.campaign->lines.empty()) {
    table.refuse("density",
                 "expected a density of the oil for the pressure waves in its lines, found none");
  }
}

void read_tests(TableReader& file, Case& antenna) {
  if (auto table = file.optional_table("resonance")) {
    antenna.resonance->frequency =
        table->quantity("frequency", Kind::frequency, Range::positive(1000.0));
    antenna.resonance->damping =
        table->optional_quantity("damping_ratio", Kind::number, Range::positive(1.0));
    if (table->optional_text("mode")) {
      antenna.resonance->of_oil = table->choice("mode", {"lowest", "oil"}) == "oil";
    }
    table->finish();
  }
  if (auto table = file.optional_table("tachometer")) read_tachometer(*table, antenna);
  if (auto table = file.optional_table("friction_tests")) {
    FrictionTestsEntry& tests = *antenna.friction_tests;
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
  DriveEntry& drive = *antenna.drive;
  const Range decay = Range::positive(1000.0);
  const auto leakage_rate = table.optional_quantity("leakage_rate", Kind::rate_constant, decay);
  const auto leakage_flow =
      table.optional_quantity("leakage_flow", Kind::flow, Range::positive(10.0));
  const auto leakage_pressure =
      table.optional_quantity("leakage_pressure", Kind::pressure, Range::positive(1e9));
  const auto viscous_friction =
      table.optional_quantity("viscous_friction", Kind::viscous_friction, Range::not_negative());
  drive.valve_frequency =
      table.quantity("valve_frequency", Kind::frequency, Range::positive(10000.0));
  drive.valve_damping = table.quantity("valve_damping", Kind::number, Range::positive(10.0));
  drive.valve_rated_flow =
      table.optional_quantity("valve_rated_flow", Kind::flow, Range::positive(10.0));
  drive.valve_rated_pressure_drop =
      table.optional_quantity("valve_rated_pressure_drop", Kind::pressure, Range::positive(1e9));
  drive.supply_pressure =
      table.quantity("supply_pressure", Kind::pressure, Range::between(1e4, 1e9));
  antenna.campaign->return_pressure =
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
    drive.leakage_rate = leakage_rate_by_flow(*antenna.oil, *leakage_flow, *leakage_pressure);
    drive.leakage_by_flow = true;
    if (drive.leakage_rate.value > decay.maximum) {
      table.refuse("leakage_flow", fmt::format("expected a leakage rate of at most {:g} 1/s, found "
                                               "one of {} by the oil's bulk modulus and volumes",
                                               decay.maximum, drive.leakage_rate.text));
    }
  }
  check_drive(table, antenna);

  read_friction_curve(file, antenna);
  drive.viscous_friction =
      viscous_friction
          ? *viscous_friction
          : table.assume("viscous_friction", Kind::viscous_friction, tracking_friction(antenna),
                         "the friction curve's slope at the tracking rate, 0 at least");
}

void read_sensors(TableReader& file, Case& antenna) {
  TableReader table = file.table("sensors");
  SensorsEntry& sensors = *antenna.sensors;
  read_encoder(table, sensors);
  const double slew = antenna.drive->slew_rate.value * gear_ratio(antenna);
  sensors.tachometer_noise = table.quantity_or(
      "tachometer_noise", Kind::angular_rate, Range::not_negative(), usual_tachometer_noise * slew,
      "usual: 0.02 rad/s with motors that turn at 125 rad/s at slew");
  sensors.torque_noise =
      table.optional_quantity("torque_noise", Kind::torque, Range::not_negative());
  sensors.noise_bandwidth =
      table.quantity("noise_bandwidth", Kind::frequency, Range::positive(1e6));
  sensors.tachometer_frequency =
      table.quantity_or("tachometer_frequency", Kind::frequency, Range::positive(1e6),
                        10.0 * antenna.structure->locked_rotor_frequency.value,
                        "usual: ten times the locked-rotor frequency");
  table.finish();
  if (sensors.encoder_noise.key.empty()) {
    table.refuse("encoder_noise", "expected either encoder_noise or encoder_bits, found neither");
  }

  TableReader controller = file.table("controller");
  antenna.controller->delay = controller.quantity("delay", Kind::time, Range::positive(10.0));
  controller.finish();
}

}  // namespace boresight::io
