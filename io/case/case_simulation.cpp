#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::io {
namespace {

void read_valve_stroke(TableReader& table, const Case& antenna, SimulationEntry& entry) {
  const auto stated =
      table.optional_quantity("valve_stroke", Kind::angular_rate, Range::positive(1e5));
  const auto rated = rated_stroke(antenna, entry.return_pressure);
  entry.valve_stroke_stated = stated.has_value();
  if (stated) {
    entry.valve_stroke = *stated;
  } else if (rated) {
    entry.valve_stroke = *rated;
  } else {
    entry.valve_stroke = table.assume("valve_stroke", Kind::angular_rate,
                                      1.2 * antenna.drive->slew_rate.value * gear_ratio(antenna),
                                      "1.2 times the slew rate at the motor");
  }
}

SimulationEntry read_drive_details(TableReader& table, const Case& antenna) {
  SimulationEntry entry;
  const Range fraction = Range::between(0.0, 1.0);
  entry.return_pressure =
      table.quantity("return_pressure", Kind::pressure, Range::not_negative(1e8));
  entry.null_leakage_share = table.quantity("null_leakage_share", Kind::number, fraction);
  entry.case_leakage_share = table.quantity("case_leakage_share", Kind::number, fraction);
  read_valve_stroke(table, antenna, entry);
  entry.valve_stroke_time = table.quantity("valve_stroke_time", Kind::time, Range::positive(100.0));
  entry.valve_overlap = table.quantity("valve_overlap", Kind::number, Range::between(0.0, 0.5));
  entry.bristle_stiffness =
      table.quantity("bristle_stiffness", Kind::stiffness, Range::positive(1e12));
  entry.bristle_damping =
      table.quantity("bristle_damping", Kind::viscous_friction, Range::not_negative(1e9));
  entry.line_damping_ratio = table.quantity("line_damping_ratio", Kind::number, fraction);
  entry.makeup_pressure =
      table.quantity("makeup_pressure", Kind::pressure, Range::not_negative(1e8));
  entry.air_fraction = table.quantity("air_fraction", Kind::number, Range::between(0.0, 0.2));
  entry.offset_torque = table.quantity("offset_torque", Kind::torque);
  entry.offset_cosine = table.optional_quantity("offset_cosine", Kind::torque);
  entry.offset_sine = table.optional_quantity("offset_sine", Kind::torque);
  if ((entry.offset_cosine || entry.offset_sine) && !antenna.antenna->elevation) {
    table.refuse(entry.offset_cosine ? "offset_cosine" : "offset_sine",
                 "expected an antenna.elevation, at which tests begin, beside it, found none");
  }
  if ((entry.offset_cosine || entry.offset_sine) && antenna.axis != "elevation") {
    table.refuse(
        entry.offset_cosine ? "offset_cosine" : "offset_sine",
        "expected it for the elevation axis only, found it for the " + antenna.axis + " axis");
  }
  entry.preload_torque =
      table.quantity_or("preload_torque", Kind::torque, Range::positive(1e9),
                        0.1 * supply_torque(antenna), "a tenth of the supply torque");
  entry.backlash = table.optional_quantity("backlash", Kind::angle, Range::positive(1e3));
  entry.rate_loop_gain = table.quantity("rate_loop_gain", Kind::number, Range::positive(1e4));
  entry.rate_loop_corner =
      table.quantity("rate_loop_corner", Kind::frequency, Range::positive(1e4));
  if (entry.return_pressure.value >= antenna.drive->supply_pressure.value) {
    table.refuse("return_pressure",
                 "expected a pressure below drive.supply_pressure, found one that is not");
  }
  if (antenna.friction_curve->coulomb.value <= 0.0) {
    table.refuse("bristle_stiffness",
                 "expected a friction_curve.coulomb above 0 for the bristles to hold, found 0");
  }
  if (entry.null_leakage_share.value + entry.case_leakage_share.value > 1.0) {
    table.refuse(
        "case_leakage_share",
        "expected leakage fractions that sum to at most 1, found more (the rest flows across "
        "the motors)");
  }
  table.finish();
  return entry;
}

RecorderEntry read_recorder(TableReader& table) {
  RecorderEntry entry;
  const Range error = Range::not_negative(1e9);
  entry.sample_rate = table.quantity("sample_rate", Kind::frequency, Range::between(1.0, 1e5));
  entry.pressure_gain = table.quantity("pressure_gain", Kind::number, Range::not_negative(0.5));
  entry.pressure_zero = table.quantity("pressure_zero", Kind::pressure, error);
  entry.pressure_noise = table.quantity("pressure_noise", Kind::pressure, error);
  entry.pressure_resolution = table.quantity("pressure_resolution", Kind::pressure, error);
  entry.pressure_range = table.quantity("pressure_range", Kind::pressure, Range::positive(1e10));
  entry.tachometer_gain = table.quantity("tachometer_gain", Kind::number, Range::not_negative(0.5));
  entry.tachometer_noise = table.quantity("tachometer_noise", Kind::voltage, error);
  entry.tachometer_resolution = table.quantity("tachometer_resolution", Kind::voltage, error);
  entry.filter_order = table.optional_integer("filter_order", 1, 8).value_or(0);
  entry.filter_frequency =
      table.optional_quantity("filter_frequency", Kind::frequency, Range::positive(1e5));
  if (entry.filter_frequency.has_value() != (entry.filter_order > 0)) {
    table.refuse(entry.filter_frequency ? "filter_order" : "filter_frequency",
                 "expected filter_order and filter_frequency together, found one alone");
  }
  table.finish();
  return entry;
}

}  // namespace

void read_simulation(TableReader& file, Case& antenna) {
  if (auto table = file.optional_table("simulation")) {
    antenna.simulation = read_drive_details(*table, antenna);
  }
  if (auto table = file.optional_table("recorder")) antenna.recorder = read_recorder(*table);
}

}  // namespace boresight::io
